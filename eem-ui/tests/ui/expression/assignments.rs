use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let a = k;
    a += lambda;
    a = 2;
    a
})]
struct Model {
    k: f64,
}

fn main() {}

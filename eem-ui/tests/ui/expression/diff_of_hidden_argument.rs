use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let lambda = lambda / k;
    diff(lambda * lambda, lambda)
})]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| (1 as f64) * k + &lambda + *k + lambda? + k[0])]
struct Model {
    k: f64,
}

fn main() {}

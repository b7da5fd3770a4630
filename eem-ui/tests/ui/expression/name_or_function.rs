use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| ln * lambda + k(lambda) + lambda.k())]
struct Model {
    k: f64,
}

fn main() {}

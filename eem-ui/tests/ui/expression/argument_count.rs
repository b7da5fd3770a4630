use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| ln(lambda, 2) + lambda.sqrt(2) + powi(lambda) + diff(k * lambda) + sin())]
struct Model {
    k: f64,
}

fn main() {}

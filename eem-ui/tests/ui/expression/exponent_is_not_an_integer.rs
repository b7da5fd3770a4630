use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| lambda.powi(0.5) + powi(lambda, k) + lambda.powi(3000000000) + lambda.powi(-k))]
struct Model {
    k: f64,
}

fn main() {}

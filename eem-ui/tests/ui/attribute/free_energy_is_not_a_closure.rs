use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(0.5 * k * lambda.powi(2))]
struct Expression {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(psi)]
struct Name {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda * 1,5)]
struct Comma {
    k: f64,
}

fn main() {}

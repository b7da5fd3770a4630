use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| k * lambda.powi(2) - theta * ln(theta))]
#[viscosity(lambda = -k * k)]
#[viscosity(lambda = eta * lambda)]
struct Model {
    k: f64,
    eta: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| k * lambda.powi(2) - theta * ln(theta))]
#[viscosity(lambda = -k * k)]
struct Negative {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * k * lambda.powi(2))]
#[viscosity(lambda = eta)]
struct Units {
    #[unit("N/m")]
    k: f64,
    #[unit("N/m")]
    eta: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, temperature: Temperature| {
    0.5 * k * lambda.powi(2) - beta * (temperature - theta_ref) * ln(lambda)
})]
struct Spring {
    k: f64,
    beta: f64,
    theta_ref: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda / length);
    k * (lambda - length).powf(2.5) + k * strain.powf(n) + k * powf(gamma, 5 / 3)
        + k * (1 - theta / theta_ref).powf(0.4) + (lambda / length).powf(n) + (1 - exp(-lambda)).powf(0.5)
        + strain.powi(2).powf(1.25) + strain.powf(2) + (n * (1 - n) * theta).powf(n)
})]
#[viscosity(gamma = (theta - theta_ref).powf(-1.5))]
struct Model {
    k: f64,
    n: f64,
    length: f64,
    theta_ref: f64,
}

fn main() {}

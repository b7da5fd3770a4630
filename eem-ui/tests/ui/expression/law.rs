use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, delta: Viscous, theta: Temperature| {
    let rate = exp(k / theta);
    rate * lambda * gamma * delta * theta
})]
#[viscosity(gamma = k * lambda + gamma)]
#[viscosity(delta = k * rate * delta * etha)]
struct Model {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * (lambda - gamma).powi(2))]
#[viscosity(gamma = k * zeta + exp(theta))]
struct Isothermal {
    k: f64,
}

fn main() {}

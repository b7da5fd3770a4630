use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, delta: Viscous| k * lambda * (gamma + delta))]
#[viscosity(delta = k)]
struct Model {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, gamma: Viscous| 0.5 * k * (e1 - gamma).powi(2))]
struct Solid {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, delta: Viscous| k * lambda * (gamma + delta))]
#[viscosity(delta = k)]
struct Model {
    k: f64,
}

fn main() {}

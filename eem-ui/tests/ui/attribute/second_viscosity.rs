use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity(gamma = k)]
#[viscosity(gamma = 2 * k)]
struct Model {
    k: f64,
}

fn main() {}

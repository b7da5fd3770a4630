use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
struct Spring {
    #[viscosity(gamma = k)]
    k: f64,
    #[free_energy]
    other: f64,
}

fn main() {}

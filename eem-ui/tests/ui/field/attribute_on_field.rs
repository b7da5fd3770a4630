use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity(gamma = k)]
struct Spring {
    #[viscosity(gamma = k)]
    k: f64,
    #[free_energy]
    a: f64,
    #[free_energy(used)]
    b: f64,
    #[free_energy(|lambda: Stretch| lambda)]
    c: f64,
}

fn main() {}

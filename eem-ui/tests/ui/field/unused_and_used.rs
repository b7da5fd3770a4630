use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity(gamma = eta)]
struct Spring {
    #[free_energy(unused)]
    k: f64,
    #[free_energy(unused)]
    eta: f64,
}

fn main() {}

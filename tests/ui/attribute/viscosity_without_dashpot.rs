use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda)]
#[viscosity(gamma = k)]
struct NoDashpot {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity(gama = k, delta = k)]
struct Misspelt {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda)]
#[viscosity(lambda = k)]
struct AnotherRole {
    k: f64,
}

fn main() {}

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
#[free_energy(|lambda: Stretch, theta: Temperature| k * lambda - theta * ln(theta))]
#[viscosity(lambda = k, theta = k)]
struct AnotherRole {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace| k * e1.powi(2))]
#[viscosity(e1 = k)]
struct Solid {
    k: f64,
}

fn main() {}

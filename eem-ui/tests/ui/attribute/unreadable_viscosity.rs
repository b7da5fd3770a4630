use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity]
struct Bare {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity()]
struct Empty {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity(k)]
struct Nameless {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity(gamma: k)]
struct Colon {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| k * lambda * gamma)]
#[viscosity(gamma = 2 k)]
struct MissingOperator {
    k: f64,
}

fn main() {}

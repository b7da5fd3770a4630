use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| k)]
#[viscosity(gamma = k * theta)]
struct Nothing {
    k: f64,
}

// They are mentioned, and cancel.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = 2 * lambda - lambda - lambda;
    k * strain + diff(gamma, gamma) + theta / theta
})]
#[viscosity(gamma = k)]
struct Cancelled {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, j: Dilatation, gamma: Viscous| k)]
#[viscosity(gamma = k)]
struct Solid {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|warp: FibreStrain, weft: FibreStrain| 0.5 * k * warp.powi(2))]
struct Cloth {
    k: f64,
}

fn main() {}

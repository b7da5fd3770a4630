use eem::FreeEnergy;

// Both flows need a viscosity.
#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare, m1: ViscousTrace| {
    k * (e2 - 2 * m3 + m2) + k * m1.powi(2)
})]
struct WithoutViscosity {
    k: f64,
}

// Γ:Γ has none.
#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| k * (e2 - 2 * m3 + m2))]
#[viscosity(m3 = k, m2 = k)]
struct OfAnotherRole {
    k: f64,
}

// A solid has one viscous strain.
#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: ViscousStrain, other: ViscousStrain| k * (e2 - m3 - other))]
#[viscosity(m3 = k, other = k)]
struct Two {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| k * (e2 - m3))]
#[viscosity(m3 = k)]
struct Independent {
    k: f64,
}

// Another word for it.
#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: InternalStrain| k * (e2 - m3))]
#[viscosity(m3 = k)]
struct AnotherWord {
    k: f64,
}

// It is zero at rest.
#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| k * (e2 - 2 * m3 + sqrt(m2) + 1 / m3))]
#[viscosity(m3 = k)]
struct AtRest {
    k: f64,
}

fn main() {}

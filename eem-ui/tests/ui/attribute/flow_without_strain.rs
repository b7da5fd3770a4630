use eem::FreeEnergy;

// Nothing drives Γ.
#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m2: ViscousSquare, m1: ViscousTrace| k * (e2 + m2 + m1.powi(2)))]
#[viscosity(m1 = k)]
struct Undriven {
    k: f64,
}

// Without a strain there is no solid.
#[derive(FreeEnergy)]
#[free_energy(|m3: ViscousStrain, m2: ViscousSquare| k * (m2 - 2 * m3))]
#[viscosity(m3 = k)]
struct Unstrained {
    k: f64,
}

// A spring has a length.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, m3: ViscousStrain| k * (lambda.powi(2) - m3))]
#[viscosity(m3 = k)]
struct Spring {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

// The viscous strain is dimensionless, and its viscosities are in Pa s.
#[derive(FreeEnergy)]
#[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare, m1: ViscousTrace| {
    k * (e2 - 2 * m3 + m2) + force * m1.powi(2)
})]
#[viscosity(m3 = eta, m1 = k)]
struct Model {
    #[unit("Pa")]
    k: f64,
    #[unit("N")]
    force: f64,
    #[unit("N s/m")]
    eta: f64,
}

fn main() {}

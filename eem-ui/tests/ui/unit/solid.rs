use eem::FreeEnergy;

// A free energy per volume.
#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * la * e1.powi(2) + mu * e2)]
struct WholeBody {
    #[unit("J")]
    la: f64,
    #[unit("J")]
    mu: f64,
}

// Its viscous variables are strains.
#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, gamma: Viscous, theta: Temperature| {
    0.5 * k * (e1 - gamma).powi(2) - b * theta * (e1 - length) + c * (theta - theta * ln(theta / theta_ref))
})]
#[viscosity(gamma = eta)]
struct Lengths {
    #[unit("Pa")]
    k: f64,
    b: f64,
    #[unit("m")]
    length: f64,
    c: f64,
    #[unit("K")]
    theta_ref: f64,
    #[unit("N s/m")]
    eta: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|j: Dilatation, theta: Temperature| {
    0.5 * k * j.powi(2) - 3 * beta * (theta - theta_ref) * k * j + c * (theta - theta * ln(theta / theta_ref))
})]
struct Unknown {
    #[unit("Pa")]
    k: f64,
    beta: f64,
    c: f64,
    #[unit("K")]
    theta_ref: f64,
}

fn main() {}

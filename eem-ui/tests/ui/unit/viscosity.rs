use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, delta: Viscous| 0.5 * k * (lambda - gamma).powi(2) + 0.5 * k * (lambda - delta).powi(2))]
#[viscosity(gamma = eta, delta = zeta * 2.0 + eta)]
struct Model {
    #[unit("N/m")]
    k: f64,
    #[unit("Pa s")]
    eta: f64,
    #[unit("kg/s")]
    zeta: f64,
}

fn main() {}

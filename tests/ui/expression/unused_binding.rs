use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    let strain = ln(lambda);
    let _kept = ln(lambda / 2);
    0.5 * k * (lambda - gamma).powi(2)
})]
#[viscosity(gamma = { let rate = 2; k })]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    let k = 2 * k;
    let lambda = lambda - gamma;
    let strain = ln(lambda);
    let strain = strain * { let strain = 3; strain };
    k * strain
})]
#[viscosity(gamma = { let gamma = eta; gamma * { let eta = 2; eta } })]
struct Model {
    k: f64,
    eta: f64,
}

fn main() {}

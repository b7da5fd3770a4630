use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous| {
    let extension = lambda - length;
    k * sqrt(extension * extension) + sqrt(4 * k * gamma.powi(2)) + sqrt(lambda * lambda)
        + sqrt(k * k) + sqrt(extension.powi(4)) + extension.powi(2).powf(1 / 2) + sqrt(extension.powi(2) + length.powi(2))
})]
#[viscosity(gamma = k)]
struct Model {
    k: f64,
    length: f64,
}

fn main() {}

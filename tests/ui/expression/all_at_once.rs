use eem::FreeEnergy;

// Everything a phase finds is shown, not only the first mistake.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature, again: Stretch| {
    let strain = ln(lambda / lenght);
    stifness * strain.powi(2, 3) + sine(gamma)
})]
#[viscosity(gama = eta)]
struct Spring {
    length: f64,
    stiffness: f64,
}

fn main() {}

use eem::FreeEnergy;

// Mistakes of all kinds are shown together, in the order in which they stand in the file, and none
// of them causes another message: not about the unknown values of what is wrong, nor about what it
// might have used.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature, again: Stretch| {
    let strain = ln(lambda / lenght);
    let square = strain ^ 2;
    let broken = if square > 1 { 1 } else { 2 };
    stifness * strain.powi(2, 3) + sine(gamma) + ln(-1) * broken + lambda.powi(0.5)
})]
#[viscosity(gama = eta / 0)]
struct Spring {
    length: f64,
    stiffness: f64,
    name: &'static str,
}

// Where every name is read, the missing uses and the physics are shown as well.
#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    let strain = ln(lambda);
    let stiffness = 2 * stiffness;
    stiffness * lambda - coupling * theta
})]
#[viscosity(gamma = -1)]
struct Wrong {
    stiffness: f64,
    coupling: f64,
    softening: f64,
}

fn main() {}

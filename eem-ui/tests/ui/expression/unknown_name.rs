use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lamda / rest_lenght);
    let unrelated = strian * thetta;
    0.5 * stiffness * strain.powi(2) + modulus * Theta
})]
struct Model {
    stiffness: f64,
    rest_length: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|x: Stretch| stiffness * x.powi(2) * theta * (theta_ref - gamma))]
struct Undeclared {
    stiffness: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|x: Stretch| stiffness * x * (lambda + j))]
struct Spring {
    stiffness: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|first: StrainTrace| 0.5 * lambda * first.powi(2) + mu * e2 + e1)]
struct Solid {
    mu: f64,
}

fn main() {}

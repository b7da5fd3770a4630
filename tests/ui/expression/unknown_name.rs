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

fn main() {}

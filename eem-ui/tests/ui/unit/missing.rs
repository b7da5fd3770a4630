use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / length);
    0.5 * stiffness * strain.powi(2) + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
        + other * other2
})]
struct Model {
    #[unit("J")]
    stiffness: f64,
    length: f64,
    capacity: f64,
    theta_ref: f64,
    other: f64,
    other2: f64,
}

fn main() {}

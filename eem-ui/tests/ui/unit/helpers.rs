use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = |x| ln(x / length);
    let energy = |x, k| { let e = strain(x); 0.5 * k * e.powi(2) };
    let heat = |t| capacity * (t - theta_ref - t * ln(t / theta_ref));
    energy(lambda, stiffness) + energy(theta, stiffness) + energy(lambda, theta_ref) + heat(theta) + heat(lambda)
})]
struct Model {
    #[unit("J")]
    stiffness: f64,
    #[unit("m")]
    length: f64,
    #[unit("J/K")]
    capacity: f64,
    #[unit("K")]
    theta_ref: f64,
}

fn main() {}

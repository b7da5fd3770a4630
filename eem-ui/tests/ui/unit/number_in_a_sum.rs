use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let theta_ref = 600.0 / 2;
    c * (theta - 300.0) + c * (-300 + theta) + c * (theta - theta_ref) + k * (lambda - 0)
        - c * theta * ln(theta / theta_0)
})]
struct Model {
    #[unit("J/K")]
    c: f64,
    #[unit("N")]
    k: f64,
    #[unit("K")]
    theta_0: f64,
}

fn main() {}

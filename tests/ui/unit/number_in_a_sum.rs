use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| c * (theta - 300.0) + c * (-300 + theta) + k * (lambda - 0))]
struct Model {
    #[unit("J/K")]
    c: f64,
    #[unit("N")]
    k: f64,
}

fn main() {}

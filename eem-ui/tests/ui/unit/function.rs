use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| k * ln(lambda) + k * exp(theta / (activation * 2.0)) + k * (lambda / length).sin())]
struct Model {
    #[unit("J")]
    k: f64,
    #[unit("1")]
    activation: f64,
    #[unit("mm")]
    length: f64,
}

fn main() {}

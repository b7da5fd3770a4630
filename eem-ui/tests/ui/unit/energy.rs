use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * (lambda - length))]
struct Model {
    #[unit("N/m")]
    k: f64,
    #[unit("m")]
    length: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * (lambda - length).powi(3))]
struct Cubic {
    #[unit("N/m")]
    k: f64,
    #[unit("m")]
    length: f64,
}

fn main() {}

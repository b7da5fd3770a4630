use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * (lambda - length).powi(2))]
struct Model {
    #[unit("kN/m")]
    k: f64,
    #[unit("m")]
    length: f64,
}

fn main() {}

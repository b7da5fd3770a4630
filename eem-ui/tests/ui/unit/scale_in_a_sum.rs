use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * k * (lambda - length).powi(2) + (work + c * warmth))]
struct Model {
    #[unit("kN/m")]
    k: f64,
    #[unit("mm")]
    length: f64,
    #[unit("kJ")]
    work: f64,
    #[unit("J/K")]
    c: f64,
    #[unit("K")]
    warmth: f64,
}

fn main() {}

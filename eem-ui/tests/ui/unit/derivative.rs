use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let psi = 0.5 * k * (lambda - length).powi(2);
    psi + length * diff(psi, lambda) + warmth * diff(psi, lambda)
})]
struct Model {
    #[unit("N/m")]
    k: f64,
    #[unit("m")]
    length: f64,
    #[unit("K")]
    warmth: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let psi = 0.5 * k * (lambda - length).powi(2);
    psi + length * diff(psi, lambda) + theta * diff(psi, lambda)
})]
struct Model {
    #[unit("N/m")]
    k: f64,
    #[unit("m")]
    length: f64,
}

fn main() {}

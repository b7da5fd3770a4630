use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let log = |x| ln(x / length);
    k * log(lambda).powi(2) - c * theta * log(theta)
})]
struct Spring {
    #[unit("J")]
    k: f64,
    #[unit("m")]
    length: f64,
    #[unit("J/K")]
    c: f64,
}

fn main() {}

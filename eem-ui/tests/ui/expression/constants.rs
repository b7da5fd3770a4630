use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda * pi + e * lamda + core::f64::consts::Pi + R[0]
    + std::f64::consts::sqrt_2 * f64::consts::golden)]
struct Model {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda.powi(2) / (PI - core::f64::consts::PI) + ln(-PI))]
struct Values {
    k: f64,
}

fn main() {}

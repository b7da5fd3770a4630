use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, a: Viscous, b: Viscous, c: Viscous, theta: Temperature| {
    k * (lambda - a - b - c).powi(2) - theta * ln(theta)
})]
#[viscosity(a = 0, b = -1e-3, c = -k * k * exp(theta / 300))]
struct Spring {
    k: f64,
}

fn main() {}

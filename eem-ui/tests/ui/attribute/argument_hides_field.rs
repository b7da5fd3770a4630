use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| k * lambda - k * theta * ln(theta))]
struct Spring {
    k: f64,
    lambda: f64,
    theta: String,
}

fn main() {}

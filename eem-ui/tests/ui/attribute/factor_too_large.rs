use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    1e300 * lambda * 1e300 * theta - k * theta * ln(theta)
})]
struct Spring {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    k * lambda.powi(2) + 5 * theta * ln(theta / 300) + c.powi(2) * theta.powi(2)
})]
struct Spring {
    k: f64,
    c: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = lambda - 1;
    abs(k) * strain.abs() + abs(2 * theta)
})]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature, length: Stretch, temperature: Temperature| k * lambda)]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, lambda: Temperature| k * lambda)]
struct Model {
    k: f64,
}

fn main() {}

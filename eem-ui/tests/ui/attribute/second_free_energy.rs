use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda)]
#[free_energy(|lambda: Stretch| k / lambda)]
struct Spring {
    k: f64,
}

fn main() {}

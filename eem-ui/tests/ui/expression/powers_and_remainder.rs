use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda ^ 2 + lambda ** 2 + lambda % 2)]
struct Model {
    k: f64,
}

fn main() {}

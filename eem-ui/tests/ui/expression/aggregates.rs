use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| [k, lambda] + (k, lambda) + Point { k } + (k..lambda))]
struct Model {
    k: f64,
}

fn main() {}

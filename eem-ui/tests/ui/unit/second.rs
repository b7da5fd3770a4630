use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda)]
struct Model {
    #[unit("N")]
    #[unit("N")]
    k: f64,
}

fn main() {}

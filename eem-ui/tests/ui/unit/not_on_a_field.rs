use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda)]
#[unit("J")]
struct Model {
    #[unit("N")]
    k: f64,
}

fn main() {}

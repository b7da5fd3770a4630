use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(move |lambda: Stretch| k * lambda)]
struct Moved {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| -> f64 { k * lambda })]
struct Typed {
    k: f64,
}

fn main() {}

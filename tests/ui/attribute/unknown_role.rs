use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Strech, gamma: viscous, theta: Temp| k * lambda)]
struct Model {
    k: f64,
}

fn main() {}

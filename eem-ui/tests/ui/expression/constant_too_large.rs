use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda + exp(1000) + 1e200 * 1e200 + 10.powi(400))]
struct Model {
    k: f64,
}

fn main() {}

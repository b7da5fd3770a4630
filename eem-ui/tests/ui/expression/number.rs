use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda * 1e400 + 2f32 * 3usize + 1e-400 + 2lambda + 0.5k)]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| powf(-1, 0.5) + powf(-2, lambda) + powf(-lambda, k) + powf(-lambda, 2))]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * "lambda" + 'x' + true + b"x")]
struct Model {
    k: f64,
}

fn main() {}

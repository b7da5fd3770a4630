use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| k * lambda + _ + lambda.await + (yield lambda))]
struct Model {
    k: f64,
}

fn main() {}

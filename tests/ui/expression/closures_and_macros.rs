use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| (|x| x)(k) + vec![k] + sum!(lambda))]
struct Model {
    k: f64,
}

fn main() {}

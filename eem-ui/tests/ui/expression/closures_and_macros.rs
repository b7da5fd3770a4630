use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| (|x| x)(k) + diff(|x| x, lambda) + vec![k] + sum!(lambda))]
struct Model {
    k: f64,
}

fn main() {}

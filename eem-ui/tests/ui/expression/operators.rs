use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| (lambda < k) + (lambda == k) + (lambda && k) + (lambda & k) + (lambda << k) + !lambda)]
struct Model {
    k: f64,
}

fn main() {}

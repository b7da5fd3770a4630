use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let a = 1 / 0 + lambda / (2 - 2);
    let b = ln(-1) + k * sqrt(1 - 2) + atanh(2) + recip(0);
    a + b
})]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| {
    let a = 1 / 0 + lambda / (2 - 2) + k / ln(1);
    let b = recip(0) + 0.powi(-1) + powf(0, -0.5) + k / (lambda - lambda);
    a + b
})]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let a = ln(-1) + log2(0) + log10(ln(0.5)) + sqrt(1 - 2) + atanh(2) + ln_1p(-1.5);
    let b = ln(-lambda) + sqrt(-k * k - theta) + k.ln();
    a + b
})]
struct Model {
    k: f64,
}

fn main() {}

use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let log = |x| ln(x);
    let both = |x| log(x) + log(-x) + ln(-1);
    let power = |x, n| x.powi(n) + abs(x);
    let calls = log(-k * k) + log(-theta) + log(-2) + log(-3);
    k * both(theta) + calls + both(lambda) + power(lambda, 2.5) + power(k, k) - log(2 - 2) * theta * ln(theta)
})]
struct Model {
    k: f64,
}

fn main() {}

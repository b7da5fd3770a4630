use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch| self.k * lambda + f64::ln(lambda) + Self::k + lambda.0 + ln::<f64>(k) + k.ln::<f64>() + <f64>::MAX)]
struct Model {
    k: f64,
}

fn main() {}

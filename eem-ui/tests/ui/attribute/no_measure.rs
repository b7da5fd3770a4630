use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|theta: Temperature| k * theta)]
struct OnlyTemperature {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|| k)]
struct NoArgument {
    k: f64,
}

fn main() {}

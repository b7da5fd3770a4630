use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|(lambda, theta): Stretch| k * lambda)]
struct Tuple {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|mut lambda: Stretch| k * lambda)]
struct Mutable {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|_: Stretch| k)]
struct Nameless {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|&lambda: Stretch| k * lambda)]
struct Reference {
    k: f64,
}

fn main() {}

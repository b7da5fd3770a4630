use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda| k * lambda)]
struct Untyped {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: f64| k * lambda)]
struct Float {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|e1, e2: f64, j| k * e1)]
struct Solid {
    k: f64,
}

fn main() {}

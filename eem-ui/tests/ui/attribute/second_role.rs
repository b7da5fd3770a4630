use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature, length: Stretch, temperature: Temperature| k * lambda)]
struct Model {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, trace: StrainTrace, square: StrainSquare| k * e1)]
struct Solid {
    k: f64,
}

fn main() {}

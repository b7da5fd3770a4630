use eem::FreeEnergy;

#[derive(FreeEnergy)]
#[free_energy(|lambda: Strech, gamma: viscous, theta: Temp| k * lambda)]
struct Model {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|lambda: Length, gamma: Dashpot, theta: eem::Temperature, rest: Volume| k * lambda)]
struct OtherWords {
    k: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrce, e2: Square, j: Jacobian, e: Strain, p: Pressure| k * e1)]
struct Solid {
    k: f64,
}

fn main() {}

use eem::{FreeEnergy, Strain, StrainEnergy};

#[derive(FreeEnergy)]
#[free_energy(|lambda: Stretch, e1: StrainTrace, e2: StrainSquare| k * lambda + g * e2)]
struct Spring {
    #[unit("N")]
    k: f64,
    #[unit("Pa")]
    g: f64,
}

#[derive(FreeEnergy)]
#[free_energy(|j: Dilatation, theta: Temperature, length: Stretch, lambda: Stretch| k * j)]
struct Solid {
    k: f64,
}

// What uses them is not told that they are none of the two.
const STRAINS: [Strain; 1] = Solid::STRAINS;

fn main() {}

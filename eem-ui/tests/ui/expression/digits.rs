//! Forms that lose the digits of small strains are warned of, here as errors.

#![deny(deprecated)]

use eem::prelude::*;

#[derive(FreeEnergy)]
#[free_energy(|e1: StrainTrace, j: Dilatation| {
    let volume = 1 + j;
    let growth = ln(volume);
    let fine = ln_1p(j) + ln(2 + j);
    k * growth.powi(2) + k * (exp(e1) - 1).powi(2) + m * (1 - cos(e1)) + m * (cosh(j) - 1)
        + k * (sqrt(1 + 2 * e1) - 1).powi(2) + m * (volume.powi(2) - 1) + m * (volume.powf(1.5) - 1)
        + k * fine.powi(2)
})]
struct Rubber {
    k: f64,
    m: f64,
}

fn main() {}

//! Written by `generate/conjugates.py`: do not edit.

use super::Conjugates;
use crate::double_pendulum::ThermoelasticSpring;

/// φ, θ* and s₁ − s₀ of a step from (λ₀, θ₀) to (λ₁, θ₁).
#[inline(always)]
#[expect(clippy::too_many_lines, reason = "generated")]
pub(super) fn conjugates(
    spring: &ThermoelasticSpring,
    [lambda_0, theta_0]: [f64; 2],
    [lambda_1, theta_1]: [f64; 2],
) -> Conjugates {
    let &ThermoelasticSpring {
        stiffness,
        softening,
        coupling,
        capacity,
        natural_length,
        theta_ref,
    } = spring;
    let z0 = -2.0 * lambda_0.powi(2) + 2.0 * lambda_1.powi(2);
    let z1 = 1.0 / z0;
    let z2 = 1.0 / theta_ref;
    let z3 = (theta_1 * z2).ln();
    let z4 = capacity * z3;
    let z5 = 1.0 / natural_length;
    let z6 = (lambda_1 * z5).ln();
    let z7 = coupling * z6;
    let z8 = 1.0 / theta_1;
    let z9 = softening * theta_ref;
    let z10 = z6.powi(2);
    let z11 = (1.0 / 2.0) * z10;
    let z12 = z11 * z9;
    let z13 = z12 * z8 + z4 + z7;
    let z14 = -stiffness;
    let z15 = -z14 - z3 * z9;
    let z16 = (theta_0 * z2).ln();
    let z17 = capacity * z16;
    let z18 = (lambda_0 * z5).ln();
    let z19 = coupling * z18;
    let z20 = 1.0 / theta_0;
    let z21 = (1.0 / 2.0) * z18.powi(2);
    let z22 = z21 * z9;
    let z23 = z20 * z22;
    let z24 = z17 + z19 + z23;
    let z25 = theta_0 * z24;
    let z26 = -z14 - z16 * z9;
    let z27 = z21 * z26;
    let z28 = -theta_ref;
    let z29 = theta_0 + z28;
    let z30 = theta_1 + z28;
    let z31 = z30 * z7;
    let z32 = z12 * z20;
    let z33 = z22 * z8;
    let z34 = theta_0 * (z17 + z32 + z7) - theta_1 * (z19 + z33 + z4) + z11 * z26 - z15 * z21
        + z19 * z30
        - z29 * z7;
    let z35 = theta_1 * z13 + z11 * z15 + z19 * z29 - z25 - z27 - z31 + z34;
    let z36 = -1.0 / 2.0 * softening * theta_ref * z10 * z8;
    let z37 = z23 + z36;
    let z38 = 2.0 * coupling * z6 - 2.0 * z19 + z32 - z33 - z37;
    let z39 = 2.0 * capacity * z3 - 2.0 * z17 - z32 + z33 - z37;
    let z40 = 1.0 / z39;
    let z41 = -2.0 * capacity * (-theta_0 * z16 + theta_0 - theta_ref)
        + 2.0 * capacity * (-theta_1 * z3 + theta_1 - theta_ref)
        + coupling * z18 * z29
        + theta_1 * z13
        + (1.0 / 2.0) * z10 * z15
        - z25
        - z27
        - z31
        - z34;
    let z42 = z40 * z41;
    let z43 = z1 * z42;
    let z44 = 1.0 / lambda_1;
    let z45 = coupling * z44;
    let z46 = z44 * z6;
    let z47 = z46 * z9;
    let z48 = z20 * z47;
    let z49 = theta_0 * (z45 + z48);
    let z50 = z26 * z46;
    let z51 = z29 * z45;
    let z52 = z47 * z8;
    let z53 = z45 + z52;
    let z54 = theta_1 * z53 + z15 * z46 - z30 * z45;
    let z55 = z40 * (-z49 - z50 + z51 + z54);
    let z56 = z1 * z38;
    let z57 = z0.powi(-2);
    let z58 = z41 / z39.powi(2);
    let z59 = z58 * (softening * theta_ref * z20 * z44 * z6 - z52);
    let z60 = capacity * z8;
    let z61 = theta_1.powi(-2);
    let z62 = z22 * z61;
    let z63 = theta_1 * (z60 - z62);
    let z64 = z12 * z61;
    let z65 = -z64;
    let z66 = z60 + z65;
    let z67 = z40 * (theta_1 * z66 + z63);
    let z68 = z58 * (-2.0 * z60 + z62 + z64);
    Conjugates {
        factor: [
            z1 * z35 - z38 * z43,
            -4.0 * lambda_1 * z35 * z57
                + 4.0 * lambda_1 * z38 * z40 * z41 * z57
                + z1 * (z49 + z50 - z51 + z54)
                - z43 * (2.0 * z45 + z48 + z52)
                - z55 * z56
                - z56 * z59,
            z1 * (theta_1 * z66 - z63) - z43 * (z62 + z65) - z56 * z67 - z56 * z68,
        ],
        theta: [z42, z55 + z59, z67 + z68],
        entropy: [capacity * z3 + coupling * z6 - z24 - z36, z53, z66],
    }
}

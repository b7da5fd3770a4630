//! Divided differences of random expressions: right to their running error bound at any increment.

use crate::support::precise::{Precise, error, to_f64};
use eem_symbolic::{Arithmetic, Bounded, F64, RunningError};
use eem_testkit::length::at_length;
use eem_testkit::precise::BigFloat;
use eem_testkit::secant::{Secant, run, start};

/// |b − a|/a, zero and from far below rounding to the same size.
const INCREMENTS: [f64; 9] = [0.0, 1e-17, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1, 1.0];
/// The ends of random expression `seed` for one increment.
fn ends(seed: u64, increment: f64) -> [f64; 2] {
    let a = start(seed);
    [a, a * (1.0 + increment)]
}

#[test]
fn differences_are_within_their_bound() {
    let precise = Precise::new();
    let (mut checked, mut worst, mut ulps) = (0, 0.0_f64, Vec::new());
    for seed in 0..at_length(2000, 400) {
        let secant = Secant::new(seed);
        let increment = INCREMENTS[(seed % 9) as usize];
        let ends = ends(seed, increment);
        if !secant.is_moderate(&F64, ends) {
            continue;
        }
        let bounded = run(&secant.difference, &RunningError, &ends.map(Bounded::exact));
        let exact = run(&secant.difference, &precise, &precise.all(&ends));
        let error = error(&precise, bounded.value, &exact);
        assert!(
            error <= bounded.error,
            "expression {seed} at {increment:e}: error {error:e}, bound {:e}",
            bounded.error
        );
        checked += 1;
        if error > 0.0 {
            worst = worst.max(error / bounded.error);
            ulps.push(error / to_f64(&exact).abs() / f64::EPSILON);
        }
    }
    ulps.sort_by(f64::total_cmp);
    println!(
        "{checked} expressions, largest error / bound {worst:.2}, median error {:.2} ulp",
        ulps[ulps.len() / 2]
    );
    assert!(
        checked > at_length(1500, 300),
        "only {checked} expressions are of moderate size"
    );
}

#[test]
fn differences_times_increments_are_differences() {
    let precise = Precise::new();
    for seed in 0..at_length(200, 70) {
        let secant = Secant::new(seed);
        let ends = ends(seed, [1e-9, 1e-3, 1.0][(seed % 3) as usize]);
        if !secant.is_moderate(&F64, ends) {
            continue;
        }
        let exact = precise.all(&ends);
        let [at_a, at_b] = [0, 1].map(|i| run(&secant.value, &precise, &exact[i..=i]));
        let quotient = precise.sub(&at_b, &at_a);
        let quotient = precise.div(&quotient, &precise.sub(&exact[1], &exact[0]));
        let difference = run(&secant.difference, &precise, &exact);
        let error = to_f64(&precise.sub(&difference, &quotient)).abs();
        // 512 bits less those that the quotient and the kernels' own quotients cancel.
        assert!(error < 1e-80, "expression {seed}: {error:e}");
    }
}

#[test]
fn second_differences_are_derivatives_of_first() {
    let precise = Precise::new();
    for seed in 0..at_length(200, 70) {
        let secant = Secant::new(seed);
        let ends = ends(seed, INCREMENTS[(seed % 9) as usize]);
        if !secant.is_moderate(&F64, ends) {
            continue;
        }
        let exact = precise.all(&ends);
        let offset = precise.two_to(-100);
        let at = |b: BigFloat| run(&secant.difference, &precise, &[exact[0].clone(), b]);
        let above = at(precise.add(&exact[1], &offset));
        let below = at(precise.sub(&exact[1], &offset));
        let width = precise.add(&offset, &offset);
        let expected = precise.div(&precise.sub(&above, &below), &width);
        let slope = run(&secant.slope, &precise, &exact);
        let error = to_f64(&precise.sub(&slope, &expected)).abs();
        // The offset 2⁻¹⁰⁰ squared, times third derivatives.
        assert!(error < 1e-40, "expression {seed}: {error:e}");
        let bounded = run(&secant.slope, &RunningError, &ends.map(Bounded::exact));
        let error = crate::support::precise::error(&precise, bounded.value, &slope);
        assert!(
            error <= bounded.error,
            "expression {seed}: {error:e}, {:e}",
            bounded.error
        );
    }
}

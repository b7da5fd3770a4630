//! The discrete scheme is the published one: it follows the 40-digit solution to rounding.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use eem::prelude::*;
use support::{reference, single_pendulum};

/// Rounding of each step, amplified by the motion over the run.
const TOLERANCE: f64 = 1e-12;

#[test]
fn entropy_form_follows_the_exact_discrete_solution_for_100_steps() {
    let rows = reference("single_pendulum_eem-entropy_h0.2.csv");
    assert_eq!(rows.len(), 101);
    let mut pendulum = single_pendulum(Scheme::EemEntropy, 0.2);
    let size = |column: usize| {
        rows.iter()
            .fold(0.0, |size: f64, row| size.max(row[column].abs()))
    };
    let mut largest = 0.0_f64;
    for (step, row) in rows.iter().enumerate() {
        if step > 0 {
            pendulum.run.step().unwrap();
        }
        for (column, (found, exact)) in pendulum.row().iter().zip(&row[1..]).enumerate() {
            let error = (found - exact).abs() / size(column + 1);
            assert!(
                error <= TOLERANCE,
                "step {step}, column {column}: {error:e}"
            );
            largest = largest.max(error);
        }
    }
    println!("largest relative error over 100 steps: {largest:e}");
}

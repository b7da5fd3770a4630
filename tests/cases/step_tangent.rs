//! The tangent of a full step is exact, for every increment.

use eem::prelude::*;

use crate::support::{ThermoViscoElastic, reference};

/// Relative to the largest entry.
const TOLERANCE: f64 = 1e-13;

fn pendulum(step: f64) -> Simulation<2> {
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(1.0, [1.2, 0.7], [0.3, -1.1]);
    let spring = scene.spring(ThermoViscoElastic::PENDULUM, [pivot, bob]);
    scene.set_temperature(spring, 330.0);
    scene.set_viscous_stretch(spring, 0, 0.02);
    let air = scene.reservoir(300.0);
    scene.conduct(spring, air, 10.0);
    Simulation::new(scene, Scheme::EemEntropy, step).unwrap()
}

/// max |a − b| / max |b|.
fn error(found: &[f64], exact: &[f64]) -> f64 {
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let size = largest(&mut exact.iter().map(|value| value.abs()));
    largest(&mut found.iter().zip(exact).map(|(a, b)| (a - b).abs())) / size
}

#[test]
fn agrees_with_high_precision_differences() {
    // step, d_x, d_y, R_x, R_y, K_xx, K_xy, K_yx, K_yy
    for row in reference("step_tangent.csv") {
        let system = pendulum(row[0]).linearize(&row[1..3]).unwrap();
        let residual = error(&system.residual, &row[3..5]);
        // The inertia 2m/h is no achievement: compare what the spring adds to it.
        let inertia = 2.0 / row[0];
        let spring = |matrix: &[f64]| {
            [
                matrix[0] - inertia,
                matrix[1],
                matrix[2],
                matrix[3] - inertia,
            ]
        };
        let tangent = error(&spring(&system.tangent), &spring(&row[5..9]));
        // Subtracting the inertia from rounded sums costs its rounding.
        let size = row[5..9]
            .iter()
            .fold(0.0, |size: f64, entry| size.max(entry.abs()));
        let part = spring(&row[5..9])
            .iter()
            .fold(0.0, |size: f64, entry| size.max(entry.abs()));
        println!(
            "h = {}, d = {:e}: R {residual:e}, K {tangent:e}",
            row[0], row[1]
        );
        assert!(residual <= TOLERANCE);
        assert!(tangent <= TOLERANCE + 4.0 * f64::EPSILON * size / part);
    }
}

#[test]
fn a_wrong_number_of_unknowns_is_an_error() {
    let error = pendulum(0.1).linearize(&[0.0]).unwrap_err();
    let text = "at t = 0 s: 1 unknowns were given, the scene has 2";
    assert_eq!(error.to_string(), text);
}

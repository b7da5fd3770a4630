//! The energy–entropy–momentum schemes of order 4 and 6: how their errors shrink, and the laws of every step.

use eem::prelude::*;

use crate::support::{
    DoublePendulum, Laws, LogarithmicStiffness, ThermoViscoElastic, reference, single_pendulum,
};

const SCHEMES: [Scheme; 2] = [Scheme::EemEntropy4, Scheme::EemEntropy6];

const ENERGY_TOLERANCE: f64 = 4e-15;
const ANGULAR_MOMENTUM_TOLERANCE: f64 = 5e-15;
const ENTROPY_TOLERANCE: f64 = -2.0;

/// The errors of q, p, γ, θ and σ at the time `end`, the largest in units of their sizes.
fn error(scheme: Scheme, step: f64, end: f64) -> f64 {
    // time, q_x, q_y, p_x, p_y, γ, θ, σ, error estimate
    let rows = reference("single_pendulum_exact.csv");
    let exact = rows.iter().find(|row| row[0] >= end).unwrap();
    let mut pendulum = single_pendulum(scheme, step);
    while pendulum.run.time() < end - 0.5 * step {
        pendulum.run.step().unwrap();
    }
    let [qx, qy, px, py, theta, gamma, sigma] = pendulum.row();
    let row = [qx, qy, px, py, gamma, theta, sigma];
    let d: Vec<_> = row.iter().zip(&exact[1..]).map(|(x, e)| x - e).collect();
    println!("{scheme} {step} {end} {d:?}");
    let errors = row.iter().zip(&exact[1..]);
    let errors = errors.map(|(x, exact)| (x - exact).abs() / exact.abs().max(1.0));
    errors.fold(0.0, f64::max)
}

/// The slope of a least-squares line through (ln h, ln error) for h, h/2, h/4, …
fn slope(errors: &[f64]) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a handful of points")]
    let middle = (errors.len() - 1) as f64 / 2.0;
    let (mut above, mut below, mut x) = (0.0, 0.0, middle);
    for error in errors {
        above += x * error.log2();
        below += x * x;
        x -= 1.0;
    }
    above / below
}

#[test]
fn the_single_pendulum_shows_orders_four_and_six() {
    for (scheme, order, tolerance) in [
        (Scheme::EemEntropy4, 4.0, 0.15),
        (Scheme::EemEntropy6, 6.0, 0.3),
    ] {
        let errors = [0.05, 0.025, 0.0125, 0.00625].map(|step| error(scheme, step, 2.0));
        println!("{scheme}: {errors:?}, slope {}", slope(&errors));
        assert!((slope(&errors) - order).abs() <= tolerance);
    }
}

/// Runs until `duration` and looks at every step.
fn watch<const D: usize>(run: &mut Simulation<D>, duration: f64) -> Laws {
    let mut laws = Laws::new(run);
    let (mut iterations, mut steps) = (0.0, 0.0);
    while run.time() < duration - 0.5 * run.step_size() {
        #[expect(clippy::cast_precision_loss, reason = "a handful of iterations")]
        let needed = run.step().unwrap().iterations as f64;
        (iterations, steps) = (iterations + needed, steps + 1.0);
        laws.watch(run);
    }
    let (h, per_step) = (run.step_size(), iterations / steps);
    println!("h = {h}: {per_step} iterations per step, {laws:?}");
    laws
}

#[test]
fn the_single_pendulum_keeps_all_laws() {
    for scheme in SCHEMES {
        for step in [0.2, 0.1, 0.05] {
            println!("{scheme}");
            let laws = watch(&mut single_pendulum(scheme, step).run, 20.0);
            assert!(laws.energy <= ENERGY_TOLERANCE, "{laws:?}");
            assert!(laws.angular_momentum <= ANGULAR_MOMENTUM_TOLERANCE);
            assert!(laws.entropy_ulps >= ENTROPY_TOLERANCE);
        }
    }
}

#[test]
fn errors_t20() {
    for scheme in [Scheme::EemEntropy, Scheme::EemEntropy4, Scheme::EemEntropy6] {
        for step in [0.2, 0.1, 0.05] {
            error(scheme, step, 20.0);
            error(scheme, step, 2.0);
        }
    }
}

//! Tolerances mean what they say: over the published cases the errors of all steps add up to about the tolerance.

use std::ops::ControlFlow;

use eem::materials::ThermoelasticSpring;
use eem::prelude::*;
use eem::{EndState, Tolerance};

use crate::support::{DoublePendulum, hooke, largest_error, single_pendulum_scene};

/// The longest step of what is exact, s; conduction of the case `romero` is stable below 0.05 s.
const LONGEST: f64 = 0.02;

/// What the errors of all steps may add up to, in tolerances.
const SUMS: [f64; 2] = [0.1, 3.0];

/// The sum of the errors of all steps, and the error at the end, in tolerances. Steps are compared with shorter ones of
/// order 8 from the same state, the end with a run at a tolerance of 1e-13.
fn errors<const D: usize>(
    scene: impl Fn() -> Scene<D>,
    scheme: Scheme,
    relative: f64,
    end: f64,
) -> [f64; 2] {
    let new = |scheme| Simulation::new(scene(), scheme, 0.01).unwrap();
    let mut run = new(scheme);
    run.control_steps(Tolerance::new(relative).over(end))
        .unwrap();
    let mut before = run.checkpoint();
    let (mut sum, mut momentum) = (0.0, 0.0_f64);
    run.run_until_with(end, |run, report| {
        let mut fine = new(scheme);
        fine.restore(&before).unwrap();
        fine.fix_steps();
        let mut fine = fine.with_scheme(Scheme::EemExplicit).unwrap();
        let parts = (report.step / LONGEST).ceil().max(4.0);
        fine.set_step_size(report.step / parts).unwrap();
        fine.run_until(report.time).unwrap();
        momentum = momentum.max(fine.largest_momentum());
        let exact = EndState::of(&fine).with_largest_momentum(momentum);
        sum += largest_error(&EndState::of(run), &exact) / relative;
        before = run.checkpoint();
        ControlFlow::Continue(())
    })
    .unwrap();
    let mut exact = new(Scheme::EemExplicit);
    exact.control_steps(Tolerance::new(1e-13)).unwrap();
    exact.run_until(end).unwrap();
    let error = largest_error(&EndState::of(&run), &EndState::of(&exact));
    [sum, error / relative]
}

#[test]
fn the_errors_of_all_steps_add_up_to_the_tolerance() {
    let [_, krueger, log] = DoublePendulum::ALL;
    for (scheme, relative) in [
        (Scheme::EemEntropy4, 1e-6),
        (Scheme::EemEntropy6, 1e-8),
        (Scheme::EemExplicit, 1e-6),
        (Scheme::EemExplicit, 1e-10),
    ] {
        let of_cases = [
            (
                "single",
                errors(|| single_pendulum_scene().0, scheme, relative, 3.0),
            ),
            (
                krueger.name,
                errors(|| krueger.scene().0, scheme, relative, 3.0),
            ),
            (log.name, errors(|| log.scene().0, scheme, relative, 1.0)),
        ];
        for (case, [sum, _]) in of_cases {
            let is_within = (SUMS[0]..=SUMS[1]).contains(&sum);
            assert!(is_within, "{case}, {scheme}, {relative:e}: {sum}");
        }
    }
}

/// Order 2, with its many steps.
#[test]
fn the_errors_of_steps_of_order_2_add_up_to_the_tolerance() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let [sum, _] = errors(|| single_pendulum_scene().0, scheme, 1e-6, 0.25);
        assert!((SUMS[0]..=SUMS[1]).contains(&sum), "{scheme}: {sum}");
    }
}

/// The examples of the page about choosing: fast conduction damps the errors of the steps, whose sum says nothing then; a
/// double pendulum amplifies them.
#[test]
fn motions_damp_errors_or_amplify_them() {
    let [romero, krueger, _] = DoublePendulum::ALL;
    // What is left at one end depends on where its last step falls, and so on rounding; at most ends it is little.
    let mut left = [3.0, 4.0, 5.0, 6.0, 8.0].map(|end| {
        let [sum, left] = errors(|| romero.scene().0, Scheme::EemExplicit, 1e-8, end);
        assert!(sum > 3.0, "{end}: {sum}");
        left
    });
    left.sort_by(f64::total_cmp);
    assert!(left[2] < 0.01, "{left:?}");
    let long = |end| errors(|| krueger.scene().0, Scheme::EemExplicit, 1e-8, end)[1];
    let [early, late] = [2.0, 20.0].map(long);
    assert!(late > 100.0 * early, "{early} {late}");
}

/// Ovens act through the middle of a step in schemes of every order; an element follows one by
///
/// ```text
/// θ̇ = r (θ_oven − θ),   θ_oven = 300 + a sin ωt:   θ = 300 + a (r² sin ωt − rω cos ωt + rω e^(−rt))/(r² + ω²)
/// ```
///
/// Both where the mean of the oven over a step limits it, and where the oven changes slowly beside the element.
#[test]
fn the_temperature_of_an_oven_is_followed_to_the_tolerance() {
    let end = 4.0;
    for ([rate, omega, swing], relative) in [
        ([2.0, 3.0, 50.0], 1e-4),
        ([2.0, 3.0, 50.0], 1e-6),
        ([5.322, 0.212, 23.33], 1.5e-6),
        ([20.0, 1.0, 100.0], 1e-5),
    ] {
        for scheme in [
            Scheme::EemEntropy4,
            Scheme::EemEntropy6,
            Scheme::EemExplicit,
            Scheme::Auto,
        ] {
            let mut scene = Scene::<1>::new();
            let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
            let wire = ThermoelasticSpring {
                stiffness: 1.0,
                coupling: 0.0,
                capacity: 2.0,
                natural_length: 1.0,
                theta_ref: 300.0,
            };
            let wire = scene.spring(wire, ends);
            scene.set_temperature(wire, 300.0);
            let oven = scene.oven(move |t| 300.0 + swing * (omega * t).sin());
            scene.conduct(wire, oven, 2.0 * rate);
            let mut run = Simulation::new(scene, scheme, 0.01).unwrap();
            run.control_steps(Tolerance::new(relative)).unwrap();
            run.run_until(end).unwrap();
            let (sin, cos) = f64::sin_cos(omega * end);
            let rest = rate * omega * f64::exp(-rate * end);
            let sum = rate * rate * sin - rate * omega * cos + rest;
            let exact = 300.0 + swing * sum / (rate * rate + omega * omega);
            let error = (run.temperature(wire).unwrap() / exact - 1.0).abs() / relative;
            // The mean of every step is right to one tolerance, what it lags behind, too; the scheme's own errors add to it.
            assert!(
                error < 4.0,
                "{scheme}, {rate}, {relative:e}: {error} tolerances"
            );
        }
    }
}

/// A loose tolerance is one, too: the halves of a step pass over no whole period, in which both would be wrong by an amplitude.
#[test]
fn steps_of_loose_tolerances_follow_the_motion() {
    let stiffness = 3e3;
    let period = core::f64::consts::TAU / f64::sqrt(stiffness);
    for scheme in [
        Scheme::EemEntropy,
        Scheme::EemEntropy4,
        Scheme::EemEntropy6,
        Scheme::EemExplicit,
    ] {
        for relative in [0.4, 0.2, 0.1, 0.05] {
            let mut scene = Scene::<1>::new();
            let mass = scene.mass(1.0, [0.0], [0.5]);
            let ends = [scene.anchor([-1.0]), mass];
            let spring = hooke(stiffness, 0.9);
            scene.spring(spring, ends);
            scene.dead_load(mass, [1.0]);
            scene.set_gravity([-9.0]);
            let tolerance = Tolerance::new(relative);
            let mut run = Simulation::with_tolerance(scene, scheme, tolerance).unwrap();
            let mut last = 0.0;
            for _ in 0..200 {
                run.step().unwrap();
                let step = run.time() - last;
                assert!(step <= 2.0 * period, "{scheme}, {relative}: {step} s");
                last = run.time();
            }
        }
    }
}

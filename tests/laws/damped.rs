//! The damped scheme: decays in steps of any size, and its laws recomputed from temperatures.

mod dashpots;

use eem::prelude::*;
use eem_testkit::random::Random;

/// A body of constant heat capacity with a Maxwell branch:
/// `e = c (θ − 300) + ½ μ (λ − 1 − γ)²`, `s = c ln(θ/300)`.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma: Viscous, theta: Temperature| {
    0.5 * mu * (lambda - 1 - gamma).powi(2) + c * (theta - 300 - theta * ln(theta / 300))
})]
#[viscosity(gamma = eta)]
struct Body {
    mu: f64,
    eta: f64,
    c: f64,
}

/// A body between two anchors at this distance.
fn held(scene: &mut Scene<1>, body: Body, length: f64, theta: f64) -> Element {
    let ends = [0.0, length].map(|q| scene.anchor([q]));
    let element = scene.spring(body, ends);
    scene.set_temperature(element, theta);
    element
}

const fn unstrained(c: f64) -> Body {
    Body {
        mu: 1.0,
        eta: 1.0,
        c,
    }
}

/// Differences of temperature far below the temperatures, for which the conduction is linear.
#[test]
fn two_bodies_decay_exactly_in_steps_of_any_size() {
    const SMALL: f64 = 1e-5;
    for x in [1e-3, 0.1, 1.0, 2.0, 3.0, 10.0, 1e3, 1e7] {
        let (c, kappa) = ([15.0, 4.0], 50.0);
        let mut scene = Scene::<1>::new();
        let hot = held(&mut scene, unstrained(c[0]), 1.0, 300.0 + SMALL);
        let cold = held(&mut scene, unstrained(c[1]), 1.0, 300.0);
        scene.conduct(hot, cold, kappa);
        let step = x / (kappa * (1.0 / c[0] + 1.0 / c[1]));
        let mut run = Simulation::new(scene, Scheme::EemDamped, step).unwrap();
        run.step().unwrap();
        let [hot, cold] = [hot, cold].map(|body| run.temperature(body).unwrap());
        // Heat flows are linear up to Δθ/θ, and temperatures have a rounding each.
        let error = SMALL * SMALL / 300.0 + 4.0 * f64::EPSILON * 300.0;
        let expected = SMALL * (-x).exp();
        assert!(
            (hot - cold - expected).abs() <= error,
            "x = {x}: {}",
            hot - cold
        );
    }
}

/// As [`two_bodies_decay_exactly_in_steps_of_any_size`], for a body and a reservoir that is much colder: where steps are long, it
/// has the temperature of the reservoir after one of them.
#[test]
fn a_hot_body_takes_the_temperature_of_a_reservoir_in_one_long_step() {
    for theta in [320.0, 1200.0, 3000.0] {
        let mut scene = Scene::<1>::new();
        let body = held(&mut scene, unstrained(15.0), 1.0, theta);
        let air = scene.reservoir(300.0);
        scene.conduct(body, air, 1e6);
        let mut run = Simulation::new(scene, Scheme::EemDamped, 1e3).unwrap();
        run.step().unwrap();
        // α = ½ − 1/x, with x = hκ/c = 6.7e7, times a difference of temperatures of at most 2700 K.
        let error = 3.0 * 2700.0 / 6.7e7;
        assert!((run.temperature(body).unwrap() - 300.0).abs() <= error);
    }
}

/// Networks of bodies of very different capacities and conductances, some in air and one at a thermostat, with steps from far
/// below their relaxation times to far above.
#[test]
fn random_networks_keep_both_laws_and_come_to_rest_for_any_step() {
    let mut random = Random::new(45);
    let mut power = |low: f64, high: f64| 10.0_f64.powf(low + (high - low) * random.unit());
    for case in 0..120 {
        let mut scene = Scene::<1>::new();
        let count = 2 + case % 7;
        let capacities: Vec<f64> = (0..count).map(|_| power(-2.0, 2.0)).collect();
        let bodies: Vec<Element> = capacities
            .iter()
            .map(|&c| held(&mut scene, unstrained(c), 1.0, 300.0 * power(-0.3, 0.3)))
            .collect();
        for (index, &body) in bodies.iter().enumerate().skip(1) {
            scene.conduct(body, bodies[index - 1], power(-2.0, 4.0));
            scene.conduct(body, bodies[index / 2], power(-2.0, 4.0));
        }
        let air = (case % 3 != 0).then(|| scene.reservoir(290.0));
        if let Some(air) = air {
            scene.conduct(bodies[0], air, power(-2.0, 4.0));
        }
        let step = power(-6.0, 6.0);
        let mut run = Simulation::new(scene, Scheme::EemDamped, step).unwrap();
        let totals = |run: &Simulation<1>| {
            let mut sums = [0.0; 3];
            for (&body, &c) in bodies.iter().zip(&capacities) {
                let theta = run.temperature(body).unwrap();
                sums[0] += c * theta;
                sums[1] += c * (theta / 300.0).ln();
                sums[2] += c * (theta + 1.0);
            }
            let heat = run.ledger().reservoir_heat;
            [sums[0] + heat, sums[1] + heat / 290.0, sums[2] + heat.abs()]
        };
        let mut before = totals(&run);
        for _ in 0..40 {
            let report = run.step().unwrap();
            let after = totals(&run);
            // Each sum has a few roundings of its terms, which are below those of `Σ c (θ + 1)`.
            let rounding = 16.0 * f64::EPSILON * (before[2] + after[2]);
            assert!(
                (after[0] - before[0]).abs() <= rounding,
                "case {case}, {after:?}"
            );
            assert!(
                after[1] - before[1] >= -rounding / 100.0,
                "case {case}, {after:?}"
            );
            let produced = (after[1] - before[1]) - report.production;
            assert!(
                produced.abs() <= rounding / 100.0,
                "case {case}: {produced}"
            );
            assert!(report.least_production >= 0.0);
            before = after;
        }
        if step > 1e5 {
            let first = run.temperature(bodies[0]).unwrap();
            for &body in &bodies {
                // 40 steps of at least a relaxation time each.
                let theta = run.temperature(body).unwrap();
                assert!(
                    (theta - first).abs() <= 1e-9 * first,
                    "case {case}: {theta}, {first}"
                );
            }
        }
    }
}

/// Temperatures between two reservoirs are linear along a bar, as without damping.
#[test]
fn steady_states_are_those_of_the_equations() {
    let mut scene = Scene::<1>::new();
    let bodies: Vec<Element> = (0..9)
        .map(|_| held(&mut scene, unstrained(2.0), 1.0, 400.0))
        .collect();
    for pair in bodies.windows(2) {
        scene.conduct(pair[1], pair[0], 1e3);
    }
    let ends = [300.0, 400.0].map(|theta| scene.reservoir(theta));
    scene.conduct(bodies[0], ends[0], 1e3);
    scene.conduct(bodies[8], ends[1], 1e3);
    let mut run = Simulation::new(scene, Scheme::EemDamped, 10.0).unwrap();
    for _ in 0..60 {
        run.step().unwrap();
    }
    for (body, index) in bodies.iter().zip(1..) {
        let expected = 300.0 + 10.0 * f64::from(index);
        let theta = run.temperature(*body).unwrap();
        assert!((theta - expected).abs() <= 1e-10 * expected, "{theta}");
    }
}

/// Springs and dashpots with temperatures between masses that move, in air and at a thermostat, with steps beyond the relaxation
/// times of conduction.
#[test]
fn moving_scenes_keep_their_books() {
    for step in [0.01, 0.1] {
        let (mut scene, [_, bob, _], [warm, kept]) = crate::support::in_air();
        let hall = scene.reservoir(280.0);
        scene.conduct(warm, hall, 1e4);
        scene.prescribe_temperature(kept, |t| 310.0 + 5.0 * t.sin());
        scene.force(bob, |t| [(3.0 * t).sin(), 0.2]);
        let mut run = Simulation::new(scene, Scheme::EemDamped, step).unwrap();
        let before = run.ledger();
        for _ in 0..40 {
            let report = run.step().unwrap();
            assert!(report.least_production >= 0.0);
        }
        let after = run.ledger();
        let size = before.energy.abs()
            + after.work.abs()
            + after.heat.abs()
            + 1e3 * after.internal_energy.abs();
        assert!((after.balance - before.balance).abs() <= 40.0 * 64.0 * f64::EPSILON * size);
    }
}

/// A factor of a step is negative where `hκ (1/c + 1/c) > 2`, or `hk/η > 2`.
#[test]
fn a_step_counts_what_it_does_not_resolve() {
    let schemes = crate::support::EXACT.into_iter();
    for scheme in schemes.filter(|scheme| !matches!(scheme, Scheme::EemExplicit | Scheme::Auto)) {
        let is_damped = scheme == Scheme::EemDamped;
        for (kappa, eta, conductions, dashpots) in [
            (14.9, 0.51, 0, 0),
            (15.1, 0.51, 2, 0),
            (14.9, 0.49, 0, 2),
            (15.1, 0.49, 2, 2),
        ] {
            let expected = if is_damped { 0 } else { conductions + dashpots };
            let mut scene = Scene::<1>::new();
            let body = Body {
                mu: 1.0,
                eta,
                c: 15.0,
            };
            let [hot, cold] =
                [301.0, 300.0].map(|theta| held(&mut scene, body.clone(), 1.0, theta));
            scene.conduct(hot, cold, kappa);
            let mut run = Simulation::new(scene, scheme, 1.0).unwrap();
            for steps in 1..3 {
                assert_eq!(run.step().unwrap().unresolved, expected, "{scheme}");
                assert_eq!(run.ledger().unresolved, steps * expected as u64);
            }
            assert_eq!(run.warning().is_some(), expected > 0, "{scheme}");
        }
    }
}

//! Dashpots that relax faster than a step, alone, coupled, beside conduction and moved by masses.

use eem::prelude::*;
use eem_testkit::random::Random;

use super::{Body, held};

/// Two dashpots that springs couple, `½ a (λ − 1 − γ₁)² + ½ b (γ₁ − γ₂)² + ½ c γ₂²`.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, gamma1: Viscous, gamma2: Viscous| {
    0.5 * a * (lambda - 1 - gamma1).powi(2) + 0.5 * b * (gamma1 - gamma2).powi(2) + 0.5 * c * gamma2.powi(2)
})]
#[viscosity(gamma1 = eta1, gamma2 = eta2)]
struct Ladder {
    a: f64,
    b: f64,
    c: f64,
    eta1: f64,
    eta2: f64,
}

/// A branch of τ = 10 ms, held at a strain of 0.1.
fn strained() -> (Scene<1>, Element) {
    let body = Body {
        mu: 1e3,
        eta: 10.0,
        c: 15.0,
    };
    let mut scene = Scene::new();
    let element = held(&mut scene, body, 1.1, 300.0);
    (scene, element)
}

/// The strain of the spring of a branch.
fn left(run: &Simulation<1>, element: Element) -> f64 {
    run.stretch(element).unwrap() - 1.0 - run.viscous_stretch(element, 0).unwrap()
}

/// `e = c (θ − 300) + ½ μ s²` and `s = c ln(θ/300)` at every step, from the states.
#[test]
fn a_held_dashpot_decays_exactly_and_its_heat_closes_both_laws() {
    for x in [1e-3, 0.5, 2.0, 20.0, 1e3, 1e9] {
        let (scene, element) = strained();
        let mut run = Simulation::new(scene, Scheme::EemDamped, 0.01 * x).unwrap();
        let start = 0.5 * 1e3 * (run.stretch(element).unwrap() - 1.0).powi(2);
        for step in 1..4 {
            let before = run.temperature(element).unwrap();
            let report = run.step().unwrap();
            assert!(report.iterations <= 4, "x = {x}: {}", report.iterations);
            let left = left(&run, element);
            let expected = 0.1 * (-x * f64::from(step)).exp();
            assert!(
                (left - expected).abs() <= 4.0 * f64::EPSILON,
                "x = {x}: {left:e}"
            );
            let theta = run.temperature(element).unwrap();
            let energy = 15.0 * (theta - 300.0) + 0.5 * 1e3 * left * left;
            // The temperature has a rounding, times c.
            let rounding = 4.0 * f64::EPSILON * 15.0 * 300.0;
            assert!(
                (energy - start).abs() <= rounding,
                "x = {x}: {:e}",
                energy - start
            );
            let produced = 15.0 * (theta / before).ln();
            assert!((produced - report.production).abs() <= rounding / 100.0);
            assert!(report.least_production >= 0.0 && report.unresolved == 0);
        }
    }
}

/// In the step h, the stretches of coupled dashpots are those of sixth order with 1000 steps; in long ones they are at rest.
#[test]
fn coupled_dashpots_decay_in_their_modes() {
    let scene = || {
        let mut scene = Scene::<1>::new();
        let ends = [0.0, 1.1].map(|q| scene.anchor([q]));
        let ladder = Ladder {
            a: 1e3,
            b: 10.0,
            c: 5.0,
            eta1: 1.0,
            eta2: 3.0,
        };
        let element = scene.spring(ladder, ends);
        (scene, element)
    };
    let stretches = |scheme, step, steps| {
        let (scene, element) = scene();
        let mut run = Simulation::new(scene, scheme, step).unwrap();
        for _ in 0..steps {
            run.step().unwrap();
        }
        [0, 1].map(|k| run.viscous_stretch(element, k).unwrap())
    };
    for step in [0.01, 0.3] {
        let own = stretches(Scheme::EemDamped, step, 1);
        let fine = stretches(Scheme::EemEntropy6, step / 1000.0, 1000);
        for k in 0..2 {
            assert!((own[k] - fine[k]).abs() < 1e-13, "{own:?}, {fine:?}");
        }
    }
    let [first, second] = stretches(Scheme::EemDamped, 1e4, 1);
    // a (0.1 − γ₁) = b (γ₁ − γ₂) = c γ₂
    let force = 0.1 / (1.0 / 1e3 + 1.0 / 10.0 + 1.0 / 5.0);
    assert!((first - (0.1 - force / 1e3)).abs() < 1e-14 && (second - force / 5.0).abs() < 1e-14);
}

/// A mass that a constant force pulls through a dashpot: `v = F/η`, however fast the dashpot relaxes.
#[test]
fn a_dashpot_that_creeps_steadily_keeps_its_force() {
    let mut scene = Scene::<1>::new();
    let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [2.0])];
    let branch = Body {
        mu: 1e4,
        eta: 10.0,
        c: 15.0,
    };
    let element = scene.spring(branch, ends);
    scene.set_temperature(element, 300.0);
    // The spring of the branch bears the force already.
    scene.set_viscous_stretch(element, 0, -20.0 / 1e4);
    scene.dead_load(ends[1], [20.0]);
    let mut run = Simulation::new(scene, Scheme::EemDamped, 0.1).unwrap();
    run.run_until(5.0).unwrap();
    // h k/η = 100
    let moved = run.position(ends[1]).unwrap()[0] - 1.0;
    assert!((moved - 2.0 * 5.0).abs() < 1e-12, "{moved}");
    let force = 1e4 * (moved - run.viscous_stretch(element, 0).unwrap());
    assert!((force - 20.0).abs() < 1e-9, "{force}");
    assert_eq!(run.warning(), None);
}

/// A mass on a branch whose dashpot relaxes in 1 s to 1 ms, beside an elastic spring, and heat between both.
fn swinging(eta: f64, scheme: Scheme, steps: u32) -> [f64; 3] {
    let mut scene = Scene::<1>::new();
    let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.5])];
    let [branch, elastic] = [eta, 1e9].map(|eta| {
        let body = Body {
            mu: 40.0,
            eta,
            c: 2.0,
        };
        let element = scene.spring(body, ends);
        scene.set_temperature(element, 300.0);
        element
    });
    scene.conduct(branch, elastic, 1.0);
    let mut run = Simulation::new(scene, scheme, f64::from(steps).recip()).unwrap();
    for _ in 0..steps {
        let report = run.step().unwrap();
        assert!(report.iterations <= 5, "η = {eta}: {}", report.iterations);
    }
    [
        run.position(ends[1]).unwrap()[0],
        run.viscous_stretch(branch, 0).unwrap(),
        run.temperature(branch).unwrap(),
    ]
}

#[test]
fn errors_fall_with_the_square_of_the_step() {
    for eta in [40.0, 4.0, 0.4] {
        let exact = swinging(eta, Scheme::EemEntropy6, 500);
        let errors = [320, 640].map(|steps| {
            let own = swinging(eta, Scheme::EemDamped, steps);
            [0, 1, 2].map(|index| (own[index] - exact[index]).abs())
        });
        for (coarse, fine) in errors[0].iter().zip(errors[1]) {
            let order = (coarse / fine).log2();
            assert!((order - 2.0).abs() < 0.15, "η = {eta}: {errors:?}");
        }
    }
}

/// Chains of masses with branches and conductions that relax in times from far below the step to far above it.
#[test]
fn random_chains_keep_both_laws_and_momentum() {
    let mut random = Random::new(46);
    let mut power = |low: f64, high: f64| 10.0_f64.powf(low + (high - low) * random.unit());
    for case in 0..40 {
        let mut scene = Scene::<2>::new();
        let count = 3 + case % 4;
        let nodes: Vec<Node> = (0..count)
            .map(|index| {
                let velocity = [0.3 * (power(-1.0, 0.0) - 0.5), power(-2.0, -1.0)];
                scene.mass(
                    power(-1.0, 1.0),
                    [f64::from(index), 0.1 * power(-1.0, 0.0)],
                    velocity,
                )
            })
            .collect();
        let bodies: Vec<Element> = nodes
            .windows(2)
            .map(|ends| {
                let body = Body {
                    mu: power(0.0, 4.0),
                    eta: power(-4.0, 4.0),
                    c: power(-1.0, 2.0),
                };
                let element = scene.spring(body, [ends[0], ends[1]]);
                scene.set_temperature(element, 300.0 * power(-0.1, 0.1));
                element
            })
            .collect();
        for pair in bodies.windows(2) {
            scene.conduct(pair[0], pair[1], power(-2.0, 4.0));
        }
        let step = power(-3.0, -1.0);
        let mut run = Simulation::new(scene, Scheme::EemDamped, step).unwrap();
        let mut before = run.ledger();
        for _ in 0..20 {
            let report = run.step().unwrap();
            assert!(report.least_production >= 0.0, "case {case}");
            let after = run.ledger();
            assert!(
                (after.energy - before.energy).abs() <= 2.0 * report.bound,
                "case {case}"
            );
            let [old, new] = [&before, &after].map(|sheet| sheet.element_entropy_of_state);
            // Of c ln(θ/300) and of the temperatures in it, in at most five bodies of 100 J/K.
            let rounding = 64.0 * f64::EPSILON * (new.abs() + 5e2);
            assert!(new - old >= -rounding, "case {case}: {:e}", new - old);
            let drift = (after.linear_momentum - before.linear_momentum).norm();
            assert!(drift <= 1e-12, "case {case}: {drift:e}");
            before = after;
        }
    }
}

/// `Auto` with constant steps takes the damped scheme beyond a relaxation time, and another one once more with a tolerance.
#[test]
fn auto_damps_constant_steps_that_do_not_resolve_a_dashpot() {
    for (step, expected) in [(0.02, Scheme::EemExplicit), (2.0, Scheme::EemDamped)] {
        let (scene, element) = strained();
        let mut run = Simulation::new(scene, Scheme::Auto, step).unwrap();
        assert_eq!(run.scheme_in_use(), Scheme::EemExplicit);
        run.fix_steps();
        assert_eq!(run.scheme_in_use(), expected);
        let report = run.step().unwrap();
        let saved = run.checkpoint();
        run.step().unwrap();
        run.restore(&saved).unwrap();
        assert_eq!((run.scheme_in_use(), report.unresolved), (expected, 0));
        let left = left(&run, element);
        assert!((left - 0.1 * (-step / 0.01).exp()).abs() < 1e-6);
        run.control_steps(Tolerance::new(1e-6)).unwrap();
        assert_eq!(run.scheme_in_use(), Scheme::EemExplicit);
        run.step().unwrap();
    }
}

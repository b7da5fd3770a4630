//! Kind 3: ratios of stiffness, of mass and of viscosity, and the rigid limits that they approach.

use eem::prelude::*;

use super::findings::{on_anchor, sprung, two_dashpots, two_linear_dashpots};
use super::models::{LogarithmicStiffness, TwoDashpots, hooke};
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, FORMS, Watched};
use super::world::World;

pub(crate) const FAMILIES: &[Family] = &[
    stiffness_ratios,
    mass_ratios,
    viscosities,
    limits_of_dashpots,
    near_rigid_pendulum,
    central_springs,
];

/// A free chain of five masses with soft and stiff springs in turn, in slow rotation.
fn chain(scheme: Scheme, stiffnesses: [f64; 2], step: f64) -> Watched<2> {
    let mut world = World::new();
    let places = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|x: f64| [x, 0.1 * x * x]);
    let masses = places.map(|place| world.mass(1.0, place, [0.1, 0.3 * place[0]]));
    for (i, ends) in masses.windows(2).enumerate() {
        let stiffness = stiffnesses[i % 2];
        // Slack at the start: what turns the chain stretches it.
        let [a, b] = [places[i], places[i + 1]];
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        world.spring(hooke(stiffness, length), [ends[0], ends[1]]);
    }
    world.start(scheme, step).expect("a sound scene")
}

fn stiffness_ratios(effort: Effort) -> Tally {
    let mut tally = Tally::new("free chain of 5 masses, springs k = 1 and 1 … 1e12 N/m, h = 0.1 s");
    let steps = effort.of([5, 30, 10_000]);
    for scheme in EXACT {
        for exponent in 0..=12 {
            let stiff = 10.0_f64.powi(exponent);
            let mut watched = chain(scheme, [1.0, stiff], 0.1);
            let label = format!("k = 1, 1e{exponent}, {}", scheme.name());
            tally.add_complete(label, watched.steps(steps));
        }
    }
    tally
}

fn mass_ratios(effort: Effort) -> Tally {
    let mut tally =
        Tally::new("double pendulum of masses 1 and 1e-9 … 1e9 kg on Hooke springs, k = 100 N/m");
    let steps = effort.of([5, 30, 10_000]);
    let hooke = hooke(100.0, 1.0);
    for scheme in EXACT {
        for exponent in -9..=9 {
            let ratio = 10.0_f64.powi(exponent);
            let mut world = World::<2>::new();
            let anchor = world.anchor([0.0; 2]);
            let first = world.mass(1.0, [1.1, 0.0], [0.0, 0.5]);
            let second = world.mass(ratio, [1.9, 0.5], [0.0, -0.5]);
            world.spring(hooke, [anchor, first]);
            world.spring(hooke, [first, second]);
            let mut watched = world.start(scheme, 0.02).expect("a sound scene");
            let label = format!("m₂/m₁ = 1e{exponent}, {}", scheme.name());
            tally.add_complete(label, watched.steps(steps));
        }
    }
    tally
}

pub(crate) fn viscosities(effort: Effort) -> Tally {
    let mut tally =
        Tally::new("two dashpots η = 1e-12 … 1e12 N s/m on a thermoelastic spring, h = 0.2 s");
    let steps = effort.of([2, 20, 1000]);
    let stride = effort.of([6, 1, 1]);
    for scheme in EXACT {
        for exponent in (-12..=12).step_by(stride) {
            let eta = 10.0_f64.powi(exponent);
            let runs = [two_dashpots(scheme, eta), two_linear_dashpots(scheme, eta)];
            for (strain, mut watched) in ["ln λ", "λ − l"].into_iter().zip(runs) {
                let label = format!("{strain}, η = 1e{exponent}, {}", scheme.name());
                tally.add_swift(label, watched.steps(steps), scheme);
            }
        }
    }
    tally
}

/// A mass on the element of finding 5 whose dashpots start without force, or on its limit.
fn started_relaxed(scheme: Scheme, eta: f64) -> Watched<2> {
    let model = TwoDashpots {
        a: 0.0,
        n: 0.0,
        ..TwoDashpots::of_viscosity(eta)
    };
    let element = |world: &mut World<2>, ends| {
        let element = world.warm(model, ends, 300.0);
        for dashpot in 0..2 {
            world.set_viscous_stretch(element, dashpot, 1.5_f64.ln());
        }
    };
    let world = on_anchor(element, [1.5, 0.0], [0.0, 1.0]);
    world.start(scheme, LIMIT_STEP).expect("a sound scene")
}

const LIMIT_STEP: f64 = 0.02;

/// How close γ follows its limit: off by η γ̇/k₁ or by t g/η, 1e-12 of its size, magnified by the phase
/// ω t ≤ 50 of the run, and by two more digits for the cooling of one element and not of the other.
const LIMIT: f64 = 1e-8;

fn limits_of_dashpots(effort: Effort) -> Tally {
    let mut tally = Tally::new(
        "limits η → 0 and η → ∞ of two dashpots started at g = 0: thermoelastic springs",
    );
    let steps = effort.of([5, 50, 50]);
    let spring = |world: &mut World<2>, ends| {
        let data = TwoDashpots::of_viscosity(1.0);
        // η = 0: the branches never pull.
        let soft = LogarithmicStiffness {
            stiffness: data.stiffness,
            softening: 0.0,
            coupling: data.coupling,
            capacity: data.capacity,
            length: data.length,
            theta_ref: data.theta_ref,
        };
        world.warm(soft, ends, 300.0);
    };
    // η = ∞: the branches are springs at rest in the initial state. They take no heat.
    let frozen = |world: &mut World<2>, ends: [Node; 2]| {
        spring(world, ends);
        world.spring(
            super::models::Hencky {
                stiffness: 130.0,
                length: 1.5,
            },
            ends,
        );
    };
    for scheme in FORMS {
        let limits = [
            (1e-12, on_anchor(spring, [1.5, 0.0], [0.0, 1.0])),
            (1e12, on_anchor(frozen, [1.5, 0.0], [0.0, 1.0])),
        ];
        for (eta, limit) in limits {
            let mut limit = limit.start(scheme, LIMIT_STEP).expect("a sound scene");
            let mut watched = started_relaxed(scheme, eta);
            let label = format!("η = {eta:e}, {}", scheme.name());
            tally.add_complete(format!("limit of {label}"), limit.steps(steps));
            tally.add_complete(&label, watched.steps(steps));
            let [a, b] = [&watched, &limit].map(|run| run.stored().positions.clone());
            let off: f64 = a.iter().zip(&b).map(|(&a, &b)| (a - b).value().abs()).sum();
            tally.claim(
                off < LIMIT,
                format!("{label}: {off:e} m away from its limit"),
            );
        }
    }
    tally
}

/// `T = 4 √(L/g) K(sin 45°)`, s, and half a unit of its last digit.
const PERIOD: [f64; 2] = [2.367_84, 5e-6];

/// What the discrete period is longer by, over h², 1/s. In a step the rigid pendulum turns by
/// `α = 2 atan(h (ω⁰ + ω¹)/4)` and its speed at the ends is exact, so that it lags by
/// `h²/12 (ω² − ω''/ω) = h² ω²/8` of the time; over a period that is
/// `h²/8 ∮ ω dφ = h²/4 √(2g/L) ∫₀^π √sin φ dφ`, with 2.396 28 for the integral.
const LAG: f64 = 2.653_6;
/// What the next power of h and the interpolation may add, relative to the lag.
const LAG_ERROR: f64 = 0.02;

fn near_rigid_pendulum(effort: Effort) -> Tally {
    let mut tally = Tally::new(
        "pendulum of 1 m, EA = 1e8 N, released horizontally: period 2.36784 s + 2.654 h²/s",
    );
    let hooke = sprung(hooke(1e8, 1.0));
    for scheme in EXACT {
        for step in effort.of([
            &[0.05][..],
            &[0.05, 0.02, 0.01],
            &[0.05, 0.02, 0.01, 0.005, 0.001],
        ]) {
            let mut world = on_anchor(hooke, [1.0, 0.0], [0.0, 0.0]);
            world.set_gravity([0.0, -9.81]);
            let mut watched = world.start(scheme, *step).expect("a sound scene");
            let period = second_return(&mut watched);
            let label = format!("h = {step}, {}", scheme.name());
            tally.add_complete(&label, &watched.record);
            let lag = LAG * step * step;
            let error = (period - PERIOD[0] - lag).abs();
            tally.claim(
                error < LAG_ERROR * lag + PERIOD[1],
                format!("{label}: period {period} s"),
            );
            if scheme == Scheme::EemEntropy {
                tally.note(format!("h = {step} s: {period:.5} s"));
            }
        }
    }
    tally
}

/// The time at which the angular momentum changes its sign for the second time, by interpolation: at the
/// points of return it is linear in time. NaN if the run is refused before.
fn second_return(watched: &mut Watched<2>) -> f64 {
    let mut returns = 0;
    let mut before = 0.0;
    while let Ok(report) = watched.step() {
        let now = watched.run.ledger().angular_momentum[2];
        if before * now < 0.0 {
            returns += 1;
            if returns == 2 {
                return report.time - report.step * now / (now - before);
            }
        }
        before = now;
    }
    f64::NAN
}

fn central_springs(effort: Effort) -> Tally {
    let mut tally =
        Tally::new("mass about a centre, ψ = ½k (r − 1)², k = 1e2 … 1e10 N/m, h = 0.05 s");
    let steps = effort.of([5, 30, 10_000]);
    for scheme in EXACT {
        for exponent in 2..=10 {
            let stiffness = 10.0_f64.powi(exponent);
            let hooke = sprung(hooke(stiffness, 1.0));
            // Started at rest in the radial direction, a little outside of the circle of balance.
            let radius = 1.0 + 2.0 / stiffness;
            let world = on_anchor(hooke, [radius, 0.0], [0.0, 1.0]);
            let mut watched = world.start(scheme, 0.05).expect("a sound scene");
            let label = format!("k = 1e{exponent}, {}", scheme.name());
            tally.add_complete(label, watched.steps(steps));
        }
    }
    tally
}

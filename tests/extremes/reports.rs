//! What a step reports is true of the states that it stores, also near singular forces and in steep transitions:
//! the energy is within the reported bound, and temperatures have the entropies that are kept.

use eem::Tolerance;
use eem::prelude::*;
use eem_testkit::length::at_length;

use super::model::{Model, model};
use super::models::{Maxwell, hooke};
use super::random::Random;
use super::watched::Watched;
use super::world::World;

model! {
    /// Finitely extensible nonlinear elastic dumbbell (Warner 1972): its force is infinite at the limit.
    Chain { stiffness, limit } (lambda: Stretch) {
        -(0.5 * stiffness * limit.powi(2) * ln(1.0 - (lambda / limit).powi(2)))
    }
}

model! {
    /// Lennard-Jones (1931).
    Atoms { depth, size } (lambda: Stretch) {
        4.0 * depth * ((size / lambda).powi(12) - (size / lambda).powi(6))
    }
}

model! {
    /// A capacity that rises by `1 + rise` within a small part of the temperature, as `tanh` does.
    Transition { stiffness, length, capacity, rise, centre, width } (lambda: Stretch, theta: Temperature) {
        0.5 * stiffness * (lambda - length).powi(2)
            + capacity * (theta - theta * ln(theta / centre))
            - rise * capacity * width * ln(1.0 + exp((theta - centre) / width))
    }
}

model! {
    /// A stiffness that falls within a small part of the temperature.
    Softening { stiffness, drop, length, capacity, centre, width } (lambda: Stretch, theta: Temperature) {
        0.5 * (stiffness + drop / (1.0 + exp((theta - centre) / width)))
            * (lambda - length).powi(2)
            + capacity * (theta - centre - theta * ln(theta / centre))
    }
}

model! {
    /// Terms that cancel near λ = l for an offset of k l; no form of it could know.
    Cancelling { stiffness, length, offset } (lambda: Stretch) {
        stiffness * (lambda - length * ln(lambda / length)) - offset
    }
}

/// A mass of 1 kg at (length, 0) on an anchor.
fn held<M: Model>(model: M, length: f64, velocity: [f64; 2], theta: Option<f64>) -> World<2> {
    let mut world = World::new();
    let anchor = world.anchor([0.0, 0.0]);
    let mass = world.mass(1.0, [length, 0.0], velocity);
    match theta {
        Some(theta) => world.warm(model, [anchor, mass], theta),
        None => world.spring(model, [anchor, mass]),
    };
    world
}

/// What is broken by a few steps from each of many starts.
fn broken(
    schemes: &[(Scheme, Option<f64>)],
    starts: u64,
    start: impl Fn(&mut Random) -> (World<2>, f64),
) -> Vec<String> {
    let mut broken = Vec::new();
    for &(scheme, tolerance) in schemes {
        let mut steps = 0;
        for seed in 0..starts {
            let (world, step) = start(&mut Random::new(seed));
            let mut watched: Watched<2> = world.start(scheme, step).expect("a sound scene");
            if let Some(tolerance) = tolerance {
                let tolerance = Tolerance::new(tolerance);
                watched.run.control_steps(tolerance).expect("controlled");
            }
            let record = watched.steps(3);
            steps += record.steps;
            let label = |law: &String| format!("{}, seed {seed}: {law}", scheme.name());
            broken.extend(record.broken.iter().map(label));
        }
        assert!(steps > 0, "{} takes none of the steps", scheme.name());
    }
    broken
}

const SCHEMES: [(Scheme, Option<f64>); 5] = [
    (Scheme::EemTemperature, None),
    (Scheme::EemEntropy, None),
    (Scheme::EemEntropy4, None),
    (Scheme::EemExplicit, None),
    (Scheme::EemExplicit, Some(1e-6)),
];

fn assert_none(broken: &[String]) {
    let first: Vec<&str> = broken.iter().take(5).map(String::as_str).collect();
    assert!(first.is_empty(), "{}:\n{}", broken.len(), first.join("\n"));
}

#[test]
fn energies_near_the_limit_of_a_chain_are_within_the_reported_bound() {
    assert_none(&broken(&SCHEMES, at_length(200, 80), |random| {
        let limit = 1.0 + random.unit();
        let length = limit * (1.0 - random.decades(1e-5, 1e-2));
        let chain = Chain {
            stiffness: random.decades(1e-2, 1e4),
            limit,
        };
        let velocity = [random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)];
        let world = held(chain, length, velocity, None);
        (world, random.decades(1e-6, 1e-2))
    }));
}

#[test]
fn energies_of_atoms_that_are_pressed_are_within_the_reported_bound() {
    assert_none(&broken(&SCHEMES, at_length(200, 80), |random| {
        let size = 1.0 + random.unit();
        let atoms = Atoms {
            depth: random.decades(1e-3, 1e2),
            size,
        };
        let length = size / random.uniform(1.0, 5.0);
        let velocity = [random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)];
        let world = held(atoms, length, velocity, None);
        (world, random.decades(1e-6, 1e-1))
    }));
}

#[test]
fn temperatures_in_a_steep_transition_have_the_entropy_that_is_kept() {
    let schemes = [
        (Scheme::Auto, Some(1e-5)),
        (Scheme::EemExplicit, Some(1e-4)),
        (Scheme::EemExplicit, None),
        (Scheme::EemTemperature, None),
    ];
    assert_none(&broken(&schemes, at_length(200, 80), |random| {
        let centre = 300.0;
        let width = random.decades(0.02, 10.0);
        let theta = centre + width * random.uniform(-2.0, 2.0);
        let length = 1.0 + random.unit();
        let spring = Transition {
            stiffness: 1e3,
            length,
            capacity: random.decades(1e-2, 1e1),
            rise: random.decades(0.1, 10.0) / centre,
            centre,
            width,
        };
        let velocity = [random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)];
        let world = held(spring, 1.1 * length, velocity, Some(theta));
        (world, random.decades(1e-3, 1e-2))
    }));
    assert_none(&broken(&schemes, at_length(200, 80), |random| {
        let centre = 300.0;
        let width = random.decades(1.0, 10.0);
        let theta = centre + width * random.uniform(-2.0, 2.0);
        let length = 1.0 + random.unit();
        let capacity = random.decades(1.0, 1e2);
        let spring = Softening {
            stiffness: 1e3,
            // A larger drop would make the heat capacity negative.
            drop: capacity * width.powi(2) * random.decades(1e-3, 0.05),
            length,
            capacity,
            centre,
            width,
        };
        let velocity = [random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)];
        let world = held(spring, 1.1 * length, velocity, Some(theta));
        (world, random.decades(1e-3, 1e-2))
    }));
}

#[test]
fn energies_whose_terms_cancel_are_within_the_reported_bound_and_their_defect_is_from_values() {
    let stiffness = 1e8;
    let mut largest = 0.0_f64;
    for scheme in [
        Scheme::EemTemperature,
        Scheme::EemEntropy,
        Scheme::EemEntropy4,
    ] {
        let model = Cancelling {
            stiffness,
            length: 1.0,
            offset: stiffness,
        };
        let world = held(model, 1.0 + 1e-6, [1e-3, 2e-3], None);
        let mut watched = world.start(scheme, 1e-5).expect("a sound scene");
        let mut wide = 0;
        for _ in 0..20 {
            let report = watched.step().expect("a right step");
            assert!(report.defect.abs() <= report.bound, "{report:?}");
            largest = largest.max(report.defect.abs());
            wide += usize::from(report.is_bound_wide);
        }
        let beyond = |law: &String| law.contains("beyond the reported bound");
        let broken = &watched.record.broken;
        assert!(!broken.iter().any(beyond), "{broken:?}");
        assert!(wide > 0, "{}", scheme.name());
    }
    // What values of terms of 1e8 J are known to; a difference would be known to 1e-13 J.
    assert!(largest > f64::EPSILON * stiffness / 8.0, "{largest:e}");
}

#[test]
fn a_bound_of_the_size_of_the_rounding_of_the_energies_is_not_wide() {
    for (scheme, _) in SCHEMES {
        let hooke = hooke(100.0, 1.0);
        let world = held(hooke, 1.1, [0.2, 1.0], None);
        let mut watched = world.start(scheme, 0.01).expect("a sound scene");
        let report = watched.step().expect("a right step");
        assert!(!report.is_bound_wide, "{}: {report:?}", scheme.name());
    }
}

#[test]
fn a_branch_far_stiffer_than_the_motion_has_a_wide_bound() {
    for scheme in [Scheme::EemTemperature, Scheme::EemEntropy] {
        // At equilibrium the branch bears nothing, and answers to each rounding of the length.
        let maxwell = Maxwell {
            stiffness: 1.0,
            branch: 1e8,
            length: 1.0,
            eta: 1.0,
        };
        let world = held(maxwell, 1.0, [1e-3, 1e-3], None);
        let mut watched = world.start(scheme, 0.01).expect("a sound scene");
        let mut wide = 0;
        for _ in 0..20 {
            let report = watched.step().expect("a right step");
            wide += usize::from(report.is_bound_wide);
        }
        assert!(wide > 0, "{}", scheme.name());
        let broken = &watched.record.broken;
        assert!(broken.is_empty(), "{broken:?}");
    }
}

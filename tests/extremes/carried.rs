//! Rounding that is far above the energies: branches that have relaxed, and stiff springs that are carried along.
//!
//! A step whose defect is below the rounding of its own terms is taken. These are computed here:
//!
//! ```text
//! 64 ε (A + A⁺ + Σ_nodes (Σ_springs (k λ + |f|)) |Δq|)     A, A⁺ as in the judge
//! ```

use eem::prelude::*;
use eem::{Law, StepFailure, Tolerance};
use eem_testkit::length::at_length;

use super::model::model;
use super::models::{Maxwell, Thermoelastic, hooke};
use super::random::Random;
use super::rounding::ROUNDINGS;
use super::watched::Watched;
use super::world::World;

model! {
    /// A Maxwell fluid: all of its force relaxes.
    Fluid { stiffness, length, eta } (lambda: Stretch, gamma: Viscous) {
        0.5 * stiffness * (lambda - length - gamma).powi(2)
    }
    [gamma = eta]
}

/// The implicit exact schemes.
const IMPLICIT: [Scheme; 5] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::Staggered,
    Scheme::EemEntropy4,
    Scheme::EemEntropy6,
];

/// A fluid of 80 N/m between anchors, 0.3 m longer than at rest, whose τ is 0.1 s.
fn held_fluid(scheme: Scheme, step: f64) -> Watched<1> {
    let mut world = World::new();
    let ends = [0.0, 1.3].map(|place| world.anchor([place]));
    let fluid = Fluid {
        stiffness: 80.0,
        length: 1.0,
        eta: 8.0,
    };
    world.spring(fluid, ends);
    world.start(scheme, step).expect("a sound scene")
}

/// The force falls from 24 N to the rounding of the length, `k ε λ`, and the energy to its square.
#[test]
fn a_fluid_relaxes_for_ever() {
    for scheme in IMPLICIT {
        for step in [1e-3, 0.05, 1.0, 1e3] {
            let mut watched = held_fluid(scheme, step);
            let record = watched.steps(200);
            let label = format!("{}, h = {step}", scheme.name());
            assert!(record.refused.is_none(), "{label}: {}", record.refusal());
            assert!(record.is_lawful(), "{label}: {:?}", record.broken);
        }
    }
}

#[test]
fn controlled_steps_of_a_fluid_grow_when_it_has_relaxed() {
    for scheme in IMPLICIT.into_iter().filter(|&of| of != Scheme::Staggered) {
        let mut watched = held_fluid(scheme, 0.01);
        let tolerance = Tolerance::new(1e-4);
        watched.run.control_steps(tolerance).expect("controlled");
        let record = watched.steps(400);
        assert!(record.refused.is_none(), "{}", record.refusal());
        let time = watched.run.time();
        // 100 τ: what it starts with would not get there.
        assert!(time > 10.0, "{}: {time:e} s", scheme.name());
    }
}

/// A mass of 1 kg on a Hooke spring of 1 m at an anchor that moves.
fn carried<const D: usize>(
    (scheme, stiffness, step): (Scheme, f64, f64),
    ([place, velocity], gravity): ([[f64; D]; 2], [f64; D]),
    motion: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
) -> Watched<D> {
    let mut world = World::new();
    let anchor = world.anchor([0.0; D]);
    let mass = world.mass(1.0, place, velocity);
    let length = 1.0;
    world.spring(hooke(stiffness, length), [anchor, mass]);
    world.set_gravity(gravity);
    world.move_anchor(anchor, motion);
    world.start(scheme, step).expect("a sound scene")
}

/// Takes steps, of which none may be refused, and each must have a defect that rounding explains.
fn travels<const D: usize>(watched: &mut Watched<D>, stiffness: f64, steps: usize, label: &str) {
    let mut before = watched.stored().clone();
    for _ in 0..steps {
        let report = watched.step();
        let report = report.unwrap_or_else(|error| panic!("{label}: {error}"));
        let after = watched.stored().clone();
        let [q0, q1] = [&before, &after].map(|state| &state.positions);
        let way = q0.iter().zip(q1).map(|(&a, &b)| (b - a).value().abs());
        let way: f64 = way.sum();
        // Strains are below a tenth.
        let own = ROUNDINGS * f64::EPSILON * 1.2 * stiffness * way;
        let most = own + watched.record.bound;
        let defect = watched.record.defect.abs();
        assert!(defect <= most, "{label}: {defect:e} J above {most:e} J");
        assert!(report.defect.abs() <= report.bound, "{label}: {report:?}");
        before = after;
    }
    let broken = &watched.record.broken;
    let is_broken = |law: &&String| !law.contains("without a flag");
    assert!(
        !broken.iter().any(|law| is_broken(&law)),
        "{label}: {broken:?}"
    );
}

#[test]
fn a_mass_that_travels_with_its_anchor_is_not_refused() {
    for scheme in IMPLICIT {
        for stiffness in [1e5, 1e7, 1e8, 1e9] {
            let start = ([[1.0, 0.0], [6.0, 0.0]], [0.0; 2]);
            let how = (scheme, stiffness, 0.125e-3);
            let mut watched = carried(how, start, |t| [6.0 * t, 0.0]);
            let label = format!("{}, k = {stiffness:e}", scheme.name());
            travels(&mut watched, stiffness, 200, &label);
        }
    }
}

/// Kapitza (1951): a pendulum stands upside down on a support that vibrates with `a ω > √(2 g l)`.
#[test]
fn a_stiff_pendulum_stands_on_its_vibrating_support() {
    const ANGLE: f64 = 0.1;
    for scheme in IMPLICIT {
        for stiffness in [1e5, 1e8, 1e10] {
            let place = [ANGLE.sin(), ANGLE.cos()];
            let start = ([place, [0.0; 2]], [0.0, -9.81]);
            let motion = |t: f64| [0.0, 0.05 * ((200.0 * t).cos() - 1.0)];
            let mut watched = carried((scheme, stiffness, 1e-3), start, motion);
            let label = format!("{}, k = {stiffness:e}", scheme.name());
            travels(&mut watched, stiffness, 200, &label);
            // It swings slowly about the vertical, and faster by a ω sin φ/l.
            let sideways = watched.stored().positions[2].value();
            assert!(sideways.abs() < 2.0 * ANGLE, "{label}: {sideways}");
        }
    }
}

/// A chain of masses and anchors, some of which move; springs of 1e-3 to 1e9 N/m, with dashpots and without, and steps
/// of 1e-6 to 1e3 of one of their times.
fn at_random<const D: usize>(random: &mut Random) -> (World<D>, f64) {
    let mut world = World::<D>::new();
    let spacing = random.decades(1e-3, 1e3);
    let speed = if random.chance(0.3) {
        random.decades(1e-3, 1e2)
    } else {
        0.0
    };
    let (mut last, mut times) = (None, Vec::new());
    for index in 0..2 + random.below(3) {
        let mut place = [0.0; D];
        place[0] = spacing * f64::from(u32::try_from(index).unwrap());
        let mut velocity = [0.0; D];
        velocity[0] = speed + spacing * random.decades(1e-6, 1.0);
        let mass = random.decades(1e-3, 1e3);
        let node = if random.chance(0.5) {
            world.mass(mass, place, velocity)
        } else {
            let anchor = world.anchor(place);
            let [reach, frequency] = [
                spacing * random.decades(1e-6, 1e-1),
                random.decades(1e-2, 1e3),
            ];
            world.move_anchor(anchor, move |t| {
                let mut moved = place;
                moved[0] += speed * t;
                moved[D - 1] += reach * ((frequency * t).cos() - 1.0);
                moved
            });
            anchor
        };
        if let Some(last) = last {
            let stiffness = random.decades(1e-3, 1e9);
            let length = spacing * (1.0 + random.uniform(-0.3, 0.3) * random.decades(1e-9, 1.0));
            let time = random.decades(1e-6, 1e6);
            times.extend([(mass / stiffness).sqrt(), time]);
            let eta = stiffness * time;
            match random.below(3) {
                0 => world.spring(hooke(stiffness, length), [last, node]),
                1 => world.spring(
                    Fluid {
                        stiffness,
                        length,
                        eta,
                    },
                    [last, node],
                ),
                _ => {
                    let branch = random.decades(1e-3, 1e9);
                    let eta = branch * time;
                    world.spring(
                        Maxwell {
                            stiffness,
                            branch,
                            length,
                            eta,
                        },
                        [last, node],
                    )
                }
            };
            if random.chance(0.3) {
                let warm = Thermoelastic {
                    stiffness,
                    length,
                    coupling: 0.0,
                    capacity: stiffness * spacing * spacing * random.decades(1e-3, 1.0),
                    theta_ref: 300.0,
                };
                world.warm(warm, [last, node], 300.0);
            }
        }
        last = Some(node);
    }
    let step = times[random.below(times.len())] * random.decades(1e-6, 1e3);
    (world, step)
}

/// No step is refused because of its energy; a step that is too large may have no solution.
fn keep_the_law<const D: usize>(seeds: core::ops::Range<u64>) {
    let mut steps = 0;
    for seed in seeds {
        let mut random = Random::new(seed);
        let (world, step) = at_random::<D>(&mut random);
        let scheme = IMPLICIT[random.below(IMPLICIT.len())];
        let mut watched = world.start(scheme, step).expect("a sound scene");
        let record = watched.steps(8);
        steps += record.steps;
        let label = format!("seed {seed}, {}, h = {step:e}", scheme.name());
        // Momenta are refused where a step is so long that a free body has no inertia beside its stiffness.
        let is_refused = matches!(
            record.refused.as_ref().map(|error| &error.failure),
            Some(StepFailure::LawNotKept {
                law: Law::Energy,
                ..
            })
        );
        assert!(!is_refused, "{label}: {:?}", record.refused);
        let is_broken = |law: &&String| !law.contains("without a flag");
        let broken = record.broken.iter().find(is_broken);
        assert!(broken.is_none(), "{label}: {broken:?}");
    }
    assert!(steps > 0, "no step was taken");
}

#[test]
fn no_chain_is_refused_for_its_rounding() {
    let scenes = at_length(5400, 150);
    keep_the_law::<1>(0..scenes);
    keep_the_law::<2>(0..scenes);
}

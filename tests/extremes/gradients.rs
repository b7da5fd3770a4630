//! Gradients of runs of random scenes of the ordinary class: by the adjoint, by tangents, and by differences of runs.

use eem::prelude::*;
use eem::{Gradient, History, Objective};
use eem_testkit::length::at_length;

use crate::extremes::drawing::{Class, Drawing};
use crate::extremes::random::Random;
use crate::extremes::watched::{FORMS, Watched};

const STEPS: usize = 50;

/// What adjoint and tangents may differ by, of the sum of the magnitudes of the terms and the growth of derivatives.
const ROUNDING: f64 = 1e-11;

/// The part by which inputs change for differences, and what these may be off for the rounding of a run.
const PART: f64 = 1e-6;
const MISSED: f64 = 1e-8;

/// A run of the scene of a seed, with velocities and masses that are larger by parts, for as many steps as it is of the ordinary class.
fn run<const D: usize>(
    seed: u64,
    part: f64,
    scheme: Scheme,
    most: usize,
) -> Option<(Watched<D>, Drawing<D>, Vec<Node>, usize)> {
    let mut drawing = Drawing::<D>::at_random(&mut Random::new(seed), Class::Ordinary, 6);
    drawing.scale([1.0 + part, 1.0 + 0.5 * part]);
    let world = drawing.world();
    let nodes = world.nodes().to_vec();
    let mut watched = world.start(scheme, drawing.step).ok()?;
    watched.run.keep_history(History::default());
    let mut steps = 0;
    while steps < most && drawing.is_within(&watched) && watched.run.step().is_ok() {
        steps += 1;
    }
    Some((watched, drawing, nodes, steps))
}

fn objective<const D: usize>(nodes: &[Node], drawing: &Drawing<D>) -> Objective<D> {
    let first = drawing.moving().position(|moving| moving.is_some());
    let first = first.map_or(nodes[0], |first| nodes[first]);
    Objective::at_end(Quantity::Position(first)) + Objective::integral(Quantity::KineticEnergy)
}

/// The change of the objective with a factor of all velocities and half of it of all masses, and the size of its terms.
fn by_factor<const D: usize>(
    gradient: &Gradient<D>,
    nodes: &[Node],
    drawing: &Drawing<D>,
) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (&node, moving) in nodes.iter().zip(drawing.moving()) {
        let Some((velocity, mass)) = moving else {
            continue;
        };
        let by = gradient.by_velocity(node).unwrap();
        let terms = velocity.iter().zip(&by).map(|(speed, by)| speed * by);
        for term in terms.chain([0.5 * mass * gradient.by_mass(node).unwrap()]) {
            sums[0] += term;
            sums[1] += term.abs();
        }
    }
    sums
}

/// Checks the gradient of a scene in one form; whether there was one.
fn check<const D: usize>(seed: u64, scheme: Scheme) -> bool {
    let Some((mut watched, drawing, nodes, steps)) = run::<D>(seed, 0.0, scheme, STEPS) else {
        return false;
    };
    let what = format!("{scheme}, {D} dimensions, seed {seed}, {steps} steps");
    let of = objective(&nodes, &drawing);
    let gradient = watched.run.gradient(&of).unwrap();
    let growth = gradient.growth().max(1.0);
    let [adjoint, tangent, size] = watched.run.changes_along(&gradient, &of).unwrap();
    assert!(
        (adjoint - tangent).abs() <= ROUNDING * growth * size,
        "{what}: {adjoint} {tangent}, growth {growth:e}"
    );
    let value = |parts: f64| {
        let (mut other, drawing, nodes, _) = run::<D>(seed, parts * PART, scheme, steps).unwrap();
        let gradient = other.run.gradient(&objective(&nodes, &drawing)).unwrap();
        gradient.value()
    };
    let [one, two] = [1.0, 2.0].map(|parts| value(parts) - value(-parts));
    let found = (8.0 * one - two) / (12.0 * PART);
    let [expected, size] = by_factor(&gradient, &nodes, &drawing);
    // The difference of second order is off by more.
    let missed = (found - one / (2.0 * PART)).abs();
    let rounding = f64::EPSILON * gradient.value().abs() / PART;
    assert!(
        (found - expected).abs() <= missed + (MISSED * size + rounding) * growth,
        "{what}: {found} {expected}, growth {growth:e}"
    );
    true
}

#[test]
fn random_scenes_have_gradients() {
    let count = at_length(1000, 30);
    let mut found = 0;
    for seed in 0..count {
        let scheme = FORMS[usize::from(seed % 2 == 0)];
        found += u64::from(match seed % 3 {
            0 => check::<1>(seed, scheme),
            1 => check::<2>(seed, scheme),
            _ => check::<3>(seed, scheme),
        });
    }
    assert!(2 * found > count, "{found} of {count} have gradients");
}

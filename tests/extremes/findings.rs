//! What a hostile user found, each as a test that failed when it was found.

use eem::prelude::*;

use super::model::Model;
use super::models::{Hot, Maxwell, Thermoelastic, TwoDashpots, TwoLinearDashpots, hooke};
use super::random::Random;
use super::watched::{Record, Watched};
use super::world::World;

/// Iterations that a step of a stiff case may take with the default settings.
pub(crate) const ITERATIONS: usize = 10;

/// A mass of 1 kg on a spring to the origin.
pub(crate) fn on_anchor(
    spring: impl FnOnce(&mut World<2>, [Node; 2]),
    position: [f64; 2],
    velocity: [f64; 2],
) -> World<2> {
    let mut world = World::new();
    let anchor = world.anchor([0.0; 2]);
    let mass = world.mass(1.0, position, velocity);
    spring(&mut world, [anchor, mass]);
    world
}

/// A spring of a model for [`on_anchor`], and a warm one.
pub(crate) fn sprung(model: impl Model + Copy) -> impl Fn(&mut World<2>, [Node; 2]) + Copy {
    move |world, ends| {
        world.spring(model, ends);
    }
}

pub(crate) fn warmed(
    model: impl Model + Copy,
    theta: f64,
) -> impl Fn(&mut World<2>, [Node; 2]) + Copy {
    move |world, ends| {
        world.warm(model, ends, theta);
    }
}

/// A mass on a hot spring, as it was found.
pub(crate) fn hot_as_found(scheme: Scheme) -> Watched<2> {
    let hot = warmed(Hot::FOUND, 414.0);
    let world = on_anchor(hot, [0.384, 0.0], [-3.32, -0.0127]);
    world.start(scheme, 0.0988).expect("a sound scene")
}

/// Another mass near its anchor on a hot spring. `None` where the heat capacity is not positive.
pub(crate) fn hot_at_random(random: &mut Random, scheme: Scheme) -> Option<Watched<2>> {
    let model = Hot {
        gas: random.uniform(0.2, 1.0),
        bonds: random.uniform(0.5, 2.0),
        frequency: random.uniform(100.0, 400.0),
        capacity: random.uniform(0.05, 0.5),
    };
    let theta = random.uniform(200.0, 600.0);
    let position = [random.uniform(0.1, 2.0), 0.0];
    let velocity = [random.uniform(-4.0, 4.0), random.uniform(-0.5, 0.5)];
    let step = random.decades(0.01, 0.2);
    let hot = warmed(model, theta);
    on_anchor(hot, position, velocity).start(scheme, step).ok()
}

/// The size of step with which `2m/h² + f*/(λ⁰ + λ¹)` vanishes when a compressed spring of 0.6 m is
/// turned round, and its start: from q = (0.6, 0) to (−0.6, 0).
pub(crate) fn turned_round(scheme: Scheme, factor: f64) -> Watched<2> {
    let step = (4.0 * 0.6 / 40.0_f64).sqrt() * factor;
    let hooke = sprung(hooke(100.0, 1.0));
    let world = on_anchor(hooke, [0.6, 0.0], [-1.2 / step, 0.0]);
    world.start(scheme, step).expect("a sound scene")
}

/// Two free masses of 1 kg on a stiff spring, turning about each other.
pub(crate) fn stiff_pair(scheme: Scheme, stiffness: f64) -> Watched<2> {
    let mut world = World::new();
    let a = world.mass(1.0, [0.0, 0.0], [0.0, -0.5]);
    let b = world.mass(1.0, [1.00014, 0.0], [0.0, 0.5]);
    world.spring(hooke(stiffness, 1.0), [a, b]);
    world.start(scheme, 0.1).expect("a sound scene")
}

/// A Maxwell element without temperature, `h k₁/η` as given.
pub(crate) fn maxwell(scheme: Scheme, ratio: f64, starts_relaxed: bool) -> Watched<2> {
    let (step, branch) = (0.1, 50.0);
    let eta = step * branch / ratio;
    let model = Maxwell {
        stiffness: 100.0,
        branch,
        length: 1.0,
        eta,
    };
    let element = |world: &mut World<2>, ends| {
        let element = world.spring(model, ends);
        if starts_relaxed {
            world.set_viscous_stretch(element, 0, 1.2 - 1.0);
        }
    };
    let world = on_anchor(element, [1.2, 0.0], [0.0, 1.0]);
    world.start(scheme, step).expect("a sound scene")
}

/// A thermoelastic spring of this capacity that turns steadily, `m v² = f λ`, or with another speed
/// towards the anchor.
pub(crate) fn small_capacity(scheme: Scheme, capacity: f64, radial: f64) -> Watched<2> {
    let model = Thermoelastic {
        capacity,
        ..Thermoelastic::ORDINARY
    };
    // f = 100 (1.2 − 1) = 20 N at θ = θr.
    let velocity = [radial, (20.0 * 1.2_f64).sqrt()];
    let spring = warmed(model, 300.0);
    on_anchor(spring, [1.2, 0.0], velocity)
        .start(scheme, 0.05)
        .expect("a sound scene")
}

/// Two springs in thermal contact, `κh/c` as given; nothing moves.
pub(crate) fn contact(scheme: Scheme, ratio: f64) -> Watched<2> {
    let model = Thermoelastic {
        coupling: 0.0,
        ..Thermoelastic::ORDINARY
    };
    let step = 0.1;
    let mut world = World::new();
    let anchor = world.anchor([0.0, 0.0]);
    let ends = [[1.0, 0.0], [-1.0, 0.0]].map(|at| world.mass(1.0, at, [0.0; 2]));
    let hot = world.warm(model, [anchor, ends[0]], 380.0);
    let cold = world.warm(model, [anchor, ends[1]], 310.0);
    world.conduct([hot, cold], ratio * model.capacity / step);
    world.start(scheme, step).expect("a sound scene")
}

/// The spring with two dashpots of finding 5.
pub(crate) fn two_dashpots(scheme: Scheme, eta: f64) -> Watched<2> {
    let element = warmed(TwoDashpots::of_viscosity(eta), 300.0);
    let world = on_anchor(element, [1.5, 0.0], [0.0, 1.0]);
    world.start(scheme, 0.2).expect("a sound scene")
}

/// The same, linear in the extension.
pub(crate) fn two_linear_dashpots(scheme: Scheme, eta: f64) -> Watched<2> {
    let element = warmed(TwoLinearDashpots::of_viscosity(eta), 300.0);
    let world = on_anchor(element, [1.5, 0.0], [0.0, 1.0]);
    world.start(scheme, 0.2).expect("a sound scene")
}

/// The iterations that a stiff case may take: a staggered step is two solves.
pub(crate) fn allowed(scheme: Scheme) -> usize {
    if scheme == Scheme::Staggered {
        2 * ITERATIONS
    } else {
        ITERATIONS
    }
}

/// What is wrong with a run that has to complete, lawfully, within the iterations allowed.
pub(crate) fn complaint(
    what: &str,
    scheme: Scheme,
    steps: usize,
    record: &Record,
) -> Option<String> {
    let done = record.steps == steps && record.is_lawful();
    let wrong = !done || record.most_iterations > allowed(scheme);
    wrong.then(|| {
        format!(
            "{what} {:16} {} of {steps} steps, ≤ {} iterations, worst {:.1e} of the bound, {} broken {:?} {}",
            scheme.name(),
            record.steps,
            record.most_iterations,
            record.worst,
            record.broken_steps,
            record.broken.first(),
            record.refusal(),
        )
    })
}

#[cfg(test)]
#[path = "findings_tests.rs"]
mod tests;

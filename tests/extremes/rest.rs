//! Kind 2: rest, uniform motion, rigid rotation, equilibrium, and increments of one ulp: tangents are exact
//! there, Newton's method converges quadratically, and what ought to stay stays.

use core::f64::consts::PI;

use eem::prelude::*;

use super::findings::{on_anchor, sprung, warmed};
use super::models::{ThermoViscoElastic, Thermoelastic, TwoDashpots, hooke};
use super::published::{LOGARITHMIC, double_pendulum, single_pendulum};
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, FORMS, Watched};
use super::world::World;

pub(crate) const FAMILIES: &[Family] = &[
    at_rest,
    in_uniform_motion,
    turning_rigidly,
    tangents,
    quadratic_convergence,
];

/// Springs of several kinds at rest in their natural state, in a row.
fn row(scheme: Scheme, velocity: [f64; 2], step: f64) -> Watched<2> {
    let mut world = World::new();
    let nodes: Vec<Node> = (0..4_u8)
        .map(|i| world.mass(1.0, [f64::from(i), 0.0], velocity))
        .collect();
    world.spring(hooke(100.0, 1.0), [nodes[0], nodes[1]]);
    world.warm(Thermoelastic::ORDINARY, [nodes[1], nodes[2]], 300.0);
    world.warm(TwoDashpots::of_viscosity(1.0), [nodes[2], nodes[3]], 300.0);
    world.start(scheme, step).expect("a sound scene")
}

/// What a coordinate of 3 m may be off by after a step: an ulp of its increment, which is about the
/// distance of the motion or, at rest, what the rounding of a force moves a mass by.
const ULPS: f64 = 16.0 * f64::EPSILON;

fn at_rest(effort: Effort) -> Tally {
    let mut tally =
        Tally::new("at rest: natural state, and a weight in equilibrium, h = 1e-9 … 1e3 s");
    let steps = effort.of([3, 10, 1000]);
    for scheme in EXACT {
        for step in [1e-9, 1e-3, 0.1, 10.0, 1e3] {
            let mut free = row(scheme, [0.0; 2], step);
            let before = free.stored().clone();
            tally.add_complete(
                format!("free, h = {step}, {}", scheme.name()),
                free.steps(steps),
            );
            // No force is anything but zero, and nothing moves by a bit.
            let is_still = free.stored().positions == before.positions;
            tally.claim(
                is_still,
                format!("free, h = {step}, {}: it moves", scheme.name()),
            );
            let hooke = sprung(hooke(128.0, 1.0));
            // 8 N on 128 N/m, which is known exactly.
            let mut world = on_anchor(hooke, [0.0, -1.0625], [0.0, 0.0]);
            world.set_gravity([0.0, -8.0]);
            let mut weight = world.start(scheme, step).expect("a sound scene");
            let before = weight.stored().positions.clone();
            let label = format!("weight, h = {step}, {}", scheme.name());
            tally.add_complete(&label, weight.steps(steps));
            let is_still = weight.stored().positions == before;
            tally.claim(is_still, format!("{label}: it moves"));
        }
    }
    tally
}

fn in_uniform_motion(effort: Effort) -> Tally {
    let mut tally = Tally::new("in uniform motion, 1e-300 … 1e6 m/s");
    let steps = effort.of([3, 10, 1000]);
    for scheme in EXACT {
        for exponent in [-300, -100, -20, -8, -3, 0, 3, 6] {
            let speed = 10.0_f64.powi(exponent);
            let mut watched = row(scheme, [0.6 * speed, 0.8 * speed], 0.1);
            let label = format!("1e{exponent} m/s, {}", scheme.name());
            tally.add_complete(&label, watched.steps(steps));
            let momenta = &watched.stored().momenta;
            let off = momenta
                .chunks(2)
                .map(|p| (p[0].value() - 0.6 * speed).abs() + (p[1].value() - 0.8 * speed).abs());
            // Positions are known to an ulp, and forces to the stiffness times that, in every step.
            #[expect(clippy::cast_precision_loss, reason = "small numbers")]
            let way = 3.0 + speed * 0.1 * steps as f64;
            let allowed = ULPS * (speed + 130.0 * 0.1 * way);
            let off = off.fold(0.0, f64::max);
            tally.claim(off <= allowed, format!("{label}: off by {off:e} kg m/s"));
        }
    }
    tally
}

fn turning_rigidly(effort: Effort) -> Tally {
    let mut tally = Tally::new("turning rigidly, m v² = f λ, by 1e-6 … 3 rad per step");
    let steps = effort.of([3, 20, 1000]);
    for scheme in EXACT {
        for angle in [1e-6, 1e-3, 0.1, 1.0, 2.0, 3.0] {
            // f = 100 (1.2 − 1) = 20 N, and tan(α/2) = h v/2λ in the schemes.
            let speed = (20.0 * 1.2_f64).sqrt();
            let step = 2.0 * 1.2 / speed * (0.5_f64 * angle).tan();
            let spring = warmed(Thermoelastic::ORDINARY, 300.0);
            let world = on_anchor(spring, [1.2, 0.0], [0.0, speed]);
            let mut watched = world.start(scheme, step).expect("a sound scene");
            let label = format!("{angle} rad, {}", scheme.name());
            tally.add_complete(&label, watched.steps(steps));
            let q = &watched.stored().positions;
            let radius = q[2].value().hypot(q[3].value());
            // 1.2 m and the speed are rounded, and the radius swings about that of the circle.
            let off = (radius - 1.2).abs();
            tally.claim(
                off < 64.0 * ULPS,
                format!("{label}: radius off by {off:e} m"),
            );
        }
    }
    tally
}

/// A difference of residuals is off by the square of its offset, and by rounding over it, relative to the
/// largest entry of a row.
const OFFSET: f64 = 1e-5;
const DIFFERENCE: f64 = 1e-8;

fn tangents(effort: Effort) -> Tally {
    let mut tally = Tally::new(
        "tangents of a step at increments of 0, subnormal, one ulp, small, large, against differences",
    );
    let _ = effort;
    for scheme in FORMS {
        for increment in [0.0, 5e-324, 1e-310, 1e-16, 1e-9, -1e-9, 1e-3, 0.1, -0.5] {
            let mut single = single_pendulum([1.0, 1.0])
                .start(scheme, 0.05)
                .expect("sound");
            let label = format!("single, {increment:e} m, {}", scheme.name());
            compare(&mut tally, &label, &mut single.run, increment, &[]);
            let world = double_pendulum(&LOGARITHMIC, [1.0, 1.0]);
            let mut double = world.start(scheme, 0.02).expect("sound");
            let label = format!("double, {increment:e} m, {}", scheme.name());
            compare(
                &mut tally,
                &label,
                &mut double.run,
                increment,
                &[380.0, 298.0],
            );
        }
    }
    tally
}

/// Compares a tangent with differences, where all masses move by `increment`, in turn to and fro.
fn compare<const D: usize>(
    tally: &mut Tally,
    label: &str,
    run: &mut Simulation<D>,
    increment: f64,
    temperatures: &[f64],
) {
    let count = run.unknowns();
    let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -0.7 };
    let mut point: Vec<f64> = (0..count - temperatures.len())
        .map(|i| increment * sign(i))
        .collect();
    point.extend(temperatures);
    tally.runs += 1;
    let system = match run.linearize(&point) {
        Ok(system) => system,
        Err(error) => return tally.claim(false, format!("{label}: {error}")),
    };
    tally.completed += 1;
    for column in 0..count {
        let offset = OFFSET * point[column].abs().max(1.0);
        let [below, above] = [-offset, offset].map(|offset| {
            let mut moved = point.clone();
            moved[column] += offset;
            run.linearize(&moved).map(|system| system.residual)
        });
        let (Ok(below), Ok(above)) = (below, above) else {
            tally.claim(false, format!("{label}: no residual beside it"));
            continue;
        };
        for row in 0..count {
            let entries = &system.tangent[row * count..(row + 1) * count];
            // Entries of a row may have different units: a kelvin and a metre are of similar size here.
            let size = entries
                .iter()
                .fold(0.0_f64, |size, entry| size.max(entry.abs()));
            let difference = (above[row] - below[row]) / (2.0 * offset);
            let off = (entries[column] - difference).abs() / size;
            let message = format!("{label}: ({row}, {column}) is off by {off:e}");
            tally.claim(off < DIFFERENCE, message);
        }
    }
}

/// Updates below this are rounding, in units of the longest stretch.
const FLOOR: f64 = 1e-12;
/// An update over the square of the one before, at most: half the third derivative over the second one,
/// in units of the stretch; it is about one where nothing is close to an anchor.
const CONSTANT: f64 = 50.0;
/// Newton's method may search before it is near.
const NEAR: f64 = 1e-3;

fn quadratic_convergence(effort: Effort) -> Tally {
    let mut tally = Tally::new(
        "updates of Newton's method: each at most 50 times the square of the one before",
    );
    let _ = effort;
    let pull = |world: &mut World<2>, ends| {
        let element = world.warm(ThermoViscoElastic::PENDULUM, ends, 320.0);
        let air = world.reservoir(300.0);
        world.cool(element, air, 10.0);
    };
    for scheme in FORMS {
        for turn in [0.0, 0.25 * PI, 0.5 * PI, PI] {
            let velocity = [2.0 * turn.cos(), 2.0 * turn.sin()];
            let mut history = Vec::new();
            for iterations in 1..12 {
                let world = on_anchor(pull, [1.5, 0.0], velocity);
                let mut watched = world.start(scheme, 0.05).expect("a sound scene");
                let settings = NewtonSettings {
                    max_iterations: iterations,
                    ..watched.run.newton_settings()
                };
                watched
                    .run
                    .set_newton_settings(settings)
                    .expect("sound settings");
                match watched.step() {
                    Ok(_) => {
                        tally.add_complete("the step", &watched.record);
                        break;
                    }
                    // What follows are other starts.
                    Err(error) => history = error.history[..iterations].to_vec(),
                }
            }
            for pair in history.windows(2) {
                let [before, after] = [pair[0].update, pair[1].update];
                let is_quadratic = after <= (CONSTANT * before * before).max(FLOOR);
                let message = format!("{turn} rad, {}: {before:e}, then {after:e}", scheme.name());
                tally.claim(before > NEAR || is_quadratic, message);
            }
        }
    }
    tally
}

//! Kind 5: stretches of many decades, ways close to and through an anchor, lengths of any size.

use eem::prelude::*;

use super::findings::{on_anchor, sprung};
use super::models::{LogarithmicStiffness, hencky, hooke};
use super::random::Random;
use super::tally::{Effort, Family, Tally};
use super::watched::EXACT;
use super::world::World;

pub(crate) const FAMILIES: &[Family] =
    &[stretches, ways_past_an_anchor, lengths, beyond_the_doubles];

fn stretches(effort: Effort) -> Tally {
    let mut tally = Tally::new("logarithmic springs at stretches λ/l = 1e-6 … 1e6");
    let steps = effort.of([3, 30, 1000]);
    for scheme in EXACT {
        for exponent in -6..=6 {
            let lambda = 10.0_f64.powi(exponent);
            let hencky = sprung(hencky(100.0, 1.0));
            let warm = |world: &mut World<2>, ends| {
                let model = LogarithmicStiffness {
                    stiffness: 100.0,
                    softening: 0.01,
                    coupling: 0.1,
                    capacity: 5.0,
                    length: 1.0,
                    theta_ref: 300.0,
                };
                world.warm(model, ends, 310.0);
            };
            // A tenth of the time in which the force doubles or halves the length.
            let force = 100.0 * lambda.ln().abs().max(1.0) / lambda;
            let step = 0.1 * (lambda / force).sqrt();
            let speed = lambda * (force / lambda).sqrt();
            let scenes = [
                on_anchor(hencky, [lambda, 0.0], [0.0, speed]),
                on_anchor(warm, [lambda, 0.0], [0.0, speed]),
            ];
            for (name, world) in ["Hencky", "warm"].into_iter().zip(scenes) {
                let mut watched = world.start(scheme, step).expect("a sound scene");
                let label = format!("{name}, λ/l = 1e{exponent}, {}", scheme.name());
                tally.add_complete(label, watched.steps(steps));
            }
        }
    }
    tally
}

fn ways_past_an_anchor(effort: Effort) -> Tally {
    let mut tally = Tally::new("masses aimed at their anchor, past it by 0 and 1e-300 … 0.1 m");
    let steps = effort.of([5, 40, 400]);
    let mut random = Random::new(5);
    for scheme in EXACT {
        for exponent in [
            -400, -300, -200, -100, -20, -16, -12, -9, -6, -5, -4, -3, -2, -1,
        ] {
            // 1e-400 is 0: the way leads through the anchor.
            let offset = 10.0_f64.powi(exponent);
            let hooke = sprung(hooke(100.0, 0.5));
            let hencky = sprung(hencky(1.0, 0.5));
            let step = random.uniform(0.01, 0.1);
            let scenes = [
                on_anchor(hooke, [1.0, offset], [-8.0, 0.0]),
                on_anchor(hencky, [1.0, offset], [-8.0, 0.0]),
                // A step ends exactly on the anchor, if the spring lets it.
                on_anchor(hooke, [1.0, offset], [-1.0 / step, 0.0]),
            ];
            for (name, world) in ["Hooke", "Hencky", "onto it"].into_iter().zip(scenes) {
                let mut watched = world.start(scheme, step).expect("a sound scene");
                let label = format!(
                    "{name}, past by 1e{exponent}, h = {step}, {}",
                    scheme.name()
                );
                tally.add(label, watched.steps(steps));
            }
        }
    }
    tally
}

/// A pendulum of another size, with the same period.
fn sized(scheme: Scheme, size: f64) -> Result<super::watched::Watched<2>, SceneError> {
    let hooke = sprung(hooke(100.0, size));
    let world = on_anchor(hooke, [1.3 * size, 0.0], [0.0, size]);
    world.start(scheme, 0.1)
}

fn lengths(effort: Effort) -> Tally {
    let mut tally = Tally::new("pendulums of length 1e-100 … 1e100 m");
    let steps = effort.of([3, 30, 1000]);
    for scheme in EXACT {
        for exponent in (-100..=100).step_by(10) {
            let label = format!("1e{exponent} m, {}", scheme.name());
            match sized(scheme, 10.0_f64.powi(exponent)) {
                Ok(mut watched) => tally.add_complete(label, watched.steps(steps)),
                Err(error) => tally.claim(false, format!("{label}: {error}")),
            }
        }
    }
    tally
}

fn beyond_the_doubles(effort: Effort) -> Tally {
    let mut tally = Tally::new(
        "pendulums whose energy is beyond the doubles: 1e-300 … 1e-170 m, 1e160 … 1e300 m",
    );
    let steps = effort.of([3, 10, 10]);
    for scheme in EXACT {
        for exponent in [-300, -250, -200, -170, 160, 200, 250, 300] {
            let label = format!("1e{exponent} m, {}", scheme.name());
            match sized(scheme, 10.0_f64.powi(exponent)) {
                Ok(mut watched) => {
                    tally.add(&label, watched.steps(steps));
                    let is_refused = watched.record.refused.is_some();
                    tally.claim(is_refused, format!("{label}: not refused"));
                }
                Err(_) => *tally.refused.entry("no scene".to_owned()).or_default() += 1,
            }
        }
    }
    tally
}

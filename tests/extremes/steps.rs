//! Kind 1: step sizes from 1e-12 to 1e6 s, on all published cases and by all schemes.

use eem::prelude::*;

use super::published::{self, Case, Published};
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, Record};

pub(crate) const FAMILIES: &[Family] = &[
    single_pendulum,
    romeros_pendulum,
    kruegers_pendulum,
    logarithmic_pendulum,
];

fn single_pendulum(effort: Effort) -> Tally {
    sizes(&published::ALL[0], effort)
}

fn romeros_pendulum(effort: Effort) -> Tally {
    sizes(&published::ALL[1], effort)
}

fn kruegers_pendulum(effort: Effort) -> Tally {
    sizes(&published::ALL[2], effort)
}

fn logarithmic_pendulum(effort: Effort) -> Tally {
    sizes(&published::ALL[3], effort)
}

/// Step sizes from 1e-12 to 1e6 s. Those up to the published one have to complete in an exact scheme.
fn sizes((name, published, build): &Published, effort: Effort) -> Tally {
    let count = effort.of([2, 3, 200]);
    let per_decade = effort.of([1, 1, 4]);
    let stride = effort.of([2, 2, 1]);
    let mut tally = Tally::new(format!(
        "{name}, all schemes, h = 1e-12 … 1e6 s, {count} steps each"
    ));
    let mut completes = Vec::new();
    for scheme in Scheme::ALL {
        let (mut largest, mut all_below) = (0.0, true);
        for index in (-12 * per_decade..=6 * per_decade).step_by(stride) {
            let step = 10.0_f64.powf(f64::from(index) / f64::from(per_decade));
            let record = record(build(), scheme, step, count);
            let completes = record.refused.is_none();
            all_below &= completes;
            if all_below {
                largest = step;
            }
            let label = format!("h = {step:.1e}, {}", scheme.name());
            if EXACT.contains(&scheme) && step <= *published {
                tally.add_complete(label, &record);
            } else {
                tally.add(label, &record);
            }
        }
        completes.push(format!("{} {largest:.0e} s", scheme.name()));
    }
    tally.note(format!(
        "the largest step up to which all complete: {}",
        completes.join(", ")
    ));
    tally
}

fn record(case: Case, scheme: Scheme, step: f64, count: usize) -> Record {
    match case {
        Case::Plane(world) => world
            .start(scheme, step)
            .expect("a sound scene")
            .steps(count)
            .clone(),
        Case::Space(world) => world
            .start(scheme, step)
            .expect("a sound scene")
            .steps(count)
            .clone(),
    }
}

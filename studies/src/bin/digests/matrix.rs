//! All runs: scenes × schemes × scalars × threads.

use std::error::Error;

use eem::MemberFailure;
use eem::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::planar::{LARGE, PLANAR};
use crate::solids::{BLOCKS, SHEETS};
use crate::spatial::SPATIAL;
use crate::table::Row;
use crate::watch::{Case, Drive, Seen, Watched, digest, name_of, watch};

/// A scene, and how it is run.
pub(crate) struct Entry<C> {
    pub(crate) name: &'static str,
    pub(crate) case: C,
    /// s
    pub(crate) step: f64,
    pub(crate) drive: Drive,
}

/// Of initial velocities, one per member: four that move together, and one alone.
const FACTORS: [f64; 5] = [1.0, 1.01, 0.97, 1.1, 0.9];

/// A pool of threads, and how many it has.
struct Threads {
    number: usize,
    pool: ThreadPool,
}

/// The rows of all scenes whose names contain `scene`.
pub(crate) fn rows(scene: &str) -> Result<Vec<Row>, Box<dyn Error>> {
    let pool = |number| {
        let pool = ThreadPoolBuilder::new().num_threads(number).build()?;
        Ok::<_, Box<dyn Error>>(Threads { number, pool })
    };
    let threads = [pool(1)?, pool(4)?];
    let mut rows = Vec::new();
    for entry in PLANAR.iter().filter(|entry| entry.name.contains(scene)) {
        add(entry, &threads, &mut rows, |scheme| {
            Some(together::<2, _>(entry, scheme))
        });
    }
    for entry in LARGE.iter().filter(|entry| entry.name.contains(scene)) {
        add::<2, _>(entry, &threads, &mut rows, |_| None);
    }
    for entry in SPATIAL.iter().filter(|entry| entry.name.contains(scene)) {
        add(entry, &threads, &mut rows, |scheme| {
            Some(together::<3, _>(entry, scheme))
        });
    }
    for entry in SHEETS.iter().filter(|entry| entry.name.contains(scene)) {
        add::<2, _>(entry, &threads, &mut rows, |_| None);
    }
    for entry in BLOCKS.iter().filter(|entry| entry.name.contains(scene)) {
        add::<3, _>(entry, &threads, &mut rows, |_| None);
    }
    Ok(rows)
}

/// All rows of a scene; in lanes if it can be run there.
fn add<const D: usize, C: Case<D>>(
    entry: &Entry<C>,
    threads: &[Threads],
    rows: &mut Vec<Row>,
    in_lanes: impl Fn(Scheme) -> Option<Outcome> + Sync,
) {
    for scheme in Scheme::ALL.into_iter().chain([Scheme::Auto]) {
        for Threads { number, pool } in threads {
            let mut add = |scalar, outcome: Outcome| {
                rows.push(Row {
                    scene: entry.name,
                    scheme: scheme.name(),
                    scalar,
                    threads: *number,
                    steps: outcome.steps,
                    iterations: outcome.iterations,
                    digest: outcome.digest,
                });
            };
            add("f64", pool.install(|| alone::<D, _>(entry, scheme)));
            add("f32", pool.install(|| alone::<D, f32, _>(entry, scheme)));
            if let Some(outcome) = pool.install(|| in_lanes(scheme)) {
                add("lanes", outcome);
            }
        }
    }
}

/// What a row says of its run, or of all of its members.
struct Outcome {
    steps: usize,
    iterations: usize,
    digest: String,
}

impl Outcome {
    fn of(members: &[Result<Seen, String>]) -> Self {
        let seen = || members.iter().flatten();
        let mut errors = members.iter().map(|member| match member {
            Ok(seen) => &seen.error,
            Err(error) => error,
        });
        let digest = match errors.find(|error| !error.is_empty()) {
            Some(error) => error.clone(),
            None => format!("{:016x}", digest(seen().map(|seen| seen.digest))),
        };
        Self {
            steps: seen().map(|seen| seen.steps).sum(),
            iterations: seen().map(|seen| seen.iterations).sum(),
            digest,
        }
    }
}

/// The first member on its own.
fn alone<const D: usize, C: Case<D>>(entry: &Entry<C>, scheme: Scheme) -> Outcome {
    let build = entry.case.build(FACTORS[0]);
    let run = Simulation::new(build.scene, scheme, entry.step);
    let seen = run.map_err(|refused| name_of(&refused.errors()[0]));
    let seen = seen.and_then(|mut run| {
        let (numbers, mut seen) =
            watch(&mut run, &build.handles, entry.drive).map_err(|error| name_of(&error))?;
        seen.digest = digest(numbers.iter().map(|number| number.to_bits()));
        Ok(seen)
    });
    Outcome::of(&[seen])
}

/// All members as an ensemble.
fn together<const D: usize, C: Case<D>>(entry: &Entry<C>, scheme: Scheme) -> Outcome {
    let watched = Watched {
        case: entry.case,
        drive: entry.drive,
    };
    let members = Ensemble::new(scheme, entry.step).run_experiment(&watched, &FACTORS);
    let members = members.into_iter().map(|member| {
        member.map_err(|error| match error.failure {
            MemberFailure::Step(error) => name_of(&error.failure),
            MemberFailure::Scene(error) => name_of(&error),
            other => name_of(&other),
        })
    });
    Outcome::of(&members.collect::<Vec<_>>())
}

//! All runs: scenes × schemes × threads.

use std::error::Error;

use eem::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::planar::{LARGE, PLANAR};
use crate::solids::{BLOCKS, SHEETS};
use crate::spatial::SPATIAL;
use crate::table::Row;
use crate::watch::{Case, Drive, Seen, digest, name_of, watch};

/// A scene, and how it is run.
pub(crate) struct Entry<C> {
    pub(crate) name: &'static str,
    pub(crate) case: C,
    /// s
    pub(crate) step: f64,
    pub(crate) drive: Drive,
}

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
        add::<2, _>(entry, &threads, &mut rows);
    }
    for entry in LARGE.iter().filter(|entry| entry.name.contains(scene)) {
        add::<2, _>(entry, &threads, &mut rows);
    }
    for entry in SPATIAL.iter().filter(|entry| entry.name.contains(scene)) {
        add::<3, _>(entry, &threads, &mut rows);
    }
    for entry in SHEETS.iter().filter(|entry| entry.name.contains(scene)) {
        add::<2, _>(entry, &threads, &mut rows);
    }
    for entry in BLOCKS.iter().filter(|entry| entry.name.contains(scene)) {
        add::<3, _>(entry, &threads, &mut rows);
    }
    Ok(rows)
}

/// All rows of a scene.
fn add<const D: usize, C: Case<D>>(entry: &Entry<C>, threads: &[Threads], rows: &mut Vec<Row>) {
    for scheme in Scheme::ALL.into_iter().chain([Scheme::Auto]) {
        for Threads { number, pool } in threads {
            let seen = pool.install(|| outcome::<D, _>(entry, scheme));
            let [steps, iterations] = seen
                .as_ref()
                .map_or([0; 2], |seen| [seen.steps, seen.iterations]);
            let digest = match seen {
                Ok(seen) if seen.error.is_empty() => {
                    format!("{:016x}", digest([seen.digest].into_iter()))
                }
                Ok(Seen { error, .. }) | Err(error) => error,
            };
            rows.push(Row {
                scene: entry.name,
                scheme: scheme.name(),
                threads: *number,
                steps,
                iterations,
                digest,
            });
        }
    }
}

/// How a run ends; the name of the error if the scene is refused.
fn outcome<const D: usize, C: Case<D>>(entry: &Entry<C>, scheme: Scheme) -> Result<Seen, String> {
    let build = entry.case.build();
    let run = Simulation::new(build.scene, scheme, entry.step);
    let mut run = run.map_err(|refused| name_of(&refused.errors()[0]))?;
    Ok(watch(&mut run, &build.handles, entry.drive))
}

//! The members, run as an ensemble.

use std::time::{Duration, Instant};

use eem::MemberError;
use eem::prelude::*;

use super::pendulum::{End, Pendulum, Spring};
use eem_studies::progress::Progress;
use eem_studies::time_grid::TimeGrid;

/// The larger of two numbers; not a number if one of them is not.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The ensemble of one scheme.
#[derive(Debug)]
pub(crate) struct Sample {
    pub(crate) scheme: Scheme,
    grid: TimeGrid,
    pub(crate) ends: Vec<Result<End, MemberError>>,
    pub(crate) elapsed: Duration,
}

impl Sample {
    /// Runs all members.
    pub(crate) fn run(scheme: Scheme, grid: TimeGrid, threads: usize, springs: &[Spring]) -> Self {
        let mut progress = Progress::new(scheme.name(), springs.len() * grid.steps);
        let start = Instant::now();
        let ensemble = Ensemble::new(scheme, grid.step)
            .threads(threads)
            .watch(|done, _| {
                progress.advance(done * grid.steps);
                ControlFlow::Continue(())
            });
        let ends = Pendulum { steps: grid.steps }.run(ensemble, springs);
        let elapsed = start.elapsed();
        Self {
            scheme,
            grid,
            ends,
            elapsed,
        }
    }

    /// A quantity of the members that reached the end, in ascending order.
    pub(crate) fn sorted(&self, quantity: fn(&End) -> f64) -> Vec<f64> {
        let mut values: Vec<f64> = self.ends.iter().flatten().map(quantity).collect();
        values.sort_by(f64::total_cmp);
        values
    }

    /// The largest value of a quantity; not a number if one is not; `None` without members.
    pub(crate) fn largest(&self, quantity: fn(&End) -> f64) -> Option<f64> {
        self.ends.iter().flatten().map(quantity).reduce(larger)
    }

    /// Why members have no end.
    pub(crate) fn failures(&self) -> impl Iterator<Item = &MemberError> {
        self.ends.iter().filter_map(|end| end.as_ref().err())
    }

    /// Whether the first members end alone as they did among the others.
    pub(crate) fn has_the_bits_of_single_runs(&self, springs: &[Spring]) -> bool {
        let pendulum = Pendulum {
            steps: self.grid.steps,
        };
        springs.iter().zip(&self.ends).all(|(spring, end)| {
            let alone = Ensemble::new(self.scheme, self.grid.step).threads(1);
            let alone = pendulum.run(alone, std::slice::from_ref(spring));
            matches!((alone.as_slice(), end), ([Ok(alone)], Ok(end)) if alone == end)
        })
    }
}

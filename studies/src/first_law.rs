//! The first law of runs on which loads do work: what energy and work differ by.

use super::comparison::over_time;
use super::figures::{Axes, Figure};
use super::record::Record;
use super::statistics::largest;

/// The least defect (J) that is drawn; it stands for none at all.
const LEAST_DEFECT: f64 = 1e-12;

/// |E − E₀ − W| over time, J.
pub fn defects(run: &Record) -> impl Iterator<Item = f64> + use<'_> {
    let work = run.column("work").unwrap_or_default();
    let changes = run.energy_changes().into_iter().zip(work);
    changes.map(|((_, change), work)| (change - work).abs())
}

/// max |E − E₀ − W|, J.
pub fn largest_defect(run: &Record) -> Option<f64> {
    largest(defects(run))
}

/// What each scheme makes of it.
pub fn figure(case: &str, runs: &[Record]) -> Figure {
    let largest_so_far = |run: &Record| {
        let defects = defects(run).scan(LEAST_DEFECT, |largest, defect| {
            *largest = largest.max(defect);
            Some(*largest)
        });
        run.over_time(defects).split_off(1)
    };
    Figure {
        axes: Axes::Logarithmic,
        ..over_time(
            &format!("{case}: what each scheme makes of the first law"),
            "largest |E − E₀ − W| so far (J)",
            runs,
            largest_so_far,
        )
    }
}

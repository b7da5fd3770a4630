//! The first law of runs on which loads do work: what energy and work differ by.

use super::comparison::over_time;
use super::figures::{Axes, Figure};
use super::record::Record;
use super::statistics::largest;

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

/// What each scheme makes of it: the largest defect so far, and in the legend that at the end. Where there is none
/// yet, there is no curve.
pub fn figure(case: &str, runs: &[Record]) -> Figure {
    let title = format!("{case}: what each scheme makes of the first law");
    let mut figure = over_time(
        &title,
        "largest |E − E₀ − W| so far (J)",
        runs,
        |run| {
            let so_far = defects(run).scan(0.0_f64, |largest, defect| {
                *largest = largest.max(defect);
                Some(*largest)
            });
            run.over_time(so_far)
        },
    );
    for curve in &mut figure.curves {
        let last = curve.points.last().map_or(0.0, |last| last.1);
        curve.label = format!("{}: {last:.1e} J", curve.label);
        curve.points.retain(|&(_, defect)| defect > 0.0);
        curve.trusted = true;
    }
    figure.with(Axes::Logarithmic)
}

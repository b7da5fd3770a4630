//! What becomes of the bearing from one cycle to the next.

use super::scene::FREQUENCY;
use eem_studies::claims::Claims;
use eem_studies::record::Record;
use eem_studies::statistics::first_row;

/// A whole cycle, after the first two, in which the shaking begins and the creep finds its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cycle {
    /// Rows of its first and its last state.
    pub(crate) rows: [usize; 2],
    /// What the plate has done in it, J.
    pub(crate) work: f64,
    /// The largest shear stress, Pa.
    pub(crate) stress: f64,
    /// Mean temperature of the rubber at its end, K.
    pub(crate) temperature: f64,
}

/// All whole cycles that a run has gone through, but the first two.
pub(crate) fn all(run: &Record) -> Vec<Cycle> {
    let columns = ["work", "shear_stress", "temperature_mean"].map(|name| run.column(name));
    let [Some(work), Some(stress), Some(temperature)] = columns else {
        return Vec::new();
    };
    let ends = (2..).map(|cycle| first_row(run, f64::from(cycle) / FREQUENCY));
    let ends: Vec<usize> = ends.take_while(|&row| row < work.len()).collect();
    let cycle = |rows: &[usize]| Cycle {
        rows: [rows[0], rows[1]],
        work: work[rows[1]] - work[rows[0]],
        stress: stress[rows[0]..=rows[1]]
            .iter()
            .copied()
            .fold(0.0, f64::max),
        temperature: temperature[rows[1]],
    };
    ends.windows(2).map(cycle).collect()
}

/// The rubber warms up and the plate does less work, from cycle to cycle.
pub(crate) fn check(run: &Record, claims: &mut Claims) {
    let scheme = &run.scheme;
    for (number, pair) in (4..).zip(all(run).windows(2)) {
        let [before, after] = [pair[0], pair[1]];
        claims.holds(
            after.temperature > before.temperature,
            format!("{scheme}: the rubber does not warm up in cycle {number}"),
        );
        claims.holds(
            after.work < before.work,
            format!("{scheme}: the plate does not do less work in cycle {number}"),
        );
    }
}

//! The errors of Table III: maximal deviation from a reference, over the reference's mean.

use eem_studies::record::Record;
use eem_studies::statistics::TIME_TOLERANCE;

/// Relative errors of energy, entropy and angular momentum.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Errors {
    pub(crate) energy: f64,
    pub(crate) entropy: f64,
    pub(crate) momentum: f64,
}

impl Errors {
    /// Those of a run, as far as it comes.
    ///
    /// ```text
    /// error of X = max |X(t) − X_ref(t)| / mean |X_ref(t)|      over the times of the run
    /// ```
    pub(crate) fn of(run: &Record, reference: &Record) -> Self {
        let error = |name: &str| relative_error(run, reference, name);
        Self {
            energy: error("energy"),
            entropy: error("entropy"),
            momentum: error("angular_momentum"),
        }
    }

    pub(crate) const fn all(self) -> [f64; 3] {
        [self.energy, self.entropy, self.momentum]
    }
}

/// The error of the quantity whose columns begin with `name`; not a number when no time is common.
fn relative_error(run: &Record, reference: &Record, name: &str) -> f64 {
    let [own, exact] = [run, reference].map(|record| record.vectors(|c| c.starts_with(name)));
    let times = reference.column("time").unwrap_or_default();
    let (mut largest, mut sum, mut count) = (f64::NAN, 0.0, 0.0);
    for (row, value) in own.iter().enumerate() {
        let time = run.time(row);
        let later = times.partition_point(|exact| *exact < time - TIME_TOLERANCE);
        let same = times.get(later);
        if same.is_none_or(|same| (same - time).abs() > TIME_TOLERANCE) {
            continue;
        }
        let exact = &exact[later];
        let difference = value.iter().zip(exact).map(|(x, exact)| x - exact);
        largest = f64::max(largest, norm(difference));
        sum += norm(exact.iter().copied());
        count += 1.0;
    }
    largest / (sum / count)
}

fn norm(components: impl Iterator<Item = f64>) -> f64 {
    components.map(|x| x * x).sum::<f64>().sqrt()
}

//! The size of the next step from the errors of the last ones.

use crate::number::scalar::{Mask, Real};
use crate::step::control::tolerance::Accuracy;

/// The error that a step aims at, in units of the tolerance.
const AIM: f64 = 0.8;

/// The error beyond which a step is rejected, in units of the tolerance.
const MOST: f64 = 1.2;

/// The memory of the filter: b of H211b (Söderlind 2003, *Digital filters in adaptive time-stepping*).
const MEMORY: f64 = 4.0;

/// How much of the size is left after a step that was not accurate, at least.
const LEAST_AFTER_ERROR: f64 = 0.2;

/// Rejected steps aim lower.
const CAUTION: f64 = 0.9;

/// How much of the size is left after a step that failed.
pub(crate) const AFTER_FAILURE: f64 = 0.25;

/// Errors that are smaller say no more than this one.
const LEAST_ERROR: f64 = 1e-10;

/// A digital filter, H211b: `h₊ = h (0.8/e_n)^(1/bk) (0.8/e_{n−1})^(1/bk) (h_n/h_{n−1})^(−1/b)`, with the order k of
/// the error and `b = 4`; the factor f is limited to `1 + arctan(f − 1)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Controller<S> {
    /// The error and the size of the last accepted step; none before the first.
    last: Option<[S; 2]>,
}

/// What becomes of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict<S> {
    /// Accepted; the next one should have this size.
    Accepted(S),
    /// Rejected; it should be tried again with this one.
    Rejected(S),
}

impl<S: Real> Controller<S> {
    /// Before the first step.
    pub(crate) const fn new() -> Self {
        Self { last: None }
    }

    /// Judges a step of this size with this error, in units of the tolerance.
    pub(crate) fn judge(&mut self, size: S, error: S, accuracy: Accuracy) -> Verdict<S> {
        let order = 1.0 + f64::from(accuracy.order);
        if !error.at_most(S::from_f64(MOST)).all() {
            let left = S::from_f64(CAUTION) * error.powf(S::from_f64(-1.0 / order));
            let least = S::from_f64(LEAST_AFTER_ERROR);
            // Not a number where the error is none.
            let share = if least.less(left).all() { left } else { least };
            return Verdict::Rejected(size * share);
        }
        let error = error.maximum(S::from_f64(LEAST_ERROR));
        let [last_error, last_size] = self.last.unwrap_or([error, size]);
        let power = S::from_f64(1.0 / (MEMORY * order));
        let aim = S::from_f64(AIM);
        let factor = (aim / error).powf(power)
            * (aim / last_error).powf(power)
            * (size / last_size).powf(S::from_f64(-1.0 / MEMORY));
        self.last = Some([error, size]);
        Verdict::Accepted(size * limited(factor))
    }
}

/// `1 + arctan(f − 1)`
fn limited<S: Real>(factor: S) -> S {
    S::one() + (factor - S::one()).atan()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Accuracy = Accuracy {
        order: 2,
        is_proportional: true,
    };

    /// Sizes and rejections of a run whose error is `(h/s)³` with a scale s that changes.
    fn run(scale: impl Fn(usize) -> f64) -> (Vec<f64>, usize) {
        let mut controller = Controller::new();
        let (mut size, mut rejections) = (1.0, 0);
        let mut sizes = Vec::new();
        while sizes.len() < 60 {
            let error = (size / scale(sizes.len())).powi(3);
            match controller.judge(size, error, SECOND) {
                Verdict::Accepted(next) => {
                    sizes.push(size);
                    size = next;
                }
                Verdict::Rejected(next) => {
                    assert!(next < size);
                    size = next;
                    rejections += 1;
                }
            }
        }
        (sizes, rejections)
    }

    #[test]
    fn the_error_settles_at_the_aim() {
        for start in [0.01, 1.0, 7.0] {
            let (sizes, _) = run(|_| start);
            let error = (sizes[59] / start).powi(3);
            assert!((error - AIM).abs() < 1e-6, "{error}");
        }
    }

    #[test]
    fn slow_changes_cost_no_rejections() {
        let (_, rejections) = run(|step| 1.0 + 0.3 * (0.3 * step as f64).sin());
        assert_eq!(rejections, 0);
    }

    #[test]
    fn an_error_that_is_not_a_number_is_rejected() {
        let verdict = Controller::new().judge(1.0, f64::NAN, SECOND);
        assert_eq!(verdict, Verdict::Rejected(LEAST_AFTER_ERROR));
    }
}

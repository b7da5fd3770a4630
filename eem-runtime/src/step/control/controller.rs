//! The error of a step as a function of its size, and the size of the next step from the errors of the last ones.

use eem_material::number::scalar::Scalar;

/// Errors of fewer roundings of their own terms cannot be distinguished from rounding.
pub(crate) const ROUNDINGS: f64 = 16.0;

/// The error that a step aims at, in units of the tolerance.
const AIM: f64 = 0.8;

/// The error that an embedded estimate settles at, where its steps keep their size: `0.8 e^(−1/p + 0.07) = 1` with p = 8.
const SETTLED: f64 = 0.017;

/// The error beyond which a step in two halves is rejected, in units of the tolerance.
const MOST: f64 = 1.2;

/// The least fraction of the step size after a rejected step.
const LEAST_AFTER_ERROR: f64 = 0.2;

/// The error of a scheme as a function of its step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Accuracy {
    /// p: the error of a step is of order p + 1.
    pub(crate) order: u8,
    /// p where fast decays are not resolved, if that is less.
    pub(crate) least_order: u8,
    pub(crate) estimate: Estimate,
}

/// The source of the error estimate of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Estimate {
    /// The step in two halves. The tolerance is for the error of the state, not of one step.
    Halves,
    /// The step in two halves. The tolerance is for the errors of all steps in a given time.
    HalvesOverTime,
    /// An embedded scheme; the estimate is of order p.
    Embedded,
}

impl Accuracy {
    pub(crate) fn order(self) -> f64 {
        f64::from(self.order)
    }

    /// With a tolerance for the errors of all steps in a given time, unless the estimate is embedded.
    pub(crate) fn over_time(mut self) -> Self {
        if self.has_halves() {
            self.estimate = Estimate::HalvesOverTime;
        }
        self
    }

    /// The error of two halves as a share of their difference from the whole step, given the relative tolerance r₁ of this step:
    /// `1/(2ᵖ − 1)` with the least p. At least r₁, with which a difference of the size of the quantity uses up the tolerance.
    pub(super) fn share_of_difference(self, of_step: f64) -> f64 {
        let share = (f64::from(self.least_order).exp2() - 1.0).recip();
        Scalar::maximum(share, of_step)
    }

    /// The order, if errors are found from the step in two halves.
    pub(crate) fn order_of_halves(self) -> Option<f64> {
        self.has_halves().then(|| self.order())
    }

    /// Whether errors are found from the step in two halves.
    pub(crate) fn has_halves(self) -> bool {
        self.estimate != Estimate::Embedded
    }

    /// The relative tolerance of one step, which takes the fraction `part` of the time that the tolerance is for.
    pub(crate) fn of_step(self, relative: f64, part: f64) -> f64 {
        match self.estimate {
            Estimate::Halves => Scalar::powf(relative, 1.0 + 1.0 / self.order()),
            Estimate::HalvesOverTime => relative * part,
            Estimate::Embedded => relative,
        }
    }

    /// The smallest relative tolerance whose errors are above rounding.
    pub(super) fn floor(self) -> f64 {
        let rounding = ROUNDINGS * f64::EPSILON;
        if self.has_halves() {
            Scalar::powf(rounding, self.order() / (self.order() + 1.0))
        } else {
            rounding
        }
    }

    /// Whether a step with this error, in units of the tolerance, is accepted.
    pub(crate) fn accepts(self, error: f64) -> bool {
        error <= if self.has_halves() { MOST } else { 1.0 }
    }

    /// Whether an error, in units of the tolerance, can keep the next step from being longer.
    pub(crate) fn holds_back(self, error: f64) -> bool {
        // Also if it is not a number.
        !(error <= self.settled())
    }

    /// The error, in units of the tolerance, after which steps keep their size.
    pub(crate) fn settled(self) -> f64 {
        if self.has_halves() { AIM } else { SETTLED }
    }

    /// The fraction of its size with which a rejected step is tried again.
    pub(crate) fn left_after(self, error: f64) -> f64 {
        let power = -1.0 / self.order_of_estimate();
        let left = AIM * Scalar::powf(error, power);
        // Not NaN if the error is NaN.
        left.max(LEAST_AFTER_ERROR)
    }

    /// The power of the step size to which its estimated error, in units of the tolerance, is proportional.
    pub(super) fn order_of_estimate(self) -> f64 {
        match self.estimate {
            Estimate::Halves => self.order() + 1.0,
            Estimate::HalvesOverTime | Estimate::Embedded => self.order(),
        }
    }
}

/// The memory of the filter: b of H211b (Söderlind 2003, *Digital filters in adaptive time-stepping*).
const MEMORY: f64 = 4.0;

/// The fraction of the step size after a failed step.
pub(crate) const AFTER_FAILURE: f64 = 0.25;

/// Smaller errors are treated as this one.
const LEAST_ERROR: f64 = 1e-10;

/// For an embedded estimate: the reduction of the exponent of the error, and the exponent of the previous error (Hairer,
/// Nørsett & Wanner, *Solving ODEs I*, II.4, with a smaller exponent than theirs, which would make steps far smaller).
const FORGETTING: f64 = 0.03;
const REMEMBERING: f64 = 0.04;

/// The smallest previous error that is used.
const LEAST_REMEMBERED: f64 = 1e-4;

/// The range of the change of step size with an embedded estimate.
const CHANGES: [f64; 2] = [1.0 / 3.0, 6.0];

/// The largest growth after the first step in two halves, whose size is a guess (as in CVODE).
const FIRST_GROWTH: f64 = 1e4;

/// The controller of the step size, by the errors of the last two steps.
///
/// For errors from two halves of a step it is the digital filter H211b, with the order k of the error and `b = 4`; its
/// factor f is limited to `1 + arctan(f − 1)`. For an embedded estimate, of order p, it is a PI controller.
///
/// ```text
/// h₊ = h (0.8/e_n)^(1/bk) (0.8/e_{n−1})^(1/bk) (h_n/h_{n−1})^(−1/b)
/// h₊ = h 0.8 e_n^(−(1/p − 0.03)) e_{n−1}^0.04
/// ```
///
/// The size of the first step is a guess: if it has an error, the next one may be up to 10⁴ times as long, `h (0.8/e)^(1/k)`. The PI
/// controller grows sixfold per step, the filter 2.6-fold.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Controller {
    /// The error and the size of the last accepted step; none before the first.
    pub(crate) last: Option<[f64; 2]>,
}

impl Controller {
    pub(crate) const fn new() -> Self {
        Self { last: None }
    }

    /// The size of the next step after one of this size and with this error, in units of the tolerance.
    pub(crate) fn next(&mut self, size: f64, error: f64, accuracy: Accuracy) -> f64 {
        let last = self.last.replace([error, size]);
        let order = accuracy.order_of_estimate();
        let is_known = error > 0.0;
        if last.is_none() && is_known && accuracy.has_halves() {
            return size * Scalar::minimum(growth(error, 1.0 / order), FIRST_GROWTH);
        }
        let last = last.unwrap_or([error, size]);
        size * if accuracy.has_halves() {
            filtered([size, error], last, order)
        } else {
            proportional(error, last, order)
        }
    }
}

/// `(0.8/e)^power`
fn growth(error: f64, power: f64) -> f64 {
    Scalar::powf(AIM / Scalar::maximum(error, LEAST_ERROR), power)
}

/// The factor on the step size by the filter.
fn filtered([size, error]: [f64; 2], [last_error, last_size]: [f64; 2], order: f64) -> f64 {
    let share = |error: f64| growth(error, 1.0 / (MEMORY * order));
    let memory = Scalar::powf(size / last_size, -1.0 / MEMORY);
    let factor = share(error) * share(last_error) * memory;
    1.0 + Scalar::atan(factor - 1.0)
}

/// The factor on the step size for an embedded estimate.
fn proportional(error: f64, [last_error, _]: [f64; 2], order: f64) -> f64 {
    let error = Scalar::maximum(error, LEAST_ERROR);
    let last_error = Scalar::maximum(last_error, LEAST_REMEMBERED);
    let factor =
        AIM * Scalar::powf(error, FORGETTING - 1.0 / order) * Scalar::powf(last_error, REMEMBERING);
    let [least, most] = CHANGES;
    Scalar::minimum(Scalar::maximum(factor, least), most)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Accuracy = Accuracy {
        order: 2,
        least_order: 2,
        estimate: Estimate::Halves,
    };

    /// Sizes and rejections of a run whose error is `(h/s)³` with a scale s that changes.
    fn run(scale: impl Fn(usize) -> f64) -> (Vec<f64>, usize) {
        let mut controller = Controller::new();
        let (mut size, mut rejections) = (1.0, 0);
        let mut sizes = Vec::new();
        while sizes.len() < 60 {
            let error = (size / scale(sizes.len())).powi(3);
            if SECOND.accepts(error) {
                sizes.push(size);
                size = controller.next(size, error, SECOND);
            } else {
                let share: f64 = SECOND.left_after(error);
                assert!(share < 1.0);
                size *= share;
                rejections += 1;
            }
        }
        (sizes, rejections)
    }

    #[test]
    fn the_error_converges_to_the_aim() {
        for start in [0.01, 1.0, 7.0] {
            let (sizes, _) = run(|_| start);
            let error = (sizes[59] / start).powi(3);
            assert!((error - AIM).abs() < 1e-6, "{error}");
        }
    }

    #[test]
    fn slow_changes_cost_no_rejections() {
        let (_, rejections) =
            run(|step| 1.0 + 0.3 * (0.1 * f64::from(u8::try_from(step).unwrap())).sin());
        assert_eq!(rejections, 0);
    }

    #[test]
    fn an_error_that_is_not_a_number_is_rejected() {
        assert!(!SECOND.accepts(f64::NAN));
        assert!((0.1..0.5).contains(&SECOND.left_after(f64::NAN)));
    }
}

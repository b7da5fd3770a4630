//! A bracket of step sizes around a change of sign, which is narrowed.

use super::Sense;
use eem_material::number::scalar::Scalar;

/// Step sizes on both sides of a change of sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    low: f64,
    pub(super) high: f64,
    is_rising: bool,
    /// The function at both sizes; halved where a size has stayed while the other moved twice
    /// (the Illinois variant of regula falsi; Dowell & Jarratt 1971).
    values: [f64; 2],
    /// Which of the two moved last.
    moved: Option<bool>,
    /// The widths before the last two candidates.
    widths: [f64; 2],
}

impl Bracket {
    /// From zero to a whole step, if the sign of the function changes in it in the given sense.
    pub(super) fn new(sense: Sense, step: f64, [before, after]: [f64; 2]) -> Option<Self> {
        let is_rising = before < 0.0;
        let falls = before > 0.0 && after <= 0.0;
        let rises = is_rising && after >= 0.0;
        let counts = match sense {
            Sense::Rising => rises,
            Sense::Falling => falls,
            Sense::Either => falls || rises,
        };
        let bracket = Self {
            low: if after == 0.0 { step } else { 0.0 },
            high: step,
            is_rising,
            values: [before, after],
            moved: None,
            widths: [f64::MAX; 2],
        };
        counts.then_some(bracket)
    }

    /// The next size to try; `None` if the bracket is as narrow as the resolution.
    ///
    /// It is the zero of the secant, at least half the resolution inside the bracket, so that a good guess narrows it
    /// from both sides. If two candidates have not halved the width, it is the middle.
    pub(super) fn candidate(&self, resolution: f64) -> Option<f64> {
        let width = self.high - self.low;
        if width <= resolution {
            return None;
        }
        let [below, above] = self.values;
        let secant = self.high - width * (above / (above - below));
        let margin = 0.5 * resolution;
        let is_short = width <= 0.5 * self.widths[0];
        let guess = if secant.is_finite() && is_short {
            Scalar::minimum(
                Scalar::maximum(secant, self.low + margin),
                self.high - margin,
            )
        } else {
            self.low + 0.5 * width
        };
        let is_inside = self.low < guess && guess < self.high;
        is_inside.then_some(guess)
    }

    /// Narrows the bracket by the value at a size. True if the event lies at or before that size.
    pub(super) fn narrow(&mut self, size: f64, value: f64) -> bool {
        self.widths = [self.widths[1], self.high - self.low];
        let is_behind = if self.is_rising {
            value >= 0.0
        } else {
            value <= 0.0
        };
        self.values[usize::from(is_behind)] = value;
        if is_behind {
            self.high = size;
        } else {
            self.low = size;
        }
        if value == 0.0 {
            self.low = size;
        }
        if self.moved.replace(is_behind) == Some(is_behind) {
            self.values[usize::from(!is_behind)] *= 0.5;
        }
        is_behind
    }
}

#[cfg(test)]
mod tests {
    use super::{Bracket, Sense};

    /// The size found and the number of trials.
    fn search(function: impl Fn(f64) -> f64, step: f64, resolution: f64) -> (f64, usize) {
        let mut bracket =
            Bracket::new(Sense::Either, step, [function(0.0), function(step)]).unwrap();
        let mut trials = 0;
        while let Some(size) = bracket.candidate(resolution) {
            bracket.narrow(size, function(size));
            trials += 1;
        }
        assert!(bracket.high - bracket.low <= resolution);
        (bracket.high, trials)
    }

    #[test]
    fn smooth_functions_take_few_trials() {
        let root = 0.5_f64.sqrt();
        for sign in [1.0, -1.0] {
            let (size, trials) = search(|x| sign * (x * x - 0.5), 1.0, 1e-12);
            assert!((0.0..=1e-12).contains(&(size - root)), "{size}");
            assert!(trials <= 10, "{trials}");
        }
    }

    #[test]
    fn jumps_and_flat_functions_take_at_most_three_trials_per_halving() {
        let jump = |x: f64| if x < 0.3 { -1e9 } else { 1e-9 };
        let flat = |x: f64| (x - 0.3).powi(9);
        for (size, trials) in [search(jump, 1.0, 1e-9), search(flat, 1.0, 1e-9)] {
            assert!((0.0..=1e-9).contains(&(size - 0.3)), "{size}");
            assert!(trials <= 3 * 30, "{trials}");
        }
    }

    #[test]
    fn a_zero_is_where_the_event_is_and_no_sign_at_the_start() {
        let (size, _) = search(|x| x - 0.5, 1.0, 1e-300);
        assert_eq!(size.to_bits(), 0.5_f64.to_bits());
        let (size, trials) = search(|x| x - 1.0, 1.0, 1e-300);
        assert_eq!((size.to_bits(), trials), (1.0_f64.to_bits(), 0));
        assert!(Bracket::new(Sense::Either, 1.0, [0.0, 1.0]).is_none());
        assert!(Bracket::new(Sense::Either, 1.0, [1.0, 2.0]).is_none());
        assert!(Bracket::new(Sense::Either, 1.0, [-1.0, -2.0]).is_none());
    }
    #[test]
    fn only_the_sense_that_counts_makes_a_bracket() {
        let rise = [-1.0, 1.0];
        let fall = [1.0, -1.0];
        let found = |sense, values| Bracket::new(sense, 1.0, values).is_some();
        assert!(found(Sense::Rising, rise) && !found(Sense::Rising, fall));
        assert!(found(Sense::Falling, fall) && !found(Sense::Falling, rise));
        assert!(found(Sense::Either, rise) && found(Sense::Either, fall));
    }
}

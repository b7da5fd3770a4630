//! Events: conditions that end a run.

mod search;

use core::error::Error;
use core::fmt;

use super::Simulation;
use eem_material::number::scalar::Scalar;

/// Which changes of sign count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sense {
    Rising,
    Falling,
    Either,
}

/// The result of the function of an event: a number whose sign counts, or an error that ends the run.
type Value = Result<f64, Box<dyn Error>>;

/// The function of an event.
type Function<'f, const D: usize> = dyn FnMut(&Simulation<D>) -> Value + 'f;

/// An event of a run: a function of the simulation changes its sign.
///
/// The function may use `?`; an error ends the run with
/// [`StepFailure::EventError`](crate::StepFailure::EventError). The event is located as precisely as times can be
/// distinguished, or [`within`](Self::within) a tolerance. See [`Simulation::run_until_event`].
///
/// ```
/// use eem::prelude::*;
///
/// let mut scene = Scene::<1>::new();
/// let mass = scene.mass(1.0, [-1.0], [2.0]);
/// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.3)?;
/// let passes = Event::rising(|run: &Simulation<1>| Ok(run.position(mass)?[0]));
/// let is_late = Event::crossing(|run: &Simulation<1>| Ok(run.time() - 9.0)).within(1e-3);
/// let mut events = [passes, is_late];
/// assert_eq!(run.run_until_event(10.0, &mut events)?, RunEnd::Event(0));
/// assert!((run.time() - 0.5).abs() < 1e-15);
/// assert_eq!(run.run_until_event(10.0, &mut events)?, RunEnd::Event(1));
/// assert!((0.0..1e-3).contains(&(run.time() - 9.0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Event<'f, const D: usize> {
    function: Box<Function<'f, D>>,
    mark: Mark,
}

/// What is known of an event.
struct Mark {
    sense: Sense,
    tolerance: f64,
    /// The function at the beginning and at the end of the step.
    before: f64,
    after: f64,
    has_happened: bool,
}

impl<'f, const D: usize> Event<'f, D> {
    /// An event where the function changes its sign.
    #[must_use]
    pub fn crossing(function: impl FnMut(&Simulation<D>) -> Value + 'f) -> Self {
        Self::new(Sense::Either, function)
    }

    /// An event where the function becomes positive or zero.
    #[must_use]
    pub fn rising(function: impl FnMut(&Simulation<D>) -> Value + 'f) -> Self {
        Self::new(Sense::Rising, function)
    }

    /// An event where the function becomes negative or zero.
    #[must_use]
    pub fn falling(function: impl FnMut(&Simulation<D>) -> Value + 'f) -> Self {
        Self::new(Sense::Falling, function)
    }

    fn new(sense: Sense, function: impl FnMut(&Simulation<D>) -> Value + 'f) -> Self {
        Self {
            function: Box::new(function),
            mark: Mark {
                sense,
                tolerance: 0.0,
                before: 0.0,
                after: 0.0,
                has_happened: false,
            },
        }
    }

    /// Accepts a time up to `tolerance`, s, after the change of sign; zero by default.
    #[must_use]
    pub fn within(mut self, tolerance: f64) -> Self {
        self.mark.tolerance = tolerance;
        self
    }

    /// Whether this event happened at the end of the last run that searched for it. Several events can happen at
    /// the same time.
    #[must_use]
    pub const fn has_happened(&self) -> bool {
        self.mark.has_happened
    }
}

impl<const D: usize> fmt::Debug for Event<'_, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Event")
            .field("sense", &self.mark.sense)
            .field("tolerance", &self.mark.tolerance)
            .field("has_happened", &self.mark.has_happened)
            .finish_non_exhaustive()
    }
}

/// Step sizes on both sides of a change of sign.
#[derive(Clone, Copy, Debug)]
struct Bracket {
    low: f64,
    high: f64,
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
    fn new(sense: Sense, step: f64, [before, after]: [f64; 2]) -> Option<Self> {
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
    fn candidate(&self, resolution: f64) -> Option<f64> {
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
    fn narrow(&mut self, size: f64, value: f64) -> bool {
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

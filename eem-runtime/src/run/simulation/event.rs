//! Where a function of the simulation changes its sign, found by repeating one step.
//!
//! The state after a step is a continuous function of the step size, and all laws hold for every
//! size. So an event within a step is located by repeating the step with other sizes; nothing is
//! interpolated, and the state at the event obeys the laws like any other.

use core::ops::ControlFlow;

use super::Simulation;
use super::run::RunEnd;
use crate::number::scalar::{Discord, Mask, Real};
use crate::step::error::{StepError, StepFailure};
use crate::step::newton::StepReport;

/// The least distance of two times that a search tells apart, in units in the last place.
const SHARPEST: f64 = 4.0;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// Steps until the time `end`, s, or until `function` changes its sign, and calls `observer`
    /// after every step.
    ///
    /// The run stops just behind the event, at most `tolerance` (s) after the change of sign, or
    /// where the function is zero. Going on from there does not find the same event again. A
    /// function that is zero at the beginning has no sign yet: its first other value gives it.
    ///
    /// Signs are compared at the ends of steps, so that a function that changes its sign twice
    /// within a step is not noticed. A tolerance of zero is as sharp as times can be told apart. The
    /// observer sees the shortened step that ends at the event, not the trials of the
    /// search; everything else is as in [`run_until`](Self::run_until).
    ///
    /// # Errors
    ///
    /// As [`run_until`](Self::run_until); [`StepFailure::EventTolerance`] if the tolerance is negative
    /// or not a number; [`StepFailure::EventFunction`] if the function is not a number,
    /// with the simulation as it was before the step that led there.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use eem::{RunEnd, Scene, Scheme, Simulation};
    ///
    /// let mut scene = Scene::<2>::new();
    /// scene.anchor([0.0, 0.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.5)?;
    ///
    /// let noon = |run: &Simulation<2>| run.time().cos();
    /// let end = run.run_until_event(9.0, 1e-9, noon, |_, _| ControlFlow::Continue(()))?;
    /// assert_eq!(end, RunEnd::Event);
    /// let late = run.time() - core::f64::consts::FRAC_PI_2;
    /// assert!((0.0..=1e-9).contains(&late));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_until_event(
        &mut self,
        end: S,
        tolerance: S,
        mut function: impl FnMut(&Self) -> S,
        mut observer: impl FnMut(&Self, &StepReport<S>) -> ControlFlow<()>,
    ) -> Result<RunEnd, StepError> {
        if S::LANES > 1 {
            // Each of the numbers has its events at other times.
            return Err(self.refused(Discord.into()));
        }
        self.check_end(end)?;
        let value = tolerance.to_f64();
        if value.is_nan() || value < 0.0 {
            return Err(self.refused(StepFailure::EventTolerance { value }));
        }
        let mut before = function(self);
        if before.to_f64().is_nan() {
            return Err(self.refused(StepFailure::EventFunction));
        }
        while self.is_before(end)? {
            let memory = self.memory();
            let whole = self.step_towards(end)?;
            let looked = self.look_for(&mut function, whole, before, [end, tolerance]);
            // After an error as if the step had never been made.
            let looked = looked.inspect_err(|_| self.remember(memory));
            let (report, after, is_event) = looked?;
            let stopped = observer(self, &report).is_break();
            if is_event {
                return Ok(RunEnd::Event);
            }
            if stopped {
                return Ok(RunEnd::Stopped);
            }
            before = after;
        }
        Ok(RunEnd::Reached)
    }

    /// The event in the last step, if there is one: the report of the step that is kept, and the function at the
    /// end of the whole one.
    fn look_for(
        &mut self,
        function: &mut impl FnMut(&Self) -> S,
        whole: StepReport<S>,
        before: S,
        [end, tolerance]: [S; 2],
    ) -> Result<(StepReport<S>, S, bool), StepError> {
        let after = self.value(function)?;
        let Some(bracket) = Bracket::new(whole.step, [before, after]) else {
            return Ok((whole, after, false));
        };
        let error = match self.locate(bracket, whole, [end, tolerance], function) {
            Ok(report) => return Ok((report, after, true)),
            Err(error) => error,
        };
        // Where a step of the size that the event needs fails, one of half the size is kept, and the event looked
        // for from there on.
        let middle = self.time() + S::from_f64(0.5) * whole.step;
        let failed = !matches!(error.failure, StepFailure::EventFunction);
        if self.control.is_none() || !failed || !self.is_before(middle)? {
            return Err(error);
        }
        let shorter = self.step_in_scheme_towards(middle)?;
        self.look_for(function, shorter, before, [end, tolerance])
    }

    /// Replaces the last step, `report`, by a shorter one that ends just behind the event.
    fn locate(
        &mut self,
        mut bracket: Bracket<S>,
        whole: StepReport<S>,
        [end, tolerance]: [S; 2],
        function: &mut impl FnMut(&Self) -> S,
    ) -> Result<StepReport<S>, StepError> {
        let scale = whole.time.abs() + whole.step;
        let sharpest = S::from_f64(SHARPEST) * S::EPSILON * scale;
        let resolution = tolerance.maximum(sharpest);
        let mut report = whole;
        let (mut is_behind, mut is_shorter) = (true, false);
        while let Some(size) = bracket.candidate(resolution) {
            self.undo();
            report = self.step_again(size)?;
            let value = self.value(function)?;
            is_behind = bracket.narrow(size, value);
            is_shorter |= is_behind;
        }
        if is_behind {
            return Ok(report);
        }
        self.undo();
        if is_shorter {
            return self.step_again(bracket.high);
        }
        let mut report = self.step_again(whole.step)?;
        if whole.time.equal(end).all() {
            self.arrive_at(end, &mut report);
        }
        Ok(report)
    }

    /// The function at the present state; if it is not a number, the last step is undone.
    fn value(&mut self, function: &mut impl FnMut(&Self) -> S) -> Result<S, StepError> {
        let value = function(self);
        if value.to_f64().is_nan() {
            self.undo();
            return Err(self.failed(StepFailure::EventFunction));
        }
        Ok(value)
    }
}

/// Step sizes on both sides of a change of sign, of a single number.
#[derive(Clone, Copy, Debug)]
struct Bracket<S> {
    low: S,
    high: S,
    is_rising: bool,
    /// The function at both sizes; halved where a size has stayed while the other moved twice
    /// (the Illinois variant of regula falsi; Dowell & Jarratt 1971).
    values: [S; 2],
    /// Which of the two moved last.
    moved: Option<bool>,
    /// The widths before the last two candidates.
    widths: [S; 2],
}

impl<S: Real> Bracket<S> {
    /// From zero to a whole step, if the sign of the function changes in it.
    fn new(step: S, [before, after]: [S; 2]) -> Option<Self> {
        let zero = S::zero();
        let is_rising = before.less(zero);
        let falls = zero.less(before) & after.at_most(zero);
        let rises = is_rising & zero.at_most(after);
        let bracket = Self {
            low: S::select(after.equal(zero), step, zero),
            high: step,
            is_rising: is_rising.all(),
            values: [before, after],
            moved: None,
            widths: [S::MAX; 2],
        };
        (falls | rises).all().then_some(bracket)
    }

    /// The next size to try; none if the bracket is as narrow as wanted.
    ///
    /// It is where the secant meets zero, but half the resolution inside the bracket, so that a good
    /// guess narrows it from both sides. If two candidates have not halved the width, it is
    /// the middle.
    fn candidate(&self, resolution: S) -> Option<S> {
        let half = S::from_f64(0.5);
        let width = self.high - self.low;
        if width.at_most(resolution).all() {
            return None;
        }
        let [below, above] = self.values;
        let secant = self.high - width * (above / (above - below));
        let margin = half * resolution;
        let is_short = width.at_most(half * self.widths[0]).all();
        let guess = if secant.is_finite() && is_short {
            secant
                .maximum(self.low + margin)
                .minimum(self.high - margin)
        } else {
            self.low + half * width
        };
        let is_inside = self.low.less(guess) & guess.less(self.high);
        is_inside.all().then_some(guess)
    }

    /// Takes the value at a size between; whether that size lies behind the event.
    fn narrow(&mut self, size: S, value: S) -> bool {
        self.widths = [self.widths[1], self.high - self.low];
        let is_behind = if self.is_rising {
            S::zero().at_most(value).all()
        } else {
            value.at_most(S::zero()).all()
        };
        self.values[usize::from(is_behind)] = value;
        if is_behind {
            self.high = size;
        } else {
            self.low = size;
        }
        if value.equal(S::zero()).all() {
            self.low = size;
        }
        if self.moved.replace(is_behind) == Some(is_behind) {
            self.values[usize::from(!is_behind)] *= S::from_f64(0.5);
        }
        is_behind
    }
}

#[cfg(test)]
mod tests {
    use super::Bracket;

    /// The size found and the number of trials.
    fn search(function: impl Fn(f64) -> f64, step: f64, resolution: f64) -> (f64, usize) {
        let mut bracket = Bracket::new(step, [function(0.0), function(step)]).unwrap();
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
        assert!(Bracket::new(1.0, [0.0, 1.0]).is_none());
        assert!(Bracket::new(1.0, [1.0, 2.0]).is_none());
        assert!(Bracket::new(1.0, [-1.0, -2.0]).is_none());
    }
}

//! Many steps in one call, watched from outside, up to an end time that is hit exactly.

use core::ops::ControlFlow;

use super::Simulation;
use super::compiled::Aim;
use crate::step::error::{StepError, StepFailure};
use crate::step::newton::StepReport;
use eem_material::number::compensated::Sum;
use eem_material::number::scalar::{Mask, Real};

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RunEnd {
    /// At the end time.
    Reached,
    /// The observer stopped it.
    Stopped,
    /// At the event with this index in the list given to [`Simulation::run_until_event`].
    Event(usize),
}

/// Roundings between the last full step and the end time: half a unit in the last place from the
/// end time, as much from adding up steps that are themselves rounded, and as much again to be
/// safe on both sides.
const END_ROUNDINGS: f64 = 2.0;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// Steps until the time `end`, s.
    ///
    /// The last step is shortened so that the time is exactly `end`; the step size for later steps does not change.
    /// If `end` is a whole number of steps ahead, up to rounding, only full steps are made. The run itself
    /// allocates nothing.
    ///
    /// # Errors
    ///
    /// The error of the failed step, with the simulation as it was before that step; [`StepFailure::End`] if `end`
    /// is not a number or lies in the past.
    ///
    /// ```
    /// use eem::{Scene, Scheme, Simulation};
    ///
    /// let mut scene = Scene::<2>::new();
    /// let mass = scene.mass(1.0, [0.0, 0.0], [3.0, 0.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.3)?;
    /// run.run_until(1.0)?;
    /// assert_eq!((run.time(), run.step_size()), (1.0, 0.3));
    /// assert_eq!(run.position(mass)?[0], 3.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_until(&mut self, end: S) -> Result<(), StepError> {
        self.run_until_with(end, |_, _| ControlFlow::Continue(()))?;
        Ok(())
    }

    /// Like [`run_until`](Self::run_until), and calls `observer` after every step.
    ///
    /// The observer returns [`ControlFlow`] to continue or stop the run; a [`Recorder`](crate::Recorder) can be
    /// one. The end may be infinite if the observer stops the run.
    ///
    /// # Errors
    ///
    /// As [`run_until`](Self::run_until).
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use eem::{RunEnd, Scene, Scheme, Simulation};
    ///
    /// let mut scene = Scene::<2>::new();
    /// scene.anchor([0.0, 0.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.3)?;
    ///
    /// let mut sizes = Vec::new();
    /// let end = run.run_until_with(1.0, |_, report| {
    ///     sizes.push(report.step);
    ///     ControlFlow::Continue(())
    /// })?;
    /// assert_eq!((end, run.time(), run.step_size()), (RunEnd::Reached, 1.0, 0.3));
    /// assert_eq!(sizes[..3], [0.3; 3]);
    /// assert!((sizes[3] - 0.1_f64).abs() < 1e-15);
    ///
    /// let end = run.run_until_with(f64::INFINITY, |run, _| {
    ///     if run.time() > 1.5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    /// })?;
    /// assert_eq!((end, run.time()), (RunEnd::Stopped, 1.6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_until_with(
        &mut self,
        end: S,
        mut observer: impl FnMut(&Self, &StepReport<S>) -> ControlFlow<()>,
    ) -> Result<RunEnd, StepError> {
        self.check_end(end)?;
        while self.is_before(end)? {
            let report = self.advance(Aim::Towards(end))?;
            if observer(self, &report).is_break() {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Reached)
    }

    /// Steps to each of these times in turn, s, and calls `observer` there.
    ///
    /// Each time is met exactly by a shorter step; then steps have their previous size again. The observer sees
    /// states of the scheme, which obey the laws; an interpolation between steps would not.
    /// [`sample_at`](Self::sample_at) leaves the steps unchanged.
    ///
    /// # Errors
    ///
    /// As for [`run_until`](Self::run_until) with each of the times.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use eem::{RunEnd, Scene, Scheme, Simulation};
    ///
    /// let mut scene = Scene::<2>::new();
    /// scene.anchor([0.0, 0.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.4)?;
    /// let mut times = Vec::new();
    /// let end = run.run_at([0.5, 1.0, 1.1], |run| {
    ///     times.push(run.time());
    ///     ControlFlow::Continue(())
    /// })?;
    /// assert_eq!((end, times), (RunEnd::Reached, vec![0.5, 1.0, 1.1]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_at(
        &mut self,
        times: impl IntoIterator<Item = S>,
        mut observer: impl FnMut(&Self) -> ControlFlow<()>,
    ) -> Result<RunEnd, StepError> {
        for time in times {
            self.run_until(time)?;
            if observer(self).is_break() {
                return Ok(RunEnd::Stopped);
            }
        }
        Ok(RunEnd::Reached)
    }

    /// An error unless a run can end at this time.
    pub(super) fn check_end(&self, end: S) -> Result<(), StepError> {
        if self.time().at_most(end).all() {
            return Ok(());
        }
        let end = end.to_f64();
        Err(self.refused(StepFailure::End { end }))
    }

    /// Whether the end of a run lies ahead.
    pub(super) fn is_before(&self, end: S) -> Result<bool, StepError> {
        self.decide(self.time().less(end))
    }

    /// One decision for all numbers in S.
    fn decide(&self, mask: S::Mask) -> Result<bool, StepError> {
        let decided = mask.decide();
        decided.map_err(|discord| self.refused(discord.into()))
    }

    /// A run that ends before its first step.
    pub(super) fn refused(&self, failure: StepFailure) -> StepError {
        self.part();
        StepError {
            time: self.time().to_f64(),
            step: self.step_size().to_f64(),
            failure,
            shorter: None,
            history: Box::default(),
        }
    }

    /// See [`advance`](Self::advance), compiled here.
    pub(super) fn advance_here(&mut self, aim: Aim<S>) -> Result<StepReport<S>, StepError> {
        match aim {
            Aim::Towards(end) => self.step_towards(end),
            Aim::InSchemeTowards(end) => self.step_in_scheme_towards(end),
            Aim::Again(size) => self.step_again(size),
        }
    }

    /// One step of the present size, or one that ends exactly at `end`.
    fn step_towards(&mut self, end: S) -> Result<StepReport<S>, StepError> {
        if self.control.is_some() {
            return self.controlled_step(end);
        }
        let full = self.step_size();
        let last = self.size_towards(end, full)?;
        let size = last.unwrap_or(full);
        let made = self.step_by(size);
        let mut report = made.map_err(|error| self.with_shorter(error, size))?;
        if last.is_some() {
            self.arrive_at(end, &mut report);
        }
        Ok(report)
    }

    /// The same without another choice of the scheme.
    fn step_in_scheme_towards(&mut self, end: S) -> Result<StepReport<S>, StepError> {
        if self.control.is_none() {
            return self.step_towards(end);
        }
        self.with_control(|run, control| match control {
            Some(control) => run.find_accurate_step(control, end),
            None => run.step_towards(end),
        })
    }

    /// The size of a step that ends at `end`, if one of this size would end there or beyond it.
    pub(super) fn size_towards(&self, end: S, full: S) -> Result<Option<S>, StepError> {
        let left = self.time_left(end);
        let scale = self.time().abs() + full.minimum(left);
        let rounding = S::from_f64(END_ROUNDINGS) * S::EPSILON * scale;
        if self.decide((full + rounding).less(left))? {
            return Ok(None);
        }
        let is_full = self.decide((left - full).abs().at_most(rounding))?;
        Ok(Some(if is_full { full } else { left }))
    }

    /// The step that has been made ends at this time to the last bit.
    pub(super) fn arrive_at(&mut self, end: S, report: &mut StepReport<S>) {
        self.state.time = Sum::new(end);
        report.time = end;
    }

    /// `end − t`, with t to twice the precision, s.
    pub(super) fn time_left(&self, end: S) -> S {
        let Sum { value, carry } = self.state.time;
        (end - value) - carry
    }
}

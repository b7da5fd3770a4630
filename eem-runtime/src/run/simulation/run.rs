//! Many steps in one call, up to an end time that is hit exactly.

use core::ops::ControlFlow;

use super::Simulation;
use crate::step::error::StepError;
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

/// Roundings between the last full step and the end time, in ε: half a unit in the last place from the end time, as
/// much from the sum of rounded steps, and twice that to be safe.
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
        observer: impl FnMut(&Self, &StepReport<S>) -> ControlFlow<()>,
    ) -> Result<RunEnd, StepError> {
        self.run_until_event_with(end, &mut [], observer)
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

    /// Whether the end of a run lies ahead.
    pub(super) fn is_before(&self, end: S) -> Result<bool, StepError> {
        self.decide(self.time().less(end))
    }

    /// One decision for all lanes.
    fn decide(&self, mask: S::Mask) -> Result<bool, StepError> {
        let decided = mask.decide();
        decided.map_err(|discord| self.refused(discord.into()))
    }

    /// The size of a step that ends at `end`, if one of this size would end there or beyond it.
    pub(super) fn size_towards(&self, end: S, full: S) -> Result<Option<S>, StepError> {
        // With the time to twice the precision.
        let Sum { value, carry } = self.state.time;
        let left = (end - value) - carry;
        let scale = self.time().abs() + full.minimum(left);
        let rounding = S::from_f64(END_ROUNDINGS) * S::EPSILON * scale;
        if self.decide((full + rounding).less(left))? {
            return Ok(None);
        }
        let is_full = self.decide((left - full).abs().at_most(rounding))?;
        Ok(Some(if is_full { full } else { left }))
    }

    /// Sets the end of the last step to this time, which it misses by rounding.
    pub(super) fn arrive_at(&mut self, end: S, report: &mut StepReport<S>) {
        self.state.time = Sum::new(end);
        report.time = end;
    }
}

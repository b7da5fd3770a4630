//! Many steps in one call: up to an end time that is hit exactly, or with states at given times.

use core::ops::ControlFlow;

use super::compiled::Aim;
use super::memory::{Guard, SMALLEST};
use super::{Run, Simulation};
use crate::step::error::{StepError, StepFailure};
use crate::step::newton::StepReport;
use eem_material::number::compensated::Sum;
use eem_material::number::scalar::Scalar;

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

impl<const D: usize> Simulation<D> {
    /// Steps until the time `end`, s.
    ///
    /// The last step is shortened so that the time is exactly `end`; the step size for later steps does not change.
    /// If `end` is a whole number of steps ahead, up to rounding, only full steps are made. The run itself
    /// allocates nothing.
    ///
    /// # Errors
    ///
    /// The error of the failed step, with the simulation as it was before that step; [`StepFailure::End`] if `end`
    /// is not finite, lies in the past, or so far ahead that the [largest](Self::limit_steps) or constant step is rounding of the
    /// time until then.
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
    pub fn run_until(&mut self, end: f64) -> Result<(), StepError> {
        self.run.expect_finite(end)?;
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
    /// As [`run_until`](Self::run_until), but the end may be infinite.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// scene.anchor([0.0, 0.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.3)?;
    /// let end = run.run_until_with(f64::INFINITY, |run, report| {
    ///     assert_eq!(report.step, 0.3);
    ///     if run.time() > 1.4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    /// })?;
    /// assert_eq!((end, run.time()), (RunEnd::Stopped, 1.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn run_until_with(
        &mut self,
        end: f64,
        observer: impl FnMut(&Self, &StepReport) -> ControlFlow<()>,
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
    /// use eem::prelude::*;
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
        times: impl IntoIterator<Item = f64>,
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

    /// Runs to the last of these times, s, with the same steps as [`run_until`](Self::run_until), and calls
    /// `observer` at each of them.
    ///
    /// For a time within a step, the scheme makes an additional step from the beginning of that step, or from the
    /// previous time, and undoes it afterwards; so the run has the same bits as without. The observer sees states
    /// of the scheme, as accurate as the others, which obey the laws; an interpolation would not. The entropy at
    /// the end of a step can be lower than that of the last sample in it, by the error of the step. Each such time
    /// costs a step. [`run_at`](Self::run_at) ends steps at the times instead, which is cheaper for a few times, and
    /// right for discontinuous loads.
    ///
    /// If the observer stops the run, the simulation stays at the state that the observer saw last.
    ///
    /// # Errors
    ///
    /// As for [`run_until`](Self::run_until) with each of the times, which must not decrease.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// scene.mass(1.0, [0.0, 0.0], [1.0, 0.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.4)?;
    /// let mut rows = Vec::new();
    /// let end = run.sample_at(&[0.1, 0.3, 1.0, 1.6], |run| {
    ///     rows.push((run.time(), run.ledger().kinetic_energy));
    ///     ControlFlow::Continue(())
    /// })?;
    /// assert_eq!((end, run.time()), (RunEnd::Reached, 1.6));
    /// assert_eq!(rows, [(0.1, 0.5), (0.3, 0.5), (1.0, 0.5), (1.6, 0.5)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sample_at(
        &mut self,
        times: &[f64],
        mut observer: impl FnMut(&Self) -> ControlFlow<()>,
    ) -> Result<RunEnd, StepError> {
        let mut last = self.time();
        for &time in times {
            if !(last <= time && time.is_finite()) {
                let end = time;
                return Err(self.run.refused(StepFailure::End { end }));
            }
            last = time;
        }
        let mut left = times;
        while let [time, ..] = *left {
            let mut passed = 0;
            if self.run.is_before(time) {
                self.run.advance(Aim::Towards(last))?;
                let is_passed = |time: &&f64| **time < self.time();
                passed = left.iter().take_while(is_passed).count();
                if passed > 0 && self.sample(&left[..passed], &mut observer)?.is_break() {
                    return Ok(RunEnd::Stopped);
                }
            } else {
                passed += 1;
                if observer(self).is_break() {
                    return Ok(RunEnd::Stopped);
                }
            }
            left = &left[passed..];
        }
        Ok(RunEnd::Reached)
    }

    /// Shows the states at these times, which the last step has passed, by shorter steps that are undone afterwards.
    /// If the observer stops the run, the run stays at that state.
    fn sample(
        &mut self,
        times: &[f64],
        observer: &mut impl FnMut(&Self) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, StepError> {
        let after = self.run.snapshot();
        let mut guard = Guard::new(self, |run| run.run.return_to_snapshot(&after));
        let run = &mut *guard.value;
        run.run.undo();
        // One after the other, so that entropy does not fall between the times.
        for &time in times {
            while run.run.is_before(time) {
                run.run.advance(Aim::InSchemeTowards(time))?;
            }
            if observer(run).is_break() {
                guard.keep();
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }
}

impl Run {
    /// An error if nothing would end a run until this time, s: it is infinite, or the largest step is rounding of the time until
    /// then.
    pub(super) fn expect_finite(&self, end: f64) -> Result<(), StepError> {
        let control = self.control.as_ref();
        let largest = control.map_or(self.step, |control| control.memory.largest);
        let left = end - self.time();
        if end.is_finite() && SMALLEST * f64::EPSILON * left <= largest {
            return Ok(());
        }
        Err(self.refused(StepFailure::End { end }))
    }

    /// Whether the end of a run lies ahead.
    pub(super) fn is_before(&self, end: f64) -> bool {
        self.time() < end
    }

    /// The size of a step that ends at `end`, if one of this size would end there or beyond it.
    #[inline]
    pub(super) fn size_towards(&self, end: f64, full: f64) -> Option<f64> {
        // With the time to twice the precision.
        let Sum { value, carry } = self.state.time;
        let left = (end - value) - carry;
        let scale = self.time().abs() + Scalar::minimum(full, left);
        let rounding = END_ROUNDINGS * f64::EPSILON * scale;
        if full + rounding < left {
            return None;
        }
        let is_full = (left - full).abs() <= rounding;
        Some(if is_full { full } else { left })
    }

    /// Sets the end of the last step to this time, which it misses by rounding.
    #[inline]
    pub(super) fn arrive_at(&mut self, end: f64) {
        #[cfg(feature = "gradients")]
        if let Some(history) = &mut self.history {
            history.arrive(self.state.time, end);
        }
        self.state.time = Sum::new(end);
        self.report.time = end;
    }
}

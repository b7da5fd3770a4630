//! States at times that the steps of a run know nothing of.

use core::ops::ControlFlow;

use super::Simulation;
use super::control_memory::Memory;
use super::run::RunEnd;
use crate::element::state::State;
use crate::number::scalar::{Discord, Mask, Real};
use crate::step::error::{StepError, StepFailure};
use crate::step::explicit::SavedExplicit;
use crate::step::newton::StepReport;
use crate::step::outcome::Corrections;
use crate::step::solver::SavedPast;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// Runs until the last of these times, s, in the steps of [`run_until`](Self::run_until), and calls `observer` at
    /// each of them.
    ///
    /// A time between the ends of a step is reached by a step of the scheme from its beginning, or from the time before;
    /// these are then taken back, so that the run has the bits that it has without. What the observer sees are states of
    /// the scheme, as accurate as the others, which obey the laws; those of an interpolation between steps would not.
    /// Entropy may fall by the error of the steps from the last time within a step to the next one behind its end, which
    /// is reached on another way. Each time costs a step.
    /// [`run_at`](Self::run_at) makes the steps end at the times instead, which is cheaper where they are rare, and
    /// the way to meet a load that jumps.
    ///
    /// Where the observer stops the run, it stays at the state that the observer has seen.
    ///
    /// # Errors
    ///
    /// As [`run_until`](Self::run_until), of which each time is an end; times must not fall.
    ///
    /// ```
    /// use core::ops::ControlFlow;
    /// use eem::{RunEnd, Scene, Scheme, Simulation};
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
        times: &[S],
        mut observer: impl FnMut(&Self) -> ControlFlow<()>,
    ) -> Result<RunEnd, StepError> {
        if S::LANES > 1 {
            // Each of the numbers may have steps of its own.
            return Err(self.refused(Discord.into()));
        }
        let mut last = self.time();
        for &time in times {
            if !last.at_most(time).all() {
                let end = time.to_f64();
                return Err(self.refused(StepFailure::End { end }));
            }
            last = time;
        }
        let mut left = times;
        while let [time, ..] = *left {
            let mut passed = 0;
            if self.is_before(time)? {
                self.step_towards(last)?;
                let is_passed = |time: &&S| time.less(self.time()).all();
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

    /// Shows the states at these times, which the last step has passed.
    fn sample(
        &mut self,
        times: &[S],
        observer: &mut impl FnMut(&Self) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, StepError> {
        let mut sampled = Sampled::new(self);
        sampled.run.undo();
        let seen = sampled.run.sample_on_the_way(times, observer);
        sampled.stays = matches!(seen, Ok(ControlFlow::Break(())));
        seen
    }

    /// The same from where the last step began, one after the other, so that entropy does not fall between them.
    fn sample_on_the_way(
        &mut self,
        times: &[S],
        observer: &mut impl FnMut(&Self) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, StepError> {
        for &time in times {
            while self.is_before(time)? {
                self.step_in_scheme_towards(time)?;
            }
            if observer(self).is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }
}

/// A simulation that looks into its last step. It gets back the state after the step, also where the observer or a
/// load panics, unless it is to stay where it is.
struct Sampled<'a, const D: usize, S: Real> {
    run: &'a mut Simulation<D, S>,
    after: State<S>,
    past: (SavedPast<S>, Option<SavedExplicit<S>>),
    memory: Memory<S>,
    counted: (Option<StepReport<S>>, Corrections<S>),
    stays: bool,
}

impl<'a, const D: usize, S: Real> Sampled<'a, D, S> {
    fn new(run: &'a mut Simulation<D, S>) -> Self {
        Self {
            after: State::clone(&run.state),
            past: run.stepper.past(&run.state),
            memory: run.memory(),
            counted: (run.worst, run.corrections),
            stays: false,
            run,
        }
    }
}

impl<const D: usize, S: Real> Drop for Sampled<'_, D, S> {
    fn drop(&mut self) {
        if self.stays {
            return;
        }
        let run = &mut *self.run;
        run.state.copy_all_from(&self.after);
        run.stepper.restore(&self.past.0, self.past.1.as_ref());
        run.remember(self.memory);
        (run.worst, run.corrections) = self.counted;
        run.has_stepped = false;
    }
}

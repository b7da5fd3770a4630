//! States at times that the steps of a run know nothing of.

use core::ops::ControlFlow;

use super::Simulation;
use super::compiled::Aim;
use super::control_memory::Memory;
use super::run::RunEnd;
use crate::element::state::State;
use crate::step::error::{StepError, StepFailure};
use crate::step::explicit::SavedExplicit;
use crate::step::newton::StepReport;
use crate::step::outcome::Corrections;
use crate::step::solver::SavedPast;
use eem_material::number::scalar::{Discord, Mask, Real};

impl<const D: usize, S: Real> Simulation<D, S> {
    /// Runs to the last of these times, s, with the same steps as [`run_until`](Self::run_until), and calls
    /// `observer` at each of them.
    ///
    /// For a time within a step, the scheme makes an additional step from the beginning of that step, or from the
    /// previous time, and undoes it afterwards; so the run has the same bits as without. The observer sees states
    /// of the scheme, as accurate as the others, which obey the laws; an interpolation would not. The entropy at
    /// the end of a step can be lower than that of the last sample in it, by the error of the step. Each time costs
    /// a step. [`run_at`](Self::run_at) ends steps at the times instead. This is cheaper for a few times, and right
    /// for discontinuous loads.
    ///
    /// If the observer stops the run, the simulation stays at the state it has seen.
    ///
    /// # Errors
    ///
    /// As for [`run_until`](Self::run_until) with each of the times, which must not decrease.
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
                self.advance(Aim::Towards(last))?;
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
                self.advance(Aim::InSchemeTowards(time))?;
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

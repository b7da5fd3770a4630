//! States at given times within the steps of a run.

use core::ops::ControlFlow;

use super::Simulation;
use super::compiled::Aim;
use super::guard::Guard;
use super::run::RunEnd;
use crate::step::error::{StepError, StepFailure};
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
            // Each lane may have steps of its own.
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

    /// Shows the states at these times, which the last step has passed, by shorter steps that are undone afterwards.
    /// If the observer stops the run, it stays at that state.
    fn sample(
        &mut self,
        times: &[S],
        observer: &mut impl FnMut(&Self) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, StepError> {
        let after = self.snapshot();
        let mut guard = Guard::new(self, |run| run.return_to_snapshot(&after));
        let run = &mut *guard.value;
        run.undo();
        // One after the other, so that entropy does not fall between the times.
        for &time in times {
            while run.is_before(time)? {
                run.advance(Aim::InSchemeTowards(time))?;
            }
            if observer(run).is_break() {
                guard.keep();
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    }
}

//! Newton's method, iterated until the step closed at the trial state proves its laws.

use super::Solver;
use super::effort::Effort;
use super::progress::{Conclusion, Progress, Target};
use crate::element::error::StateError;
use crate::element::group::{Group, StepView};
use crate::step::certificate::Certificate;
use crate::step::error::StepFailure;
use crate::step::law::Law;
use crate::step::newton::is_last;
use eem_material::number::scalar::{Mask, Real, natural_power};

/// How often an update is halved to bring all elements back to admissible states.
const HALVINGS: u32 = 30;

impl<S: Real, const D: usize> Solver<S, D> {
    /// Newton's method from the trial state. Lanes that have converged keep their values until all have.
    ///
    /// A step ends at a trial at which the elements have been evaluated, if the last update is small and the step
    /// closed from there proves its laws. Otherwise the iteration continues until rounding stops it.
    pub(super) fn converge(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        effort: &mut Effort<S>,
        target: &mut Target<'_, S>,
    ) -> Result<(), StepFailure> {
        let max_iterations = effort.settings.max_iterations;
        let tolerance = target.tolerance(effort.settings.tolerance);
        let tolerance = self.coupling.tolerance(tolerance);
        let mut before = None;
        let mut purpose = Purpose::Iterate;
        let mut progress = Progress::new();
        self.factors.renew();
        // Lanes that have converged, and lanes that converge with the next evaluation.
        let (mut settled, mut last) = (S::Mask::none(), S::Mask::none());
        for left in (0..=max_iterations).rev() {
            let is_full = self.advance(groups, view, purpose)?;
            if is_full && purpose == Purpose::Close {
                match self.conclude(groups, view, target, &mut progress) {
                    Conclusion::Found => {
                        effort.conclude(self.final_residual);
                        return Ok(());
                    }
                    Conclusion::Refused(failure) => return Err(failure),
                    Conclusion::Open(is_enough) => {
                        settled = self.settle(is_enough);
                        last = S::Mask::none();
                        before = effort.history.last().map(|last| last.update);
                        self.linearize_again(groups, view)?;
                    }
                }
            }
            settled = self.settle(settled | last);
            if left == 0 {
                break;
            }
            let update = self.iterate(groups, view, effort, settled)?;
            if !update.is_finite() {
                break;
            }
            let previous = before.replace(update).filter(|_| is_full);
            purpose = Purpose::Iterate;
            let ends = is_last(update, previous, self.factors.tolerance(tolerance)) & !settled;
            self.factors.judge(update, previous);
            let is_stuck = self.is_stuck(&mut progress, update, previous, settled);
            if S::LANES > 1 && is_stuck {
                // Run alone, some lanes might take another branch from here.
                break;
            }
            if self.has_other_starts && progress.is_hopeless() {
                break;
            }
            last = ends;
            if is_stuck || (ends.any() && (settled | last).all()) {
                purpose = Purpose::Close;
            }
        }
        Err(self.not_converged(before))
    }

    /// Closes the step at a trial where the elements have been evaluated, and judges it.
    pub(super) fn conclude(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        target: &mut Target<'_, S>,
        progress: &mut Progress<S>,
    ) -> Conclusion<S> {
        let Target::State(next) = target else {
            return Conclusion::Found;
        };
        let certificate = match self.close(groups, view, next) {
            Ok(certificate) => certificate,
            Err(failure) => {
                progress.note_rejected(S::MAX);
                if !self.scheme.is_exact() || S::LANES > 1 || progress.is_over() {
                    return Conclusion::Refused(failure);
                }
                return Conclusion::Open(S::Mask::none());
            }
        };
        if !self.scheme.is_exact() {
            return match certificate.unless_infinite(next.time.value) {
                Ok(()) => self.found(certificate),
                Err(failure) => Conclusion::Refused(failure),
            };
        }
        if certificate.is_enough().all() {
            return self.found(certificate);
        }
        if S::LANES > 1 {
            progress.retries += 1;
            if !progress.is_over() {
                return Conclusion::Open(certificate.is_enough());
            }
        } else {
            progress.note_rejected(self.final_residual);
            let is_settled = progress.has_stopped() && certificate.is_lawful();
            if !is_settled && !progress.is_over() {
                return Conclusion::Open(S::Mask::none());
            }
        }
        if !certificate.is_balanced() || S::LANES > 1 {
            return Conclusion::Refused(StepFailure::NotConverged {
                update: progress.last.to_f64(),
            });
        }
        match certificate.unexplained_law() {
            None => self.found(certificate),
            Some((law, sizes)) => {
                let element = self.worst.filter(|_| law == Law::Energy);
                let time = view.state.time.value + view.step;
                Conclusion::Refused(law.not_kept(sizes, element, time))
            }
        }
    }

    fn found(&mut self, certificate: Certificate<S>) -> Conclusion<S> {
        self.certificate = Some(certificate);
        Conclusion::Found
    }

    /// Evaluates the tangent for another iteration, at a trial where only responses have been evaluated.
    #[cold]
    pub(super) fn linearize_again(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.factors.renew();
        self.balance(view);
        self.evaluate(groups, view, true)?;
        Ok(())
    }

    /// Whether the last update may be no smaller than the one before because of rounding.
    fn is_stuck(
        &self,
        progress: &mut Progress<S>,
        update: S,
        before: Option<S>,
        settled: S::Mask,
    ) -> bool {
        self.scheme.is_exact()
            && progress.is_stuck(update, before, settled)
            && self.coupling.may_be_rounding(update)
    }

    /// The error of a failed iteration: the one that kept the last update from being applied in full, or its size.
    #[cold]
    fn not_converged(&mut self, update: Option<S>) -> StepFailure {
        match self.obstacle.take() {
            Some(obstacle) => obstacle.into(),
            None => StepFailure::NotConverged {
                update: update.map_or(f64::NAN, Real::to_f64),
            },
        }
    }

    /// Solves the system of an iteration and applies its solution. Returns the largest scaled update.
    #[inline]
    fn iterate(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        effort: &mut Effort<S>,
        settled: S::Mask,
    ) -> Result<S, StepFailure> {
        self.final_residual = self.residual();
        let solved = self.factors.solve(&mut self.tangent);
        solved.map_err(|_| StepFailure::SingularTangent)?;
        let update = self.correct(groups, view);
        effort.note(self.final_residual, update, settled);
        Ok(update)
    }

    /// Marks in the trial the lanes that have converged while others have not.
    #[inline]
    fn settle(&mut self, settled: S::Mask) -> S::Mask {
        if S::LANES == 1 {
            return S::Mask::none();
        }
        self.trial.settled = settled;
        settled
    }

    /// Evaluates the elements at the trial state, to which the last correction has been applied, and takes parts of the
    /// correction back until every element is in an admissible state. Returns whether none was taken back.
    #[inline]
    pub(super) fn advance(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        purpose: Purpose,
    ) -> Result<bool, StepFailure> {
        if self.obstacle.is_some() {
            self.obstacle = None;
        }
        let (mut share, mut goes_on) = (S::one(), purpose == Purpose::Iterate);
        while let Err(error) = self.evaluate(groups, view, goes_on) {
            share = self.retreat(groups, view, share, error)?;
            goes_on = true;
        }
        Ok(share.equal(S::one()).all())
    }

    /// Applies half the fraction of the correction that failed. Not with several lanes, some of which need not have
    /// failed.
    #[cold]
    #[inline(never)]
    fn retreat(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        share: S,
        error: StateError,
    ) -> Result<S, StepFailure> {
        let half = S::from_f64(0.5);
        if S::LANES > 1 || share.at_most(natural_power(half, HALVINGS)).all() {
            return Err(error.into());
        }
        self.obstacle = Some(error);
        let share = half * share;
        // The part that is taken back is as large as the part that stays.
        self.take_back(view, share);
        for group in groups {
            group.apply(share);
        }
        Ok(share)
    }

    /// Evaluates the responses at the trial state and, if `goes_on`, adds their contributions to the system of the next
    /// iteration.
    #[inline]
    pub(super) fn evaluate(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        goes_on: bool,
    ) -> Result<(), StateError> {
        self.evaluations += 1;
        let trial = &self.trial;
        for group in groups {
            let system = goes_on.then_some(&mut self.tangent);
            group.evaluate(view, trial, system)?;
        }
        let system = goes_on.then_some(&mut self.tangent);
        self.rockets.evaluate(view, trial, system)
    }
}

/// The purpose of an evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// Another iteration.
    Iterate,
    /// Closing the step.
    Close,
}

//! The initial guesses of Newton's method, tried one after the other.

use super::Solver;
use super::begin::Start;
use crate::element::group::{Group, StepView};
use crate::element::state::State;
use crate::step::certificate::Certificate;
use crate::step::error::StepFailure;
use crate::step::solver::effort::{CONTINUATION_STEPS, Effort};
use crate::step::solver::progress::Target;

impl<const D: usize> Solver<D> {
    /// Finds the state after the step, or after the phase of it that the view names; returns its certificate.
    ///
    /// If Newton's method fails from the usual initial guess, all but the classical schemes try others.
    pub(crate) fn solve(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        effort: &mut Effort,
        next: &mut State,
    ) -> Result<&Certificate, StepFailure> {
        let mut closing = Target::State(next);
        self.has_other_starts = self.scheme.is_exact();
        let found = self.start_and_converge(groups, view, effort, (Start::Predicted, &mut closing));
        if let Err(failure) = found {
            if !self.scheme.follows_its_solution() {
                return Err(failure);
            }
            let found = self.try_other_starts(groups, view, effort, &mut closing);
            found.map_err(|_| failure)?;
        }
        // The step becomes the history of the predictors.
        if view.phase.heats() && self.scheme.predicts_its_start() {
            let variables = [view.state.viscous.values(), &view.state.temperatures];
            self.past.keep(variables, view.step);
        }
        Ok(&self.certificate)
    }

    /// Exact schemes start with the old internal variables, from the old state, and from the solution for another form if
    /// they have one; then the solution is followed from a small step to the full one; then temperatures are corrected by
    /// factors. If the first of these attempts was given up, an exact scheme at last makes it again, and takes all its
    /// iterations even where they seem hopeless. What would repeat an attempt bit by bit is left out: internal variables that
    /// are not predicted are the old ones, heat starts from the old state, and not every scene has temperatures.
    #[cold]
    fn try_other_starts(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        effort: &mut Effort,
        closing: &mut Target<'_>,
    ) -> Result<(), StepFailure> {
        let mut was_given_up = self.is_given_up;
        if self.scheme.is_exact() && self.past.before(view.step).is_some() {
            let start = (Start::Motion, &mut *closing);
            let found = self.start_and_converge(groups, view, effort, start);
            if found.is_ok() {
                return found;
            }
            was_given_up = self.is_given_up;
        }
        if self.scheme.is_exact() && view.phase.moves() {
            let start = (Start::Rest, &mut *closing);
            let found = self.start_and_converge(groups, view, effort, start);
            if found.is_ok() {
                return found;
            }
        }
        if self.scheme.has_starting_form() {
            let found = self.start_by_another_form(groups, view, effort, closing);
            if found.is_ok() {
                return found;
            }
        }
        let found = self.follow(groups, view, effort, closing);
        if found.is_ok() {
            return found;
        }
        if self.scheme.is_exact() && !view.state.temperatures.is_empty() {
            let start = (Start::RestByFactors, &mut *closing);
            let found = self.start_and_converge(groups, view, effort, start);
            if found.is_ok() {
                return found;
            }
        }
        if !was_given_up {
            return found;
        }
        self.has_other_starts = false;
        self.start_and_converge(groups, view, effort, (Start::Motion, closing))
    }

    /// From the solution for the starting form of the scheme.
    fn start_by_another_form(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        effort: &mut Effort,
        closing: &mut Target<'_>,
    ) -> Result<(), StepFailure> {
        let start = (Start::Motion, &mut Target::SharpTrial);
        self.trial.is_start = true;
        let started = self.start_and_converge(groups, view, effort, start);
        self.trial.is_start = false;
        started?;
        for group in groups.iter_mut() {
            group.hold();
        }
        self.converge(groups, view, effort, closing)
    }

    fn start_and_converge(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        effort: &mut Effort,
        (start, target): (Start, &mut Target<'_>),
    ) -> Result<(), StepFailure> {
        self.begin(groups, view, start)?;
        self.converge(groups, view, effort, target)
    }

    /// The solutions for growing fractions of the step, each starting from the one before.
    #[cold]
    fn follow(
        &mut self,
        groups: &mut [Box<dyn Group<D>>],
        view: &StepView<'_>,
        effort: &mut Effort,
        closing: &mut Target<'_>,
    ) -> Result<(), StepFailure> {
        let number = |part: u8| f64::from(part);
        for part in 1..=CONTINUATION_STEPS {
            let step = view.step * number(part) / number(CONTINUATION_STEPS);
            let shorter = StepView {
                step,
                per_step: step.recip(),
                ..*view
            };
            let target = if part == CONTINUATION_STEPS {
                &mut *closing
            } else {
                &mut Target::Trial
            };
            if part == 1 {
                let start = (Start::Motion, target);
                self.start_and_converge(groups, &shorter, effort, start)?;
            } else {
                self.extrapolate(groups, &shorter, number(part) / number(part - 1));
                self.converge(groups, &shorter, effort, target)?;
            }
        }
        Ok(())
    }
}

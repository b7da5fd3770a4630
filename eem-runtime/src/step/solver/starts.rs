//! The initial guesses of Newton's method, tried one after the other.

use super::begin::Start;
use super::{Search, Solver};
use crate::element::group::{Group, StepView};
use crate::element::state::State;
use crate::step::certificate::Certificate;
use crate::step::error::StepFailure;
use crate::step::newton::{CONTINUATION_STEPS, Effort};
use crate::step::solver::converge::Target;

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
        let mut search = self.search(groups, view);
        if let Err(failure) = search.start_from(Start::Predicted, effort, &mut closing) {
            if search.solver.scheme.is_classical() {
                return Err(failure);
            }
            let found = search.try_other_starts(effort, &mut closing);
            found.map_err(|_| failure)?;
        }
        // The step becomes the history of the predictors.
        if view.phase.heats() && !self.scheme.is_classical() {
            let variables = [view.state.viscous.values(), &view.state.temperatures];
            self.past.history.keep(variables, view.step);
        }
        Ok(&self.certificate)
    }
}

impl<const D: usize> Search<'_, D> {
    /// Exact schemes start with the old internal variables, from the old state, and from the solution for another form if
    /// they have one; then the solution is followed from a small step to the full one; then temperatures are corrected by
    /// factors. If the first of these attempts was given up, an exact scheme at last makes it again, and takes all its
    /// iterations even where they seem hopeless. What would repeat an attempt bit by bit is left out: internal variables that
    /// are not predicted are the old ones, heat starts from the old state, and not every scene has temperatures.
    #[cold]
    fn try_other_starts(
        &mut self,
        effort: &mut Effort,
        closing: &mut Target<'_>,
    ) -> Result<(), StepFailure> {
        let (scheme, view) = (self.solver.scheme, self.view);
        let mut was_given_up = self.solver.is_given_up;
        if scheme.is_exact() && self.solver.past.history.before(view.step).is_some() {
            if self.start_from(Start::Motion, effort, closing).is_ok() {
                return Ok(());
            }
            was_given_up = self.solver.is_given_up;
        }
        let from_rest = scheme.is_exact() && view.phase.moves();
        if from_rest && self.start_from(Start::Rest, effort, closing).is_ok() {
            return Ok(());
        }
        if scheme.has_starting_form() && self.start_by_another_form(effort, closing).is_ok() {
            return Ok(());
        }
        let followed = self.follow(effort, closing);
        if followed.is_ok() {
            return followed;
        }
        let by_factors = scheme.is_exact() && !view.state.temperatures.is_empty();
        if by_factors
            && self
                .start_from(Start::RestByFactors, effort, closing)
                .is_ok()
        {
            return Ok(());
        }
        if !was_given_up {
            return followed;
        }
        self.solver.has_other_starts = false;
        self.start_from(Start::Motion, effort, closing)
    }

    /// From the solution for the starting form of the scheme.
    fn start_by_another_form(
        &mut self,
        effort: &mut Effort,
        closing: &mut Target<'_>,
    ) -> Result<(), StepFailure> {
        self.solver.trial.is_start = true;
        let started = self.start_from(Start::Motion, effort, &mut Target::SharpTrial);
        self.solver.trial.is_start = false;
        started?;
        for group in &mut *self.groups {
            group.hold();
        }
        self.converge(effort, closing)
    }

    fn start_from(
        &mut self,
        start: Start,
        effort: &mut Effort,
        target: &mut Target<'_>,
    ) -> Result<(), StepFailure> {
        self.begin(start)?;
        self.converge(effort, target)
    }

    /// The solutions for growing fractions of the step, each starting from the one before.
    #[cold]
    fn follow(&mut self, effort: &mut Effort, closing: &mut Target<'_>) -> Result<(), StepFailure> {
        let number = |part: u8| f64::from(part);
        for part in 1..=CONTINUATION_STEPS {
            let step = self.view.step * number(part) / number(CONTINUATION_STEPS);
            let view = StepView {
                step,
                per_step: step.recip(),
                ..*self.view
            };
            let mut shorter = self.solver.search(self.groups, &view);
            let target = if part == CONTINUATION_STEPS {
                &mut *closing
            } else {
                &mut Target::Trial
            };
            if part == 1 {
                shorter.start_from(Start::Motion, effort, target)?;
            } else {
                shorter.extrapolate(number(part) / number(part - 1));
                shorter.converge(effort, target)?;
            }
        }
        Ok(())
    }
}

//! Newton's method, iterated until the step closed at the trial state proves its laws.

use super::{Search, Solver};
use crate::element::error::StateError;
use crate::element::state::State;
use crate::step::error::StepFailure;
use crate::step::law::Law;
use crate::step::newton::{CONTRACTION, Effort, STAGNATION, is_last};
use eem_material::number::scalar::{Scalar, natural_power};

/// How often an update is halved to bring all elements back to admissible states.
const HALVINGS: u32 = 30;

impl<const D: usize> Search<'_, D> {
    /// Newton's method from the trial state.
    ///
    /// A step ends at a trial at which the elements have been evaluated, if the last update is small and the step
    /// closed from there proves its laws. Otherwise the iteration continues until rounding stops it.
    pub(super) fn converge(
        &mut self,
        effort: &mut Effort,
        target: &mut Target<'_>,
    ) -> Result<(), StepFailure> {
        let max_iterations = effort.settings.max_iterations;
        let tolerance = target.tolerance(effort.settings.tolerance);
        let tolerance = self.solver.coupling.tolerance(tolerance);
        let mut before = None;
        let mut goes_on = true;
        let mut progress = Progress::new();
        self.solver.factors.renew();
        self.solver.is_given_up = false;
        for left in (0..=max_iterations).rev() {
            let is_full = self.advance(goes_on)?;
            if is_full && !goes_on {
                match self.conclude(target, &mut progress) {
                    Conclusion::Found => {
                        effort.conclude(self.solver.final_residual);
                        return Ok(());
                    }
                    Conclusion::Refused(failure) => return Err(failure),
                    Conclusion::Open => {
                        before = effort.history.last().map(|last| last.update);
                        self.linearize_again()?;
                    }
                }
            }
            if left == 0 {
                break;
            }
            let update = self.iterate(effort)?;
            if !update.is_finite() {
                break;
            }
            let previous = before.replace(update).filter(|_| is_full);
            let ends = is_last(update, previous, self.solver.factors.tolerance(tolerance));
            self.solver.factors.judge(update, previous);
            let is_stuck = self.solver.is_stuck(&mut progress, update, previous);
            if self.solver.has_other_starts && progress.is_hopeless() {
                self.solver.is_given_up = true;
                break;
            }
            goes_on = !is_stuck && !ends;
        }
        Err(self.solver.not_converged(before))
    }

    /// Closes the step at a trial where the elements have been evaluated, and judges it.
    fn conclude(&mut self, target: &mut Target<'_>, progress: &mut Progress) -> Conclusion {
        let Target::State(next) = target else {
            return Conclusion::Found;
        };
        if let Err(failure) = self.close(next) {
            progress.note_rejected(f64::MAX);
            if !self.solver.scheme.is_exact() || progress.is_over() {
                return Conclusion::Refused(failure);
            }
            return Conclusion::Open;
        }
        let certificate = &self.solver.certificate;
        if !self.solver.scheme.is_exact() {
            let finite = certificate.unless_infinite(next.time.value);
            return finite.map_or_else(Conclusion::Refused, |()| Conclusion::Found);
        }
        if certificate.is_enough() {
            return Conclusion::Found;
        }
        progress.note_rejected(self.solver.final_residual);
        let is_settled = progress.stuck > 0 && certificate.is_lawful();
        if !is_settled && !progress.is_over() {
            return Conclusion::Open;
        }
        if !certificate.is_balanced {
            return Conclusion::Refused(StepFailure::NotConverged {
                update: progress.last,
            });
        }
        match certificate.unexplained_law() {
            None => Conclusion::Found,
            Some((law, sizes)) => {
                let element = self.solver.worst.filter(|_| law == Law::Energy);
                let time = self.view.state.time.value + self.view.step;
                Conclusion::Refused(law.not_kept(sizes, element, time))
            }
        }
    }

    /// Evaluates the tangent for another iteration, at a trial where only responses have been evaluated.
    #[cold]
    fn linearize_again(&mut self) -> Result<(), StateError> {
        self.solver.factors.renew();
        self.solver.balance(self.view);
        self.evaluate(true)
    }

    /// Solves the system of an iteration and applies its solution. Returns the largest scaled update.
    #[inline]
    fn iterate(&mut self, effort: &mut Effort) -> Result<f64, StepFailure> {
        self.solver.factors.solve(&mut self.solver.tangent)?;
        let update = self.correct();
        effort.note(self.solver.final_residual, update);
        Ok(update)
    }

    /// Evaluates the elements at the trial state, to which the last correction has been applied, and takes parts of the
    /// correction back until every element is in an admissible state. Returns whether none was taken back. Unless it `goes_on`, the step is
    /// to be closed there.
    #[inline]
    pub(super) fn advance(&mut self, mut goes_on: bool) -> Result<bool, StepFailure> {
        self.solver.obstacle = None;
        let mut share = 1.0;
        while let Err(error) = self.evaluate(goes_on) {
            share = self.retreat(share, error)?;
            goes_on = true;
        }
        Ok(share >= 1.0)
    }

    /// Applies half the fraction of the correction that failed.
    #[cold]
    #[inline(never)]
    fn retreat(&mut self, share: f64, error: StateError) -> Result<f64, StepFailure> {
        if share <= natural_power(0.5, HALVINGS) {
            return Err(error.into());
        }
        self.solver.obstacle = Some(error);
        let share = 0.5 * share;
        // The part that is taken back is as large as the part that stays.
        self.solver.take_back(self.view, share);
        for group in &mut *self.groups {
            group.apply(share);
        }
        Ok(share)
    }

    /// Evaluates the responses at the trial state and, if `goes_on`, adds their contributions to the system of the next
    /// iteration.
    #[inline]
    pub(super) fn evaluate(&mut self, goes_on: bool) -> Result<(), StateError> {
        self.solver.evaluations += 1;
        let trial = &self.solver.trial;
        for group in &mut *self.groups {
            let system = goes_on.then_some(&mut self.solver.tangent);
            group.evaluate(self.view, trial, system)?;
        }
        if self.solver.rockets.are_none() || !self.view.phase.moves() {
            return Ok(());
        }
        let system = goes_on.then_some(&mut self.solver.tangent);
        let displacements = |stage: usize| trial.displacements_of_set(stage).as_flattened();
        (self.solver.rockets).evaluate(self.view, &displacements, system)
    }
}

impl<const D: usize> Solver<D> {
    /// Whether the last update may be no smaller than the one before because of rounding.
    fn is_stuck(&self, progress: &mut Progress, update: f64, before: Option<f64>) -> bool {
        self.scheme.is_exact()
            && progress.is_stuck(update, before)
            && self.coupling.may_be_rounding(update)
    }

    /// The error of a failed iteration: the one that kept the last update from being applied in full, or its size.
    #[cold]
    fn not_converged(&mut self, update: Option<f64>) -> StepFailure {
        match self.obstacle.take() {
            Some(obstacle) => obstacle.into(),
            None => StepFailure::NotConverged {
                update: update.unwrap_or(f64::NAN),
            },
        }
    }
}

/// Extra iterations after stagnation while the certificate fails; each changes the rounding errors.
const MOST_RETRIES: u32 = 3;

/// A residual counts as smaller only below this fraction of the smallest one so far.
const SLOWEST: f64 = 0.75;

/// The aim of an iteration.
pub(super) enum Target<'a> {
    /// A trial, as the initial guess for another iteration.
    Trial,
    /// Such a trial, converged as far as rounding allows.
    SharpTrial,
    /// A new state.
    State(&'a mut State),
}

/// The result of closing a trial.
enum Conclusion {
    /// The step ends there.
    Found,
    /// Another iteration is needed.
    Open,
    /// No iteration will help.
    Refused(StepFailure),
}

/// Iterations after which an attempt is given up if none of its updates has been small, as long as there
/// are other starts.
const PATIENCE: usize = 10;

/// Whether Newton's method converges, and how often rounding has stopped it.
#[derive(Clone, Copy, Debug)]
struct Progress {
    /// Iterations of this attempt.
    iterations: usize,
    /// The last update, and the smallest so far.
    last: f64,
    smallest: f64,
    /// Consecutive updates that did not fall: rounding stops the iteration.
    stuck: u32,
    /// Rejected states at rounding level since the residual last fell, and that residual, N s.
    retries: u32,
    residual: f64,
}

impl Target<'_> {
    /// The largest update that may be the last one.
    fn tolerance(&self, usual: f64) -> f64 {
        match self {
            Self::Trial | Self::State(_) => usual,
            Self::SharpTrial => f64::EPSILON,
        }
    }
}

impl Progress {
    /// Before the first iteration.
    fn new() -> Self {
        Self {
            iterations: 0,
            last: f64::MAX,
            smallest: f64::MAX,
            stuck: 0,
            retries: 0,
            residual: f64::MAX,
        }
    }

    /// Counts another update. Returns whether rounding may keep it from being smaller.
    ///
    /// The smallest possible update depends on the conditioning, so that its size does not decide: the balances are
    /// checked wherever an update does not fall.
    fn is_stuck(&mut self, update: f64, before: Option<f64>) -> bool {
        self.iterations += 1;
        self.last = update;
        self.smallest = Scalar::minimum(self.smallest, update);
        let Some(before) = before else {
            return false;
        };
        let stagnates = STAGNATION * before <= update;
        let is_small = update < CONTRACTION;
        self.stuck = if stagnates && is_small {
            self.stuck + 1
        } else {
            0
        };
        self.stuck > 0
    }

    /// Whether no update has been small in [`PATIENCE`] or more iterations.
    fn is_hopeless(&self) -> bool {
        self.iterations >= PATIENCE && CONTRACTION < self.smallest
    }

    /// Counts a rejected state with this residual. A clearly smaller residual restarts the count: iterating helps then,
    /// however slowly.
    fn note_rejected(&mut self, residual: f64) {
        if residual < SLOWEST * self.residual {
            self.retries = 0;
            self.residual = residual;
        } else {
            self.retries += 1;
        }
    }

    /// Whether all extra iterations are used up.
    fn is_over(&self) -> bool {
        self.retries > MOST_RETRIES
    }
}

//! Whether a step may be taken at a trial state.

use super::Solver;
use crate::certificate::{Certificate, Demand};
use crate::error::{Law, StepFailure};
use crate::group::{Group, StepView};
use crate::newton::{CONTRACTION, STAGNATION};
use crate::scalar::Real;
use crate::state::State;

/// How often a step that breaks a law where Newton's method has come to rest is tried with another
/// iteration: rounding makes each of them a new draw.
const REDRAWS: u32 = 3;

/// What an iteration is to find.
pub(super) enum Target<'a, S> {
    /// A trial from which another one starts.
    Trial,
    /// A new state.
    State(&'a mut State<S>),
}

/// What comes of a trial.
pub(super) enum Conclusion<S: Real> {
    /// The step ends there; with a certificate if a state was asked for.
    Found(Option<Certificate<S>>),
    /// Another iteration is needed.
    Open,
    /// No iteration will help.
    Refused(StepFailure),
}

/// How long Newton's method has been where rounding stops it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rest {
    updates: u32,
}

impl Rest {
    /// Counts another update; whether rounding may be what keeps it from being smaller.
    ///
    /// How small an update can be depends on the conditioning, so that its size does not decide: an update
    /// that does not fall shows a state at which the balances are looked at.
    pub(super) fn is_stuck<S: Real>(&mut self, update: S, before: Option<S>) -> bool {
        let stagnates = before.is_some_and(|before| update >= S::from_f64(STAGNATION) * before);
        let is_small = update < S::from_f64(CONTRACTION);
        self.updates = if stagnates && is_small {
            self.updates + 1
        } else {
            0
        };
        self.updates > 0
    }

    /// Rounding stops it.
    fn has_stopped(self) -> bool {
        self.updates > 0
    }

    /// Nothing is left to draw.
    fn is_over(self) -> bool {
        self.updates > REDRAWS
    }
}

impl<S: Real, const D: usize> Solver<S, D> {
    /// Closes the step at a trial where the elements have been evaluated, and judges it.
    pub(super) fn conclude(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        target: &mut Target<'_, S>,
        rest: Rest,
    ) -> Conclusion<S> {
        let Target::State(next) = target else {
            return Conclusion::Found(None);
        };
        let certificate = match self.close(groups, view, next) {
            Ok(certificate) => certificate,
            Err(failure) if !self.scheme.is_exact() || S::LANES > 1 || rest.is_over() => {
                return Conclusion::Refused(failure);
            }
            Err(_) => return Conclusion::Open,
        };
        if !self.scheme.is_exact() {
            return match certificate.unless_infinite(next.time.value) {
                Ok(()) => Conclusion::Found(Some(certificate)),
                Err(failure) => Conclusion::Refused(failure),
            };
        }
        if certificate.is_enough() {
            return Conclusion::Found(Some(certificate));
        }
        if S::LANES == 1 && !rest.is_over() && !(rest.has_stopped() && certificate.is_lawful()) {
            return Conclusion::Open;
        }
        match certificate.broken_law(Demand::Law) {
            None if certificate.is_balanced() => Conclusion::Found(Some(certificate)),
            None => Conclusion::Refused(StepFailure::NotConverged { update: f64::NAN }),
            Some((law, sizes)) => {
                let element = self.worst.filter(|_| law == Law::Energy);
                Conclusion::Refused(law.not_kept(sizes, element, next.time.value))
            }
        }
    }

    /// The tangent at a trial where only responses have been evaluated, for another iteration.
    #[cold]
    pub(super) fn linearize_again(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.balance();
        self.evaluate(groups, view, true)?;
        Ok(())
    }
}

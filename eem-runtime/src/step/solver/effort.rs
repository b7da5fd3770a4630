//! The effort of a step: its limits and its iterations.

use crate::step::newton::{NewtonIteration, NewtonSettings};
use eem_material::number::scalar::{Mask, Real, unless};

/// Number of parts of a step through which the solution is continued if Newton's method fails.
pub(super) const CONTINUATION_STEPS: u8 = 8;

/// Iterations for which memory is reserved; more of them allocate.
const LONGEST_HISTORY: usize = 4096;

/// The effort of a step: its limits and its iterations.
#[derive(Debug)]
pub(crate) struct Effort<S> {
    pub(crate) settings: NewtonSettings<S>,
    /// The iterations of the last step.
    pub(crate) history: Vec<Iteration<S>>,
    /// The largest residual and the largest last update of the phases of the last step.
    pub(crate) end: Iteration<S>,
}

/// One iteration of Newton's method.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Iteration<S> {
    /// The largest momentum residual before the update, N s.
    pub(crate) residual: S,
    /// The largest scaled update.
    pub(crate) update: S,
}

impl<S: Real> Iteration<S> {
    /// No iteration.
    fn none() -> Self {
        Self {
            residual: S::zero(),
            update: S::zero(),
        }
    }

    /// The same in double precision.
    pub(crate) fn to_f64(self) -> NewtonIteration {
        NewtonIteration {
            residual: self.residual.to_f64(),
            update: self.update.to_f64(),
        }
    }
}

impl<S: Real> Effort<S> {
    /// The usual settings, before the first step.
    pub(crate) fn new() -> Self {
        Self {
            settings: NewtonSettings::default(),
            history: Vec::new(),
            end: Iteration::none(),
        }
    }

    /// Records an iteration; lanes that had converged before keep their last one.
    #[inline]
    pub(crate) fn note(&mut self, residual: S, update: S, settled: S::Mask) {
        if S::LANES > 1
            && settled.any()
            && let Some(last) = self.history.last()
        {
            let residual = unless(settled, last.residual, residual);
            let update = unless(settled, last.update, update);
            self.history.push(Iteration { residual, update });
        } else {
            self.history.push(Iteration { residual, update });
        }
    }

    /// Ends a phase of the step, with this residual after the last update.
    #[inline]
    pub(crate) fn conclude(&mut self, residual: S) {
        let update = self.history.last().map_or(S::zero(), |last| last.update);
        self.end = Iteration {
            residual: self.end.residual.maximum(residual),
            update: self.end.update.maximum(update),
        };
    }

    /// Clears the record of the last step.
    pub(crate) fn restart(&mut self) {
        // At worst, two phases of a staggered step, each from two starts and through all continuation steps.
        let parts = 2 * usize::from(CONTINUATION_STEPS + 2);
        let most = self.settings.max_iterations.saturating_mul(parts);
        self.end = Iteration::none();
        self.history.clear();
        self.history.reserve(most.min(LONGEST_HISTORY));
    }
}

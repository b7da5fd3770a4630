//! Progress and aim of Newton's method.

use crate::element::state::State;
use crate::step::error::StepFailure;
use crate::step::newton::{CONTRACTION, STAGNATION};
use eem_material::number::scalar::Scalar;

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
pub(super) enum Conclusion {
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
pub(super) struct Progress {
    /// Iterations of this attempt.
    iterations: usize,
    /// The last update, and the smallest so far.
    pub(super) last: f64,
    smallest: f64,
    /// Consecutive updates that did not fall.
    stuck: u32,
    /// Rejected states at rounding level since the residual last fell, and that residual, N s.
    retries: u32,
    residual: f64,
}

impl Target<'_> {
    /// The largest update that may be the last one.
    pub(super) fn tolerance(&self, usual: f64) -> f64 {
        match self {
            Self::Trial | Self::State(_) => usual,
            Self::SharpTrial => f64::EPSILON,
        }
    }
}

impl Progress {
    /// Before the first iteration.
    pub(super) fn new() -> Self {
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
    pub(super) fn is_stuck(&mut self, update: f64, before: Option<f64>) -> bool {
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
    pub(super) fn is_hopeless(&self) -> bool {
        self.iterations >= PATIENCE && CONTRACTION < self.smallest
    }

    /// Counts a rejected state with this residual. A clearly smaller residual restarts the count: iterating helps then,
    /// however slowly.
    pub(super) fn note_rejected(&mut self, residual: f64) {
        if residual < SLOWEST * self.residual {
            self.retries = 0;
            self.residual = residual;
        } else {
            self.retries += 1;
        }
    }

    /// Whether rounding stops the iteration.
    pub(super) fn has_stopped(&self) -> bool {
        self.stuck > 0
    }

    /// Whether all extra iterations are used up.
    pub(super) fn is_over(&self) -> bool {
        self.retries > MOST_RETRIES
    }
}

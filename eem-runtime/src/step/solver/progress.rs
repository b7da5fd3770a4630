//! Progress and aim of Newton's method.

use crate::element::state::State;
use crate::step::error::StepFailure;
use crate::step::newton::{CONTRACTION, STAGNATION};
use eem_material::number::scalar::{Mask, Real};

/// Extra iterations after stagnation while the certificate fails; each changes the rounding errors.
const REDRAWS: u32 = 3;

/// The slowest decrease of the residual that counts as one.
const SLOWEST: f64 = 0.75;

/// The aim of an iteration.
pub(super) enum Target<'a, S> {
    /// A trial from which another one starts.
    Trial,
    /// The same, as sharp as rounding allows.
    SharpTrial,
    /// A new state.
    State(&'a mut State<S>),
}

/// The result of closing a trial.
pub(super) enum Conclusion<S: Real> {
    /// The step ends there.
    Found,
    /// Another iteration is needed, but for those of several numbers where the mask holds.
    Open(S::Mask),
    /// No iteration will help.
    Refused(StepFailure),
}

/// Iterations after which an attempt is given up if none of its updates has been small, as long as there
/// are other starts.
const PATIENCE: usize = 10;

/// Whether Newton's method converges, and how long it has been where rounding stops it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Progress<S> {
    /// Iterations of this attempt.
    iterations: usize,
    /// The last update, and the smallest so far.
    pub(super) last: S,
    smallest: S,
    /// Consecutive updates that did not fall.
    stuck: u32,
    /// Rejected states at rounding level, and the smallest residual of them.
    pub(super) draws: u32,
    residual: S,
}

impl<S: Real> Target<'_, S> {
    /// The largest update that may be the last one.
    pub(super) fn tolerance(&self, usual: S) -> S {
        match self {
            Self::Trial | Self::State(_) => usual,
            Self::SharpTrial => S::EPSILON,
        }
    }
}

impl<S: Real> Progress<S> {
    /// Before the first iteration.
    pub(super) fn new() -> Self {
        Self {
            iterations: 0,
            last: S::MAX,
            smallest: S::MAX,
            stuck: 0,
            draws: 0,
            residual: S::MAX,
        }
    }

    /// Counts another update; whether rounding may be what keeps it from being smaller.
    ///
    /// How small an update can be depends on the conditioning, so that its size does not decide: an update
    /// that does not fall shows a state at which the balances are looked at.
    pub(super) fn is_stuck(&mut self, update: S, before: Option<S>, settled: S::Mask) -> bool {
        self.iterations += 1;
        self.last = update;
        self.smallest = self.smallest.minimum(update);
        let Some(before) = before else {
            return false;
        };
        let stagnates = (S::from_f64(STAGNATION) * before).at_most(update);
        let is_small = update.less(S::from_f64(CONTRACTION));
        self.stuck = if (stagnates & is_small & !settled).any() {
            self.stuck + 1
        } else {
            0
        };
        self.stuck > 0
    }

    /// No update has been small for long.
    pub(super) fn is_hopeless(&self) -> bool {
        self.iterations >= PATIENCE && S::from_f64(CONTRACTION).less(self.smallest).all()
    }

    /// Counts a refused state with this residual; one with a smaller residual than before shows that
    /// iterating helps, however slowly.
    pub(super) fn draw(&mut self, residual: S) {
        if residual.less(S::from_f64(SLOWEST) * self.residual).all() {
            self.draws = 0;
            self.residual = residual;
        } else {
            self.draws += 1;
        }
    }

    /// Rounding stops it.
    pub(super) fn has_stopped(&self) -> bool {
        self.stuck > 0
    }

    /// All extra iterations are used up.
    pub(super) fn is_over(&self) -> bool {
        self.draws > REDRAWS
    }
}

//! The effort of a step: its limits and its iterations.

use crate::step::newton::{NewtonIteration, NewtonSettings};
use eem_material::number::scalar::Scalar;

/// Number of parts of a step through which the solution is continued if Newton's method fails.
pub(super) const CONTINUATION_STEPS: u8 = 8;

/// Iterations for which memory is reserved; more of them allocate.
const LONGEST_HISTORY: usize = 4096;

/// The effort of a step: its limits and its iterations.
#[derive(Debug)]
pub(crate) struct Effort {
    pub(crate) settings: NewtonSettings,
    /// The iterations of the last step.
    pub(crate) history: Vec<NewtonIteration>,
    /// The largest residual and the largest last update of the phases of the last step.
    pub(crate) end: NewtonIteration,
}

/// No iteration.
const NONE: NewtonIteration = NewtonIteration {
    residual: 0.0,
    update: 0.0,
};

impl Effort {
    /// The usual settings, before the first step.
    pub(crate) fn new() -> Self {
        Self {
            settings: NewtonSettings::default(),
            history: Vec::new(),
            end: NONE,
        }
    }

    /// The same as [`new`](Self::new), in the memory of a run.
    pub(crate) fn renewed(mut self) -> Self {
        self.history.clear();
        Self {
            history: self.history,
            ..Self::new()
        }
    }

    /// Records an iteration.
    #[inline]
    pub(crate) fn note(&mut self, residual: f64, update: f64) {
        self.history.push(NewtonIteration { residual, update });
    }

    /// Ends a phase of the step, with this residual after the last update.
    #[inline]
    pub(crate) fn conclude(&mut self, residual: f64) {
        let update = self.history.last().map_or(0.0, |last| last.update);
        self.end = NewtonIteration {
            residual: Scalar::maximum(self.end.residual, residual),
            update: Scalar::maximum(self.end.update, update),
        };
    }

    /// Clears the record of the last step.
    pub(crate) fn restart(&mut self) {
        // At worst, two phases of a staggered step, each from two starts and through all continuation steps.
        let parts = 2 * usize::from(CONTINUATION_STEPS + 2);
        let most = self.settings.max_iterations.saturating_mul(parts);
        self.end = NONE;
        self.history.clear();
        self.history.reserve(most.min(LONGEST_HISTORY));
    }
}

//! What to try where a step of a fixed size fails.

use super::{Simulation, Tried};
use crate::step::error::StepError;
use crate::step::explicit::Demand;
use eem_material::number::scalar::Real;

/// So often the step is halved to find one that can be made.
const HALVINGS: usize = 10;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// The error with a shorter step that can be made instead, if one is found by trying; the simulation is as it was.
    #[cold]
    pub(super) fn with_shorter(&mut self, mut error: StepError, size: S) -> StepError {
        if S::LANES > 1 || self.control.is_some() || !error.failure.depends_on_step() {
            return error;
        }
        let (worst, corrections) = (self.worst, self.corrections);
        let (past, explicit) = self.stepper.past(&self.state);
        let mut shorter = size;
        for _ in 0..HALVINGS {
            shorter *= S::from_f64(0.5);
            if let Ok(Tried::Made(_)) = self.try_step(shorter, Demand::None) {
                self.undo();
                error.shorter = Some(shorter.to_f64());
                break;
            }
        }
        self.stepper.restore(&past, explicit.as_ref());
        (self.worst, self.corrections) = (worst, corrections);
        error
    }
}

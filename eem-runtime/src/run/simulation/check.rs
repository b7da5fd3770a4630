//! What a step size and the end of a step must be.

use crate::number::scalar::{Real, is_positive};
use crate::scene::error::SceneError;
use crate::step::error::StepFailure;

/// The time at the end of a step is finite.
pub(super) fn check_end<S: Real>(time: S) -> Result<(), StepFailure> {
    if time.is_finite() {
        Ok(())
    } else {
        let value = time.to_f64();
        Err(StepFailure::Time { value })
    }
}

/// A step is positive and finite.
pub(super) fn check_step<S: Real>(step: S) -> Result<(), SceneError> {
    if is_positive(step) {
        Ok(())
    } else {
        let value = step.to_f64();
        Err(SceneError::Step { value })
    }
}

//! What a step size, the end of a step and the scheme of solids must be.

use crate::number::scalar::{Real, is_positive};
use crate::scene::error::SceneError;
use crate::step::error::StepFailure;
use crate::step::scheme::{Closing, Scheme};

/// The time at the end of a step is finite.
pub(super) fn check_end<S: Real>(time: S) -> Result<(), StepFailure> {
    if time.is_finite() {
        Ok(())
    } else {
        let value = time.to_f64();
        Err(StepFailure::Time { value })
    }
}

/// The scheme can step solids, whose masses couple nodes.
pub(super) fn check_solids(scheme: Scheme) -> Result<(), SceneError> {
    let name = scheme.name();
    match scheme.closing() {
        Closing::Increments => Ok(()),
        Closing::Explicit => Err(SceneError::ExplicitSolids { scheme: name }),
        Closing::Start | Closing::Stages => Err(SceneError::NotForSolids { scheme: name }),
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

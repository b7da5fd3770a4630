//! Equal steps from the start of a scene to a common end time.

use crate::error::StudyError;

/// The most steps of a run.
pub(crate) const MOST_STEPS: u32 = u32::MAX;

/// Roundings, in units of ε times the end time, by which a whole number of steps may miss the end: half a unit
/// each from writing the step and the end as doubles and from their product, and as much again to be safe.
const ROUNDINGS: f64 = 4.0;

/// So many equal steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    /// s.
    pub(crate) step: f64,
    pub(crate) steps: u32,
}

impl Grid {
    /// Steps of this size up to the time `end`, s.
    pub(crate) fn of(step: f64, end: f64) -> Result<Self, StudyError> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(StudyError::Step { step });
        }
        let steps = (end / step).round();
        if steps > f64::from(MOST_STEPS) {
            let most = MOST_STEPS;
            return Err(StudyError::TooManySteps { step, end, most });
        }
        let is_hit = (steps * step - end).abs() <= ROUNDINGS * f64::EPSILON * end;
        if steps >= 1.0 && is_hit {
            let steps = whole(steps);
            return Ok(Self { step, steps });
        }
        let steps = (end / step).floor();
        Err(StudyError::NoWholeSteps {
            step,
            end,
            shorter: end / (steps + 1.0),
            longer: end / steps.max(1.0),
        })
    }

    /// So many equal steps up to the time `end`, s; `None` if a study does not count so far.
    pub(crate) fn divided(end: f64, steps: u64) -> Option<Self> {
        let steps = u32::try_from(steps).ok()?;
        let step = end / f64::from(steps);
        Some(Self { step, steps })
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a whole number from 1 to MOST_STEPS"
)]
fn whole(number: f64) -> u32 {
    number as u32
}

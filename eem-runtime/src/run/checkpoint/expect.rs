//! What a checkpoint must have in common with a simulation.

use super::error::RestoreError;
use eem_material::number::scalar::Real;

pub(super) fn expect_count(
    quantity: &'static str,
    checkpoint: usize,
    simulation: usize,
) -> Result<(), RestoreError> {
    if checkpoint == simulation {
        return Ok(());
    }
    Err(RestoreError::Count {
        quantity,
        checkpoint,
        simulation,
    })
}

pub(super) fn expect_all<S: Real>(
    required: &'static str,
    quantity: &'static str,
    mut values: impl Iterator<Item = S>,
    is_met: fn(S) -> bool,
) -> Result<(), RestoreError> {
    match values.find(|&value| !is_met(value)) {
        None => Ok(()),
        Some(value) => Err(RestoreError::Value {
            quantity,
            value: value.to_f64(),
            required,
        }),
    }
}

//! Why a step has neither adjoint nor tangents.

use crate::element::error::StateError;

/// Why a step has no adjoint, and no tangents.
pub(crate) enum NoAdjoint {
    /// Its equations do not determine the new state.
    Singular,
    /// An element cannot be in one of the states.
    State(StateError),
}

impl From<StateError> for NoAdjoint {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}

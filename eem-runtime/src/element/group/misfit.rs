//! Why an element cannot be in a state that comes from outside.

use crate::element::error::StateError;

/// Why an element cannot be in a state that comes from outside.
#[derive(Clone, Debug)]
pub(crate) enum Misfit {
    /// It cannot be in it at all.
    State(StateError),
    /// Its entropy (J/K) is not that of its temperature (K), and what rounding explains.
    Entropy {
        element: usize,
        entropy: f64,
        expected: f64,
        temperature: f64,
        bound: f64,
    },
}

impl From<StateError> for Misfit {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}

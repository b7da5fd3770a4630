//! Why an element has no response.

use crate::element::error::StateError;
use crate::element::handle::Element;
use eem_material::inversion::InversionError;
use eem_material::number::scalar::is_positive;

/// Why an element has no response.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Infeasible {
    /// No temperature has this entropy.
    Entropy {
        entropy: f64,
        source: InversionError,
    },
    /// The heat capacity is not positive at this temperature.
    HeatCapacity { value: f64, temperature: f64 },
}

impl Infeasible {
    /// An error unless the heat capacity is positive and finite.
    pub(crate) fn unless_stable(heat_capacity: f64, theta: f64) -> Result<(), Self> {
        if is_positive(heat_capacity) {
            return Ok(());
        }
        Err(Self::HeatCapacity {
            value: heat_capacity,
            temperature: theta,
        })
    }

    /// As the error of an element.
    pub(crate) fn of(self, element: Element) -> StateError {
        match self {
            // The inversion starts from a state of the same element: an unstable start is a heat
            // capacity that is not positive.
            Self::Entropy {
                source:
                    InversionError::UnstableStart {
                        start,
                        heat_capacity,
                    },
                ..
            } => StateError::HeatCapacity {
                element,
                value: heat_capacity,
                temperature: start,
            },
            Self::Entropy { entropy, source } => StateError::NoSuchTemperature {
                element,
                entropy,
                source,
            },
            Self::HeatCapacity { value, temperature } => StateError::HeatCapacity {
                element,
                value,
                temperature,
            },
        }
    }
}

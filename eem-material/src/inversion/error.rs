//! Why no temperature was found, with the numbers that say so.

use crate::number::readable::Readable;

/// Why [`invert`](crate::invert) found no temperature.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InversionError {
    /// The wanted entropy is not finite.
    #[error("the entropy {entropy} is not finite", entropy = Readable(*entropy))]
    EntropyNotFinite {
        /// The wanted entropy.
        entropy: f64,
    },
    /// The starting temperature is not a positive finite number.
    #[error("the starting temperature {start} is not positive and finite", start = Readable(*start))]
    InvalidStart {
        /// The starting temperature.
        start: f64,
    },
    /// The heat capacity at the start is not a positive finite number.
    #[error("the heat capacity {heat_capacity} at the starting temperature {start} is not positive and finite", heat_capacity = Readable(*heat_capacity), start = Readable(*start))]
    UnstableStart {
        /// The starting temperature.
        start: f64,
        /// `C = θS_θ` there.
        heat_capacity: f64,
    },
    /// The stable branch through the start ends, at a spinodal or at the limits
    /// of the numbers, before the entropy is reached.
    #[error("no temperature of the stable branch has the entropy {entropy}; it comes as near as {residual} at the temperature {temperature}", entropy = Readable(*entropy), residual = Readable(*residual), temperature = Readable(*temperature))]
    NoSuchTemperature {
        /// The wanted entropy.
        entropy: f64,
        /// The stable temperature whose entropy is nearest.
        temperature: f64,
        /// `S(θ) − s` there.
        residual: f64,
        /// How many times the search evaluated the entropy.
        evaluations: usize,
    },
    /// The entropy is not the continuous function that it should be.
    #[error("no temperature of the entropy {entropy} after {evaluations} evaluations; it comes as near as {residual} at the temperature {temperature}", entropy = Readable(*entropy), residual = Readable(*residual), temperature = Readable(*temperature))]
    TooManyEvaluations {
        /// The wanted entropy.
        entropy: f64,
        /// The stable temperature whose entropy is nearest.
        temperature: f64,
        /// `S(θ) − s` there.
        residual: f64,
        /// How many times the search evaluated the entropy.
        evaluations: usize,
    },
}

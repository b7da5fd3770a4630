//! Why no temperature was found, with the numbers that say so.

/// Why [`invert`](crate::invert) found no temperature.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InversionError {
    /// The wanted entropy is not finite.
    #[error("the entropy {entropy:e} is not finite")]
    EntropyNotFinite {
        /// The wanted entropy.
        entropy: f64,
    },
    /// The starting temperature is not a positive finite number.
    #[error("the starting temperature {start:e} is not positive and finite")]
    InvalidStart {
        /// The starting temperature.
        start: f64,
    },
    /// The heat capacity at the start is not a positive finite number.
    #[error(
        "the heat capacity {heat_capacity:e} at the starting temperature {start:e} is not positive and finite"
    )]
    UnstableStart {
        /// The starting temperature.
        start: f64,
        /// `C = θS_θ` there.
        heat_capacity: f64,
    },
    /// The stable branch through the start ends, at a spinodal or at the limits
    /// of the number type, before the entropy is reached.
    #[error(
        "no temperature of the stable branch has the entropy {entropy:e}; it comes as near as {residual:e} at the temperature {temperature:e}"
    )]
    NoSuchTemperature {
        /// The wanted entropy.
        entropy: f64,
        /// The stable temperature whose entropy is nearest.
        temperature: f64,
        /// `S(θ) − s` there.
        residual: f64,
        /// How many times the entropy was evaluated.
        evaluations: usize,
    },
    /// The entropy is not the continuous function that it should be.
    #[error(
        "no temperature of the entropy {entropy:e} after {evaluations} evaluations; it comes as near as {residual:e} at the temperature {temperature:e}"
    )]
    TooManyEvaluations {
        /// The wanted entropy.
        entropy: f64,
        /// The stable temperature whose entropy is nearest.
        temperature: f64,
        /// `S(θ) − s` there.
        residual: f64,
        /// How many times the entropy was evaluated.
        evaluations: usize,
    },
}

//! What is known of a symbol: from where on its values are.

use crate::node::Symbol;
use crate::number::Rational;

/// The values of a symbol are above a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LowerBound {
    /// The symbol.
    pub symbol: Symbol,
    /// No value is below.
    pub bound: Rational,
    /// It is a value itself.
    pub reached: bool,
}

impl LowerBound {
    /// A length, or an absolute temperature.
    #[must_use]
    pub fn positive(symbol: Symbol) -> Self {
        Self::above(symbol, Rational::ZERO)
    }

    /// Any value above `bound`.
    #[must_use]
    pub fn above(symbol: Symbol, bound: Rational) -> Self {
        Self {
            symbol,
            bound,
            reached: false,
        }
    }

    /// `bound`, and any value above it.
    #[must_use]
    pub fn from(symbol: Symbol, bound: Rational) -> Self {
        Self {
            symbol,
            bound,
            reached: true,
        }
    }
}

//! A lower bound of the values of a symbol.

use crate::node::Symbol;
use crate::number::Rational;

/// A lower bound of the values of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LowerBound {
    /// The symbol.
    pub symbol: Symbol,
    /// No value is below this number.
    pub bound: Rational,
    /// Whether `bound` is itself a possible value.
    pub reached: bool,
}

impl LowerBound {
    /// Any value above 0, as of a length or an absolute temperature.
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

//! Numbers of expressions: exact as long as they fit, so that `1 − 1` and `3·⅓` are decided and not rounded.

mod conversion;
mod rational;

use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::{Add, Div, Mul, Neg, Sub};

pub use rational::Rational;

/// A constant: an exact rational, or a float where the rational does not fit.
///
/// Arithmetic is total. An operation whose exact result does not fit into 128-bit numerator and
/// denominator, or which involves a float, is carried out in `f64`.
///
/// ```
/// use eem_symbolic::{Number, Rational};
///
/// let tenth = Number::parse_decimal("0.1").unwrap();
/// assert_eq!(tenth + tenth + tenth, Number::parse_decimal("0.3").unwrap());
/// assert_eq!(tenth.to_f64(), 0.1);
/// ```
#[derive(Clone, Copy, Debug)]
pub enum Number {
    /// An exact rational.
    Exact(Rational),
    /// A value that is not kept as a rational.
    Float(f64),
}

impl Number {
    /// 0.
    pub const ZERO: Number = Number::Exact(Rational::ZERO);
    /// 1.
    pub const ONE: Number = Number::Exact(Rational::ONE);
    /// −1.
    pub const MINUS_ONE: Number = Number::Exact(Rational::MINUS_ONE);
    /// ½.
    pub const HALF: Number = Number::Exact(Rational::HALF);

    /// Reads a decimal literal such as `1.5e-3`: exact if it fits, otherwise the nearest float.
    ///
    /// `None` if the text is not a decimal literal.
    #[must_use]
    pub fn parse_decimal(text: &str) -> Option<Number> {
        match Rational::parse_decimal(text) {
            Some(exact) => Some(Number::Exact(exact)),
            None if text.starts_with(|c: char| c.is_ascii_digit() || ".-+".contains(c)) => text
                .parse::<f64>()
                .ok()
                .filter(|value| value.is_finite())
                .map(Number::from),
            None => None,
        }
    }

    /// The nearest `f64`.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        match self {
            Number::Exact(exact) => exact.to_f64(),
            Number::Float(value) => value,
        }
    }

    /// The rational, unless the number is a float.
    #[must_use]
    pub fn exact(self) -> Option<Rational> {
        match self {
            Number::Exact(exact) => Some(exact),
            Number::Float(_) => None,
        }
    }

    /// Whether the number is 0.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self == Number::ZERO
    }

    /// Whether the number is below 0.
    #[must_use]
    pub fn is_negative(self) -> bool {
        match self {
            Number::Exact(exact) => exact.is_negative(),
            Number::Float(value) => value < 0.0,
        }
    }

    /// `|x|`.
    #[must_use]
    pub fn abs(self) -> Number {
        if self.is_negative() { -self } else { self }
    }

    /// `xⁿ`.
    #[must_use]
    pub fn powi(self, exponent: i32) -> Number {
        match self {
            Number::Exact(exact) => exact.checked_powi(exponent).map_or_else(
                || Number::from(exact.to_f64().powi(exponent)),
                Number::Exact,
            ),
            Number::Float(value) => Number::from(value.powi(exponent)),
        }
    }

    /// `self · other`, unless it leaves the range of floats while both numbers are within.
    pub(crate) fn product_in_range(self, other: Number) -> Option<Number> {
        let product = self * other;
        let vanishes = product.is_zero() && !self.is_zero() && !other.is_zero();
        let finite = |number: Number| number.to_f64().is_finite();
        let overflows = !finite(product) && finite(self) && finite(other);
        (!vanishes && !overflows).then_some(product)
    }

    /// The exact result if both numbers are exact and it fits, otherwise that of `f64`.
    fn combine(
        self,
        other: Number,
        exact: impl FnOnce(Rational, Rational) -> Option<Rational>,
        float: impl FnOnce(f64, f64) -> f64,
    ) -> Number {
        self.exact()
            .zip(other.exact())
            .and_then(|(a, b)| exact(a, b))
            .map_or_else(
                || Number::from(float(self.to_f64(), other.to_f64())),
                Number::Exact,
            )
    }
}

impl From<Rational> for Number {
    fn from(value: Rational) -> Self {
        Number::Exact(value)
    }
}

impl From<i64> for Number {
    fn from(value: i64) -> Self {
        Number::Exact(Rational::integer(value))
    }
}

impl From<f64> for Number {
    /// Integers up to 2⁵³ become exact, so that 0 and 1 have one representation.
    fn from(value: f64) -> Self {
        const EXACT_INTEGERS: f64 = 9_007_199_254_740_992.0; // 2⁵³
        if value.abs() <= EXACT_INTEGERS && value.fract() == 0.0 {
            #[allow(clippy::cast_possible_truncation)] // An integer of at most 2⁵³.
            return Number::from(value as i64);
        }
        Number::Float(value)
    }
}

impl Add for Number {
    type Output = Number;
    fn add(self, other: Number) -> Number {
        self.combine(other, Rational::checked_add, |a, b| a + b)
    }
}

impl Sub for Number {
    type Output = Number;
    fn sub(self, other: Number) -> Number {
        self.combine(other, Rational::checked_sub, |a, b| a - b)
    }
}

impl Mul for Number {
    type Output = Number;
    fn mul(self, other: Number) -> Number {
        self.combine(other, Rational::checked_mul, |a, b| a * b)
    }
}

impl Div for Number {
    type Output = Number;
    fn div(self, other: Number) -> Number {
        self.combine(other, Rational::checked_div, |a, b| a / b)
    }
}

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        match self {
            Number::Exact(exact) => Number::Exact(-exact),
            Number::Float(value) => Number::Float(-value),
        }
    }
}

impl PartialEq for Number {
    /// Floats are compared by their bits: `NaN` equals itself, and equality is an equivalence.
    fn eq(&self, other: &Number) -> bool {
        match (self, other) {
            (Number::Exact(a), Number::Exact(b)) => a == b,
            (Number::Float(a), Number::Float(b)) => a.to_bits() == b.to_bits(),
            (Number::Exact(_), Number::Float(_)) | (Number::Float(_), Number::Exact(_)) => false,
        }
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match self {
            Number::Exact(exact) => exact.hash(state),
            Number::Float(value) => value.to_bits().hash(state),
        }
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Number::Exact(exact) => write!(f, "{exact}"),
            Number::Float(value) => write!(f, "{value:?}"),
        }
    }
}

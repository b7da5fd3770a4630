//! Rationals from text, exactly, to text, and to the nearest float.

use std::fmt;

use super::Rational;

impl Rational {
    /// Reads a decimal literal: digits with an optional sign, point and exponent (`1.5e-3`).
    ///
    /// `None` if the text is something else or if the value does not fit.
    #[must_use]
    pub fn parse_decimal(text: &str) -> Option<Rational> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (negative, digits) = match mantissa.strip_prefix('-') {
            Some(digits) => (true, digits),
            None => (false, mantissa),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        if whole.is_empty() && fraction.is_empty() {
            return None;
        }
        let mut value: i128 = 0;
        for digit in whole.chars().chain(fraction.trim_end_matches('0').chars()) {
            value = value
                .checked_mul(10)?
                .checked_add(i128::from(digit.to_digit(10)?))?;
        }
        let places = i32::try_from(fraction.trim_end_matches('0').len()).ok()?;
        let scale = Rational::integer(10).checked_powi(exponent.checked_sub(places)?)?;
        let value = Rational::new(value, 1)?.checked_mul(scale)?;
        Some(if negative { -value } else { value })
    }

    /// The nearest `f64`, ties to even.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        // Long division until the quotient has 65 bits; the last one is set if a remainder is left
        // (a sticky bit). The conversion of that integer rounds as the exact quotient would.
        let (dividend, divisor) = (
            self.numerator().unsigned_abs(),
            self.denominator().unsigned_abs(),
        );
        if dividend == 0 {
            return 0.0;
        }
        let (mut quotient, mut remainder) = (dividend / divisor, dividend % divisor);
        let mut shift = 0;
        while quotient >> 64 == 0 {
            remainder <<= 1;
            quotient = quotient << 1 | u128::from(remainder >= divisor);
            remainder %= divisor;
            shift += 1;
        }
        quotient |= u128::from(remainder != 0);
        #[allow(clippy::cast_precision_loss)] // Rounded to nearest, as explained above.
        let magnitude = quotient as f64 * 2.0_f64.powi(-shift);
        if self.is_negative() {
            -magnitude
        } else {
            magnitude
        }
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_integer() {
            write!(f, "{}", self.numerator())
        } else {
            write!(f, "{}/{}", self.numerator(), self.denominator())
        }
    }
}

//! Exact rationals in 128-bit integers: every operation is exact or says that it does not fit.

use std::cmp::Ordering;
use std::fmt;
use std::ops::Neg;

/// A rational number in lowest terms with a positive denominator.
///
/// ```
/// use eem_symbolic::Rational;
///
/// let x = Rational::parse_decimal("1.5e-3").unwrap();
/// assert_eq!(x, Rational::new(3, 2000).unwrap());
/// assert_eq!(x.to_f64(), 1.5e-3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rational {
    numerator: i128,
    denominator: i128,
}

impl Rational {
    /// 0.
    pub const ZERO: Rational = Rational::whole(0);
    /// 1.
    pub const ONE: Rational = Rational::whole(1);
    /// −1.
    pub const MINUS_ONE: Rational = Rational::whole(-1);
    /// 2.
    pub const TWO: Rational = Rational::whole(2);
    /// ½.
    pub const HALF: Rational = Rational {
        numerator: 1,
        denominator: 2,
    };

    /// `numerator/denominator` in lowest terms.
    ///
    /// `None` if the denominator is 0, or if one of the two is −2¹²⁷, which has no negative.
    #[must_use]
    pub fn new(numerator: i128, denominator: i128) -> Option<Rational> {
        if denominator == 0 || numerator == i128::MIN || denominator == i128::MIN {
            return None;
        }
        let divisor = greatest_common_divisor(numerator, denominator) * denominator.signum();
        Some(Rational {
            numerator: numerator / divisor,
            denominator: denominator / divisor,
        })
    }

    /// The integer `value`.
    #[must_use]
    pub const fn integer(value: i64) -> Rational {
        Rational::whole(value as i128)
    }

    const fn whole(numerator: i128) -> Rational {
        Rational {
            numerator,
            denominator: 1,
        }
    }

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

    /// Numerator; carries the sign.
    #[must_use]
    pub fn numerator(self) -> i128 {
        self.numerator
    }

    /// Denominator, positive.
    #[must_use]
    pub fn denominator(self) -> i128 {
        self.denominator
    }

    /// Whether the number is 0.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// Whether the number is below 0.
    #[must_use]
    pub fn is_negative(self) -> bool {
        self.numerator < 0
    }

    /// Whether the number is an integer.
    #[must_use]
    pub fn is_integer(self) -> bool {
        self.denominator == 1
    }

    /// The number as an `i32`, if it is one.
    #[must_use]
    pub fn to_i32(self) -> Option<i32> {
        if self.is_integer() {
            i32::try_from(self.numerator).ok()
        } else {
            None
        }
    }

    /// The nearest `f64`, ties to even.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        // Long division until the quotient has 65 bits, then one bit for the rest of them: the
        // conversion of that integer rounds as the exact quotient would.
        let (dividend, divisor) = (
            self.numerator.unsigned_abs(),
            self.denominator.unsigned_abs(),
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

    /// `self + other` if it fits.
    #[must_use]
    pub fn checked_add(self, other: Rational) -> Option<Rational> {
        let divisor = greatest_common_divisor(self.denominator, other.denominator);
        let (left, right) = (other.denominator / divisor, self.denominator / divisor);
        let numerator = self
            .numerator
            .checked_mul(left)?
            .checked_add(other.numerator.checked_mul(right)?)?;
        Rational::new(numerator, self.denominator.checked_mul(left)?)
    }

    /// `self − other` if it fits.
    #[must_use]
    pub fn checked_sub(self, other: Rational) -> Option<Rational> {
        self.checked_add(-other)
    }

    /// `self · other` if it fits.
    #[must_use]
    pub fn checked_mul(self, other: Rational) -> Option<Rational> {
        let left = greatest_common_divisor(self.numerator, other.denominator);
        let right = greatest_common_divisor(other.numerator, self.denominator);
        let numerator = (self.numerator / left).checked_mul(other.numerator / right)?;
        Rational::new(
            numerator,
            (self.denominator / right).checked_mul(other.denominator / left)?,
        )
    }

    /// `self / other` if it fits and `other` is not 0.
    #[must_use]
    pub fn checked_div(self, other: Rational) -> Option<Rational> {
        self.checked_mul(Rational::new(other.denominator, other.numerator)?)
    }

    /// `selfⁿ` if it fits; `None` for a negative power of 0.
    #[must_use]
    pub fn checked_powi(self, exponent: i32) -> Option<Rational> {
        let base = if exponent < 0 {
            Rational::ONE.checked_div(self)?
        } else {
            self
        };
        let exponent = exponent.unsigned_abs();
        // The powers of coprime numbers are coprime.
        Rational::new(
            base.numerator.checked_pow(exponent)?,
            base.denominator.checked_pow(exponent)?,
        )
    }

    /// `√self` if it is rational.
    #[must_use]
    pub fn checked_sqrt(self) -> Option<Rational> {
        Rational::new(exact_root(self.numerator)?, exact_root(self.denominator)?)
    }
}

/// The integer whose square is `value`, if there is one.
fn exact_root(value: i128) -> Option<i128> {
    let root = value.checked_isqrt()?;
    (root * root == value).then_some(root)
}

/// Euclid's algorithm; at least 1.
fn greatest_common_divisor(a: i128, b: i128) -> i128 {
    let (mut a, mut b) = (a, b);
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.abs().max(1)
}

impl Neg for Rational {
    type Output = Rational;
    fn neg(self) -> Rational {
        // Numerators are never −2¹²⁷.
        Rational {
            numerator: -self.numerator,
            ..self
        }
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Rational) -> Ordering {
        // Integer parts first, then the reciprocals of the remainders, as in a continued fraction.
        let (mut a, mut b) = (*self, *other);
        loop {
            let whole = a.numerator.div_euclid(a.denominator);
            let order = whole.cmp(&b.numerator.div_euclid(b.denominator));
            let rests = (
                a.numerator.rem_euclid(a.denominator),
                b.numerator.rem_euclid(b.denominator),
            );
            if order != Ordering::Equal || rests.0 == 0 || rests.1 == 0 {
                return order.then(rests.0.signum().cmp(&rests.1.signum()));
            }
            (a, b) = (
                Rational {
                    numerator: b.denominator,
                    denominator: rests.1,
                },
                Rational {
                    numerator: a.denominator,
                    denominator: rests.0,
                },
            );
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Rational) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_integer() {
            write!(f, "{}", self.numerator)
        } else {
            write!(f, "{}/{}", self.numerator, self.denominator)
        }
    }
}

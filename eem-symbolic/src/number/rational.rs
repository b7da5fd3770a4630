//! Exact rationals in 128-bit integers: every operation is exact or says that it does not fit.

use std::cmp::Ordering;
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

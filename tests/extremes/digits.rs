//! Numbers of 32 digits, each the unevaluated sum of two doubles: what the judge computes with.
//!
//! Products and sums are those of Dekker (1971) and Knuth (1969); elementary functions have a relative
//! error of a few 1e-31, which the tests compare with 100 digits.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// `high + low` with `|low| ≤ ½ ulp(high)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Digits {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

/// ln 2 to 32 digits.
const LN_2: Digits = Digits {
    high: core::f64::consts::LN_2,
    low: 2.319_046_813_846_299_6e-17,
};

/// Halvings of the argument of the exponential, undone by as many squarings.
const HALVINGS: i32 = 9;

/// Terms of the series of `exp_m1` at an argument below `½ ln 2 / 2^HALVINGS`: the first one left out
/// is `(7e-4)¹⁰/10!`, 1e-38 of the first.
const TERMS: u32 = 9;

/// An exact sum.
fn two_sum(a: f64, b: f64) -> Digits {
    let high = a + b;
    let part = high - a;
    let low = (a - (high - part)) + (b - part);
    // The error of a sum that is not finite has no meaning.
    let low = if high.is_finite() { low } else { 0.0 };
    Digits { high, low }
}

/// An exact sum of numbers of which the first is the larger one.
fn quick_two_sum(a: f64, b: f64) -> Digits {
    let high = a + b;
    let low = if high.is_finite() {
        b - (high - a)
    } else {
        0.0
    };
    Digits { high, low }
}

/// An exact product, unless it underflows.
fn two_product(a: f64, b: f64) -> Digits {
    let high = a * b;
    let low = if high.is_finite() {
        a.mul_add(b, -high)
    } else {
        0.0
    };
    Digits { high, low }
}

impl Digits {
    pub(crate) const ZERO: Self = Self {
        high: 0.0,
        low: 0.0,
    };
    pub(crate) const ONE: Self = Self {
        high: 1.0,
        low: 0.0,
    };

    /// A value and what is still missing of it.
    pub(crate) fn pair([value, carry]: [f64; 2]) -> Self {
        two_sum(value, carry)
    }

    /// The nearest double.
    pub(crate) fn value(self) -> f64 {
        self.high
    }

    pub(crate) fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// `2ⁿ self`, exactly but for underflow.
    fn scaled(self, n: i32) -> Self {
        // Two factors, as 2ⁿ alone may not be a double.
        let factors = [2.0_f64.powi(n / 2), 2.0_f64.powi(n - n / 2)];
        let scale = |x: f64| x * factors[0] * factors[1];
        Self {
            high: scale(self.high),
            low: scale(self.low),
        }
    }

    pub(crate) fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self {
                high: self.high.sqrt(),
                low: 0.0,
            };
        }
        // Newton's step for 1/√x, written for √x (Karp & Markstein 1997).
        let root = self.high.sqrt();
        let rest = self - two_product(root, root);
        quick_two_sum(root, rest.high / (root + root))
    }

    /// `√Σ xᵢ²` where squares may overflow or vanish.
    pub(crate) fn norm(x: &[Self]) -> Self {
        let largest = x.iter().fold(0.0_f64, |most, x| most.max(x.high.abs()));
        if !(largest > 0.0 && largest.is_finite()) {
            return Self {
                high: largest,
                low: 0.0,
            };
        }
        let n = exponent(largest);
        let square = |x: &Self| x.scaled(-n) * x.scaled(-n);
        let sum = x
            .iter()
            .map(square)
            .fold(Self::ZERO, |sum, term| sum + term);
        sum.sqrt().scaled(n)
    }

    pub(crate) fn powi(self, n: i32) -> Self {
        let (mut power, mut square, mut rest) = (Self::ONE, self, n.unsigned_abs());
        while rest > 0 {
            if rest % 2 == 1 {
                power = power * square;
            }
            square = square * square;
            rest /= 2;
        }
        if n < 0 { Self::ONE / power } else { power }
    }

    /// `e^r − 1` for `|r| ≤ ½ ln 2`.
    fn exp_m1_of_small(self) -> Self {
        let r = self.scaled(-HALVINGS);
        let (mut term, mut sum) = (r, r);
        for n in 2..=TERMS {
            term = term * r / f64::from(n);
            sum = sum + term;
        }
        // (1 + a)² − 1 = 2a + a².
        (0..HALVINGS).fold(sum, |a, _| a.scaled(1) + a * a)
    }

    pub(crate) fn exp(self) -> Self {
        if self.high.is_nan() || self.high.abs() >= 700.0 {
            return Self {
                high: self.high.exp(),
                low: 0.0,
            };
        }
        let n = (self.high / LN_2.high).round();
        let rest = self - LN_2 * n;
        #[expect(clippy::cast_possible_truncation, reason = "below 1010")]
        (Self::ONE + rest.exp_m1_of_small()).scaled(n as i32)
    }

    pub(crate) fn exp_m1(self) -> Self {
        if self.high.abs() <= 0.5 * LN_2.high {
            return self.exp_m1_of_small();
        }
        self.exp() - Self::ONE
    }

    pub(crate) fn ln(self) -> Self {
        if !(self.high > 0.0 && self.high.is_finite()) {
            return Self {
                high: self.high.ln(),
                low: 0.0,
            };
        }
        let n = exponent(self.high);
        let x = self.scaled(-n);
        // Newton's step of third order from the double: y + 2 (x − e^y)/(x + e^y).
        let y = Self {
            high: x.high.ln(),
            low: 0.0,
        };
        let power = y.exp();
        let refined = y + (x - power) * 2.0 / (x + power);
        LN_2 * f64::from(n) + refined
    }
}

/// The power of two near `x`, so that `x/2ⁿ` lies between 0.7 and 1.5: its logarithm is small.
fn exponent(x: f64) -> i32 {
    #[expect(clippy::cast_possible_truncation, reason = "an exponent of a double")]
    let n = x.log2().round() as i32;
    n
}

impl Neg for Digits {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Add for Digits {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let sum = quick_two_sum(high.high, high.low + low.high);
        quick_two_sum(sum.high, sum.low + low.low)
    }
}

impl Sub for Digits {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Digits {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = two_product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        quick_two_sum(product.high, product.low + cross)
    }
}

impl Div for Digits {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        if !first.is_finite() {
            return Self {
                high: first,
                low: 0.0,
            };
        }
        let rest = self - other * first;
        let second = rest.high / other.high;
        let rest = rest - other * second;
        quick_two_sum(first, second) + Self::from(rest.high / other.high)
    }
}

impl From<f64> for Digits {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Mul<f64> for Digits {
    type Output = Self;

    fn mul(self, other: f64) -> Self {
        self * Self::from(other)
    }
}

impl Div<f64> for Digits {
    type Output = Self;

    fn div(self, other: f64) -> Self {
        self / Self::from(other)
    }
}

impl core::iter::Sum for Digits {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, |sum, term| sum + term)
    }
}

#[cfg(test)]
mod tests {
    use super::Digits;
    use eem_symbolic::{Arithmetic as _, Function};
    use eem_testkit::precise::{BigFloat, Precise, to_f64};

    /// What a function of 32 digits may be off by, relative to itself.
    const ERROR: f64 = 2e-30;

    fn exactly(p: &Precise, x: Digits) -> BigFloat {
        p.add(&p.from_f64(x.high), &p.from_f64(x.low))
    }

    /// `|computed/exact − 1|`.
    fn error(p: &Precise, computed: Digits, exact: &BigFloat) -> f64 {
        let ratio = p.div(&exactly(p, computed), exact);
        to_f64(&p.sub(&ratio, &p.from_f64(1.0))).abs()
    }

    #[test]
    fn elementary_functions_have_thirty_digits() {
        let p = &Precise::new();
        for x in [1e-3, 0.3, 0.7, 0.999_999, 1.000_001, 1.4, 3.0, 77.7, 690.0] {
            let x = Digits::pair([x, x * 1e-17]);
            let exact = exactly(p, x);
            let exp = p.apply(Function::Exp, &exact);
            assert!(error(p, x.exp(), &exp) < ERROR, "exp {x:?}");
            let exp_m1 = p.apply(Function::ExpM1, &exact);
            assert!(error(p, x.exp_m1(), &exp_m1) < ERROR, "exp_m1 {x:?}");
            let ln = p.apply(Function::Ln, &exact);
            // The logarithm is absolutely as good as its argument is relatively.
            let scale = (x.high.ln().abs()).min(1.0);
            assert!(error(p, x.ln(), &ln) * scale < ERROR, "ln {x:?}");
            let sqrt = p.sqrt(&exact);
            assert!(error(p, x.sqrt(), &sqrt) < ERROR, "sqrt {x:?}");
            let seventh = p.powi(&exact, 7);
            assert!(error(p, x.powi(7), &seventh) < 8.0 * ERROR, "powi {x:?}");
        }
    }

    #[test]
    fn a_norm_of_tiny_and_of_huge_numbers_is_that_of_ordinary_ones() {
        for scale in [1e-200, 1.0, 1e200] {
            let sides = [3.0, 4.0].map(|x| Digits::from(x * scale));
            assert!((Digits::norm(&sides).value() / (5.0 * scale) - 1.0).abs() < 1e-15);
        }
    }
}

//! Numbers of 32 digits that carry their derivative by the temperature, so that a free energy gives its
//! entropy `s = −∂ψ/∂θ`.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::digits::Digits;

/// A value and its derivative by θ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jet {
    pub(crate) value: Digits,
    pub(crate) slope: Digits,
}

impl Jet {
    /// A number that does not depend on θ.
    pub(crate) fn constant(value: Digits) -> Self {
        Self {
            value,
            slope: Digits::ZERO,
        }
    }

    /// θ itself.
    pub(crate) fn temperature(value: f64) -> Self {
        Self {
            value: Digits::from(value),
            slope: Digits::ONE,
        }
    }

    fn through(self, value: Digits, derivative: Digits) -> Self {
        Self {
            value,
            slope: derivative * self.slope,
        }
    }

    pub(crate) fn powi(self, n: i32) -> Self {
        self.through(self.value.powi(n), self.value.powi(n - 1) * f64::from(n))
    }

    pub(crate) fn powf(self, exponent: impl Into<Self>) -> Self {
        exp(ln(self) * exponent)
    }
}

/// The functions of the formula language that the models use.
pub(crate) fn ln(x: Jet) -> Jet {
    x.through(x.value.ln(), Digits::ONE / x.value)
}

pub(crate) fn exp(x: Jet) -> Jet {
    x.through(x.value.exp(), x.value.exp())
}

pub(crate) fn exp_m1(x: Jet) -> Jet {
    x.through(x.value.exp_m1(), x.value.exp())
}

pub(crate) fn ln_1p(x: Jet) -> Jet {
    ln(x + 1.0)
}

pub(crate) fn log10(x: Jet) -> Jet {
    ln(x) / Jet::constant(Digits::from(10.0).ln())
}

pub(crate) fn sinh(x: Jet) -> Jet {
    let grown = x.value.exp_m1();
    let [up, down] = [grown, grown / (grown + Digits::ONE)];
    x.through((up + down) * 0.5, (up - down) * 0.5 + Digits::ONE)
}

pub(crate) fn tanh(x: Jet) -> Jet {
    // With e^−2|x|, which neither overflows nor cancels.
    let double = -(x.value.abs() * 2.0);
    let rest = Digits::ONE + double.exp();
    let size = -double.exp_m1() / rest;
    let value = if x.value.value() < 0.0 { -size } else { size };
    x.through(value, double.exp() * 4.0 / (rest * rest))
}

impl From<f64> for Jet {
    fn from(value: f64) -> Self {
        Self::constant(Digits::from(value))
    }
}

impl Neg for Jet {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            value: -self.value,
            slope: -self.slope,
        }
    }
}

impl<T: Into<Self>> Add<T> for Jet {
    type Output = Self;

    fn add(self, other: T) -> Self {
        let other = other.into();
        Self {
            value: self.value + other.value,
            slope: self.slope + other.slope,
        }
    }
}

impl<T: Into<Self>> Sub<T> for Jet {
    type Output = Self;

    fn sub(self, other: T) -> Self {
        self + -other.into()
    }
}

impl<T: Into<Self>> Mul<T> for Jet {
    type Output = Self;

    fn mul(self, other: T) -> Self {
        let other = other.into();
        let slope = self.slope * other.value + self.value * other.slope;
        Self {
            value: self.value * other.value,
            slope,
        }
    }
}

impl<T: Into<Self>> Div<T> for Jet {
    type Output = Self;

    fn div(self, other: T) -> Self {
        let other = other.into();
        let value = self.value / other.value;
        Self {
            value,
            slope: (self.slope - value * other.slope) / other.value,
        }
    }
}

macro_rules! from_the_left {
    ($($operator:ident $method:ident),*) => {$(
        impl $operator<Jet> for f64 {
            type Output = Jet;

            fn $method(self, other: Jet) -> Jet {
                Jet::from(self).$method(other)
            }
        }
    )*};
}

from_the_left! { Add add, Sub sub, Mul mul, Div div }

#[cfg(test)]
mod tests {
    use super::*;

    /// Functions whose derivatives another formula gives.
    #[test]
    fn hyperbolic_functions_and_logarithms_have_values_and_slopes() {
        for x in [-30.0, -1.3, -1e-9, 0.0, 1e-3, 0.7, 4.0, 20.0] {
            let jet = Jet::temperature(x);
            let near = |digits: Digits, exact: f64| {
                let off = (digits.value() - exact).abs();
                assert!(
                    off <= 4.0 * f64::EPSILON * exact.abs(),
                    "{x}: {digits:?} {exact}"
                );
            };
            near(sinh(jet).value, x.sinh());
            near(sinh(jet).slope, x.cosh());
            near(tanh(jet).value, x.tanh());
            near(tanh(jet).slope, x.cosh().powi(-2));
            let positive = Jet::temperature(x.abs() + 0.1);
            let own = positive.value.value();
            near(
                log10(positive).slope,
                (own * core::f64::consts::LN_10).recip(),
            );
            near(ln_1p(positive).value, own.ln_1p());
            near(positive.powf(2.5).slope, 2.5 * own.powf(1.5));
        }
    }
}

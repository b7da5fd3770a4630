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

    pub(crate) fn powf(self, exponent: f64) -> Self {
        let power = (self.value.ln() * exponent).exp();
        self.through(power, power / self.value * exponent)
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

//! `f64` as a number.

use super::Scalar;

/// Forwards to functions of one name or another.
macro_rules! forward {
    ($($method:ident($($argument:ident)?) = $function:path),* $(,)?) => {
        $(
            #[inline]
            fn $method(self $(, $argument: Self)?) -> Self {
                $function(self $(, $argument)?)
            }
        )*
    };
}

impl Scalar for f64 {
    #[inline]
    fn from_f64(value: f64) -> Self {
        value
    }

    #[inline]
    fn minimum(self, other: Self) -> Self {
        if self < other || self.is_nan() {
            self
        } else {
            other
        }
    }

    #[inline]
    fn maximum(self, other: Self) -> Self {
        if self > other || self.is_nan() {
            self
        } else {
            other
        }
    }

    forward!(abs() = Self::abs, sqrt() = Self::sqrt);

    // Those of the platform's library, which differ between platforms in their last bits.
    #[cfg(not(feature = "portable"))]
    forward!(
        cbrt() = Self::cbrt,
        exp() = Self::exp,
        exp_m1() = Self::exp_m1,
        ln() = Self::ln,
        ln_1p() = Self::ln_1p,
        log2() = Self::log2,
        log10() = Self::log10,
        sin() = Self::sin,
        cos() = Self::cos,
        tan() = Self::tan,
        sinh() = Self::sinh,
        cosh() = Self::cosh,
        tanh() = Self::tanh,
        asinh() = Self::asinh,
        atan() = Self::atan,
        atanh() = Self::atanh,
        atan2(x) = Self::atan2,
        hypot(other) = Self::hypot,
        powf(exponent) = Self::powf,
    );

    // Those of `libm`, which have the same bits on every platform.
    #[cfg(feature = "portable")]
    forward!(
        cbrt() = libm::cbrt,
        exp() = libm::exp,
        exp_m1() = libm::expm1,
        ln() = libm::log,
        ln_1p() = libm::log1p,
        log2() = libm::log2,
        log10() = libm::log10,
        sin() = libm::sin,
        cos() = libm::cos,
        tan() = libm::tan,
        sinh() = libm::sinh,
        cosh() = libm::cosh,
        tanh() = libm::tanh,
        asinh() = libm::asinh,
        atan() = libm::atan,
        atanh() = libm::atanh,
        atan2(x) = libm::atan2,
        hypot(other) = libm::hypot,
        powf(exponent) = libm::pow,
    );
}

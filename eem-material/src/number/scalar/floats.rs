//! `f64` and `f32` as numbers.

use super::{Real, Scalar};

/// Forwards to inherent methods of the same name.
macro_rules! forward {
    ($float:tt: $($method:ident($($argument:ident),*)),* $(,)?) => {
        $(
            #[inline]
            fn $method(self $(, $argument: Self)*) -> Self {
                $float::$method(self $(, $argument)*)
            }
        )*
    };
}

/// Elementary functions: those of the platform's library, which differ between platforms in their last bits.
#[cfg(not(feature = "portable"))]
macro_rules! elementary {
    ($float:tt) => {
        forward!($float:
            cbrt(), exp(), exp_m1(), ln(), ln_1p(), log2(), log10(),
            sin(), cos(), tan(), sinh(), cosh(), tanh(), asinh(), atan(), atanh(),
            atan2(x), hypot(other), powf(exponent),
        );
    };
}

/// Elementary functions: those of `libm`, which have the same bits on every platform.
#[cfg(feature = "portable")]
macro_rules! elementary {
    (f64) => {
        elementary!(f64:
            cbrt() cbrt, exp() exp, exp_m1() expm1, ln() log, ln_1p() log1p, log2() log2, log10() log10,
            sin() sin, cos() cos, tan() tan, sinh() sinh, cosh() cosh, tanh() tanh,
            asinh() asinh, atan() atan, atanh() atanh,
            atan2(x) atan2, hypot(other) hypot, powf(exponent) pow,
        );
    };
    (f32) => {
        elementary!(f32:
            cbrt() cbrtf, exp() expf, exp_m1() expm1f, ln() logf, ln_1p() log1pf, log2() log2f, log10() log10f,
            sin() sinf, cos() cosf, tan() tanf, sinh() sinhf, cosh() coshf, tanh() tanhf,
            asinh() asinhf, atan() atanf, atanh() atanhf,
            atan2(x) atan2f, hypot(other) hypotf, powf(exponent) powf,
        );
    };
    ($float:tt: $($method:ident($($argument:ident)?) $function:ident),* $(,)?) => {
        $(
            #[inline]
            fn $method(self $(, $argument: Self)?) -> Self {
                libm::$function(self $(, $argument)?)
            }
        )*
    };
}

/// Implements both traits for a floating-point type.
macro_rules! implement {
    ($float:tt, $from_f64:expr) => {
        impl Scalar for $float {
            type Mask = bool;

            #[inline]
            fn from_f64(value: f64) -> Self {
                $from_f64(value)
            }

            #[inline]
            #[expect(clippy::float_cmp, reason = "this is the comparison itself")]
            fn equal(self, other: Self) -> bool {
                self == other
            }

            #[inline]
            fn less(self, other: Self) -> bool {
                self < other
            }

            #[inline]
            fn branch(
                mask: bool,
                then: impl FnOnce() -> Self,
                otherwise: impl FnOnce() -> Self,
            ) -> Self {
                if mask { then() } else { otherwise() }
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

            forward!($float: abs(), sqrt());
            elementary!($float);
        }

        impl Real for $float {
            const IS_DOUBLE: bool = size_of::<Self>() == size_of::<f64>();
            const EPSILON: Self = $float::EPSILON;
            const MAX: Self = $float::MAX;
            const MIN_POSITIVE: Self = $float::MIN_POSITIVE;

            #[inline]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }

            #[inline]
            fn is_finite(self) -> bool {
                // A comparison of numbers, where `f64::is_finite` looks at bits.
                $float::abs(self) <= $float::MAX
            }

            #[inline]
            fn at_most(self, other: Self) -> bool {
                self <= other
            }
        }
    };
}

implement!(f64, core::convert::identity);
implement!(f32, nearest_f32);

/// The single-precision number nearest to `value`.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to the nearest is what is wanted"
)]
fn nearest_f32(value: f64) -> f32 {
    value as f32
}

//! `f64` and `f32` as numbers.

use super::number::Scalar;
use super::real::Real;

/// Forwards to inherent methods of the same name.
macro_rules! forward {
    ($float:ident: $($method:ident($($argument:ident),*)),* $(,)?) => {
        $(
            #[inline]
            fn $method(self $(, $argument: Self)*) -> Self {
                $float::$method(self $(, $argument)*)
            }
        )*
    };
}

/// Implements both traits for a floating-point type.
macro_rules! implement {
    ($float:ident, $from_f64:expr) => {
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

            forward!($float:
                abs(), sqrt(), cbrt(), exp(), exp_m1(), ln(), ln_1p(), log2(), log10(),
                sin(), cos(), tan(), sinh(), cosh(), tanh(), asinh(), atan(), atanh(),
                atan2(x), hypot(other), powf(exponent),
            );
        }

        impl Real for $float {
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

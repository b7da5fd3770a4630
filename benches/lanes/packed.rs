//! Packed numbers as a `Scalar`: arithmetic, comparison and branches of `wide`, and elementary
//! functions either of `wide` or of the platform's library, lane by lane.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use eem::__private::Scalar;
use wide::{f64x4, f64x8};

/// Forwards operators to the packed type.
macro_rules! operators {
    ($name:ident: $($operator:ident $method:ident $assign:ident $method_assign:ident),*) => {
        $(
            impl $operator for $name {
                type Output = Self;

                #[inline]
                fn $method(self, other: Self) -> Self {
                    Self($operator::$method(self.0, other.0))
                }
            }

            impl $assign for $name {
                #[inline]
                fn $method_assign(&mut self, other: Self) {
                    *self = $operator::$method(*self, other);
                }
            }
        )*
    };
}

/// Functions of the platform's library, lane by lane.
macro_rules! by_lane {
    ($($method:ident),* $(; $($method2:ident),*)?) => {
        $(
            #[inline]
            fn $method(self) -> Self {
                Self::new(self.lanes().map(f64::$method))
            }
        )*
        $($(
            #[inline]
            fn $method2(self, other: Self) -> Self {
                let other = other.lanes();
                let mut lanes = self.lanes();
                for (lane, other) in lanes.iter_mut().zip(other) {
                    *lane = f64::$method2(*lane, other);
                }
                Self::new(lanes)
            }
        )*)?
    };
}

/// Functions of `wide`.
macro_rules! packed {
    ($($method:ident),*) => {
        $(
            #[inline]
            fn $method(self) -> Self {
                Self(self.0.$method())
            }
        )*
    };
}

/// The functions in which the two kinds of lanes differ.
macro_rules! functions {
    (wide) => {
        packed!(exp, exp_m1, ln, ln_1p);
    };
    (library) => {
        by_lane!(exp, exp_m1, ln, ln_1p);
    };
}

macro_rules! lanes {
    ($(#[$docs:meta])* $name:ident, $packed:ident, $lanes:literal, $functions:ident) => {
        $(#[$docs])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) struct $name($packed);

        impl $name {
            /// How many numbers move together.
            pub(crate) const LANES: usize = $lanes;

            /// Packs numbers.
            #[inline]
            pub(crate) fn new(lanes: [f64; $lanes]) -> Self {
                Self($packed::new(lanes))
            }

            /// The numbers.
            #[inline]
            pub(crate) fn lanes(self) -> [f64; $lanes] {
                self.0.to_array()
            }
        }

        impl Neg for $name {
            type Output = Self;

            #[inline]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        operators!($name:
            Add add AddAssign add_assign,
            Sub sub SubAssign sub_assign,
            Mul mul MulAssign mul_assign,
            Div div DivAssign div_assign
        );

        impl Scalar for $name {
            type Mask = $packed;

            #[inline]
            fn from_f64(value: f64) -> Self {
                Self($packed::splat(value))
            }

            #[inline]
            fn equal(self, other: Self) -> $packed {
                self.0.simd_eq(other.0)
            }

            #[inline]
            fn less(self, other: Self) -> $packed {
                self.0.simd_lt(other.0)
            }

            /// One closure where the lanes agree: most branches are about rare cases.
            #[inline]
            fn branch(
                mask: $packed,
                then: impl FnOnce() -> Self,
                otherwise: impl FnOnce() -> Self,
            ) -> Self {
                if mask.all() {
                    then()
                } else if mask.any() {
                    Self(mask.select(then().0, otherwise().0))
                } else {
                    otherwise()
                }
            }

            #[inline]
            fn minimum(self, other: Self) -> Self {
                let own = self.0.simd_lt(other.0) | self.0.is_nan();
                Self(own.select(self.0, other.0))
            }

            #[inline]
            fn maximum(self, other: Self) -> Self {
                let own = other.0.simd_lt(self.0) | self.0.is_nan();
                Self(own.select(self.0, other.0))
            }

            packed!(abs, sqrt);
            functions!($functions);
            by_lane!(
                cbrt, log2, log10, sin, cos, tan, sinh, cosh, tanh, asinh, atan, atanh;
                atan2, hypot, powf
            );
        }
    };
}

lanes!(
    /// Four lanes with the functions of `wide`.
    Four, f64x4, 4, wide
);
lanes!(
    /// Four lanes with the functions of the platform's library, one lane after the other.
    FourByLibrary, f64x4, 4, library
);
lanes!(
    /// Eight lanes with the functions of `wide`.
    Eight, f64x8, 8, wide
);

//! SIMD lanes: four numbers as one, for four scenes that differ in numbers only.
//!
//! Every lane has the bits that it would have alone. Arithmetic, roots and comparisons are those of the processor; elementary
//! functions are those of `f64`, lane by lane. Lanes have no order: comparisons return a mask, and a branch
//! on it must handle lanes that differ.

#[cfg(test)]
mod tests;

use core::ops::{
    Add, AddAssign, BitAnd, BitOr, Div, DivAssign, Mul, MulAssign, Neg, Not, Sub, SubAssign,
};

use wide::f64x4;

use crate::number::scalar::{MOST_LANES, Mask, Real, Scalar, Sealed};

/// Forwards operators to the packed type.
macro_rules! forward {
    ($own:ident: $($operator:ident $method:ident),*; $($unary:ident $unary_method:ident),*) => {
        $(
            impl $operator for $own {
                type Output = Self;

                #[inline]
                fn $method(self, other: Self) -> Self {
                    Self::from_packed($operator::$method(self.packed(), other.packed()))
                }
            }
        )*
        $(
            impl $unary for $own {
                type Output = Self;

                #[inline]
                fn $unary_method(self) -> Self {
                    Self::from_packed($unary::$unary_method(self.packed()))
                }
            }
        )*
    };
    ($own:ident: $($assign:ident $method:ident by $operator:ident $by:ident),*) => {
        $(
            impl $assign for $own {
                #[inline]
                fn $method(&mut self, other: Self) {
                    *self = $operator::$by(*self, other);
                }
            }
        )*
    };
}

/// The number of lanes. With the instructions that every processor has, more lanes gain nothing.
const LANES: usize = MOST_LANES;

/// Four numbers, see the module.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub struct Lanes([f64; LANES]);

impl Lanes {
    const fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline]
    fn packed(self) -> f64x4 {
        f64x4::new(self.0)
    }

    #[inline]
    fn from_packed(packed: f64x4) -> Self {
        Self(packed.to_array())
    }

    #[inline]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }

    #[inline]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (mut lanes, others) = (self.0, other.0);
        for (lane, other) in lanes.iter_mut().zip(others) {
            *lane = f(*lane, other);
        }
        Self(lanes)
    }
}

forward!(Lanes: Add add, Sub sub, Mul mul, Div div; Neg neg);
forward!(
    Lanes: AddAssign add_assign by Add add, SubAssign sub_assign by Sub sub,
    MulAssign mul_assign by Mul mul, DivAssign div_assign by Div div
);

/// Equal in all lanes. To branch where lanes may differ, use [`Scalar::equal`].
impl PartialEq for Lanes {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.equal(*other).all()
    }
}

/// Evaluates elementary functions of `f64` lane by lane.
macro_rules! by_lane {
    ($($method:ident),*; $($method2:ident),*) => {
        $(
            #[inline]
            fn $method(self) -> Self {
                self.map(<f64 as Scalar>::$method)
            }
        )*
        $(
            #[inline]
            fn $method2(self, other: Self) -> Self {
                self.zip(other, <f64 as Scalar>::$method2)
            }
        )*
    };
}

impl Scalar for Lanes {
    type Mask = LaneMask;

    #[inline]
    fn from_f64(value: f64) -> Self {
        Self::splat(value)
    }

    #[inline]
    fn equal(self, other: Self) -> LaneMask {
        LaneMask::from_packed(self.packed().simd_eq(other.packed()))
    }

    #[inline]
    fn less(self, other: Self) -> LaneMask {
        LaneMask::from_packed(self.packed().simd_lt(other.packed()))
    }

    /// Calls one closure if all lanes agree. They usually do: most branches are for rare cases.
    #[inline]
    fn branch(
        mask: LaneMask,
        then: impl FnOnce() -> Self,
        otherwise: impl FnOnce() -> Self,
    ) -> Self {
        if mask.all() {
            then()
        } else if mask.any() {
            Self::select(mask, then(), otherwise())
        } else {
            otherwise()
        }
    }

    #[inline]
    fn minimum(self, other: Self) -> Self {
        let (own, other) = (self.packed(), other.packed());
        let takes = own.simd_lt(other) | own.is_nan();
        Self::from_packed(takes.select(own, other))
    }

    #[inline]
    fn maximum(self, other: Self) -> Self {
        let (own, other) = (self.packed(), other.packed());
        let takes = other.simd_lt(own) | own.is_nan();
        Self::from_packed(takes.select(own, other))
    }

    #[inline]
    fn abs(self) -> Self {
        Self::from_packed(self.packed().abs())
    }

    #[inline]
    fn sqrt(self) -> Self {
        Self::from_packed(self.packed().sqrt())
    }

    by_lane!(
        cbrt, exp, exp_m1, ln, ln_1p, log2, log10, sin, cos, tan, sinh, cosh, tanh, asinh, atan, atanh;
        atan2, hypot, powf
    );
}

impl Sealed for Lanes {}

impl Real for Lanes {
    const EPSILON: Self = Self::splat(f64::EPSILON);
    const MAX: Self = Self::splat(f64::MAX);
    const MIN_POSITIVE: Self = Self::splat(f64::MIN_POSITIVE);
    const LANES: usize = LANES;

    fn to_f64(self) -> f64 {
        let [first, rest @ ..] = self.0.map(f64::to_bits);
        if rest == [first; LANES - 1] {
            f64::from_bits(first)
        } else {
            f64::NAN
        }
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.abs().at_most(Self::MAX).all()
    }

    #[inline]
    fn at_most(self, other: Self) -> LaneMask {
        LaneMask::from_packed(self.packed().simd_le(other.packed()))
    }

    #[inline]
    fn select(mask: LaneMask, then: Self, otherwise: Self) -> Self {
        Self::from_packed(mask.packed().select(then.packed(), otherwise.packed()))
    }

    #[inline]
    fn pack(number: impl FnMut(usize) -> f64) -> Self {
        Self(core::array::from_fn(number))
    }

    #[inline]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
}

/// One `bool` per lane: all bits of a lane are set, or none.
#[derive(Clone, Copy, Debug)]
pub struct LaneMask(f64x4);

impl LaneMask {
    #[inline]
    fn packed(self) -> f64x4 {
        self.0
    }

    #[inline]
    fn from_packed(packed: f64x4) -> Self {
        Self(packed)
    }
}

forward!(LaneMask: BitAnd bitand, BitOr bitor; Not not);

impl Mask for LaneMask {
    #[inline]
    fn none() -> Self {
        Self(f64x4::ZERO)
    }

    #[inline]
    fn all(self) -> bool {
        self.0.all()
    }

    #[inline]
    fn any(self) -> bool {
        self.0.any()
    }
}

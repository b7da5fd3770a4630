//! Four numbers in the place of one: the same scene with four sets of numbers, one per SIMD lane.
//!
//! Every lane has the bits that it would have alone. Arithmetic, roots and comparisons are those of
//! the processor; elementary functions are those of the platform's library, lane by lane. Where lanes
//! cannot go on together, [`discord`] remembers it, and what they compute is thrown away.

pub(crate) mod discord;
mod mask;
#[cfg(test)]
mod tests;

use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use wide::f64x4;

use crate::scalar::{Mask, Real, Scalar};
pub(crate) use mask::LaneMask;

/// How many numbers move together. Wider ones gain nothing with the instructions that every
/// processor has.
const LANES: usize = 4;

/// See the module.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub(crate) struct Lanes([f64; LANES]);

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

/// Forwards operators to the packed type.
macro_rules! operators {
    ($($operator:ident $method:ident $assign:ident $method_assign:ident),*) => {
        $(
            impl $operator for Lanes {
                type Output = Self;

                #[inline]
                fn $method(self, other: Self) -> Self {
                    Self::from_packed($operator::$method(self.packed(), other.packed()))
                }
            }

            impl $assign for Lanes {
                #[inline]
                fn $method_assign(&mut self, other: Self) {
                    *self = $operator::$method(*self, other);
                }
            }
        )*
    };
}

operators!(
    Add add AddAssign add_assign,
    Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign,
    Div div DivAssign div_assign
);

impl Neg for Lanes {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::from_packed(-self.packed())
    }
}

/// Equal in all lanes.
impl PartialEq for Lanes {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.equal(*other).decide()
    }
}

/// Every comparison holds if it holds in all lanes.
impl PartialOrd for Lanes {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if self < other {
            Some(Ordering::Less)
        } else if self > other {
            Some(Ordering::Greater)
        } else {
            (self == other).then_some(Ordering::Equal)
        }
    }

    #[inline]
    fn lt(&self, other: &Self) -> bool {
        self.less(*other).decide()
    }

    #[inline]
    fn le(&self, other: &Self) -> bool {
        self.at_most(*other).decide()
    }

    #[inline]
    fn gt(&self, other: &Self) -> bool {
        other.less(*self).decide()
    }

    #[inline]
    fn ge(&self, other: &Self) -> bool {
        other.at_most(*self).decide()
    }
}

/// Functions of the platform's library.
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
        LaneMask(self.packed().simd_eq(other.packed()))
    }

    #[inline]
    fn less(self, other: Self) -> LaneMask {
        LaneMask(self.packed().simd_lt(other.packed()))
    }

    /// One closure where the lanes agree: most branches are about rare cases.
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
            discord::note();
            f64::NAN
        }
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.abs() <= Self::MAX
    }

    #[inline]
    fn at_most(self, other: Self) -> LaneMask {
        LaneMask(self.packed().simd_le(other.packed()))
    }

    #[inline]
    fn select(mask: LaneMask, then: Self, otherwise: Self) -> Self {
        Self::from_packed(mask.0.select(then.packed(), otherwise.packed()))
    }

    fn give_up() {
        discord::note();
    }

    #[inline]
    fn has_given_up() -> bool {
        discord::is_noted()
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

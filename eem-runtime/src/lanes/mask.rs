//! One `bool` per lane, and the one decision of all.

use core::ops::{BitAnd, BitOr, Not};

use wide::f64x4;

use super::discord;
use crate::scalar::Mask;

/// All bits of a lane where it holds, none where it does not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LaneMask(pub(super) f64x4);

impl BitAnd for LaneMask {
    type Output = Self;

    #[inline]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for LaneMask {
    type Output = Self;

    #[inline]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Not for LaneMask {
    type Output = Self;

    #[inline]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

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

    #[inline]
    fn decide(self) -> bool {
        if self.all() {
            return true;
        }
        if self.any() {
            discord::note();
        }
        false
    }
}

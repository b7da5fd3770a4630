//! One `bool` per lane.

use core::ops::{BitAnd, BitOr, Not};

use wide::f64x4;

use super::forward::forward;
use crate::number::scalar::Mask;

/// All bits of a lane where it holds, none where it does not.
#[derive(Clone, Copy, Debug)]
pub struct LaneMask(f64x4);

impl LaneMask {
    #[inline]
    pub(super) fn packed(self) -> f64x4 {
        self.0
    }

    #[inline]
    pub(super) fn from_packed(packed: f64x4) -> Self {
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

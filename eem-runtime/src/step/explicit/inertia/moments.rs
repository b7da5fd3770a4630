//! Second moments of the masses of a body.

/// The fraction of the trace of M below which the inertia in a plane is weak: a correction of momenta there would be
/// at least a hundred times as large as in other planes, so that the body is rotated instead.
pub(in super::super) const WEAK: f64 = 1e-4;

/// The fraction below which it is rounding: 64 ε.
pub(super) const NO_INERTIA: f64 = 1.4e-14;

/// `M = Σ m r rᵀ`, kg m². Only the entries on and above the diagonal are used.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Moments<const D: usize>(pub(super) [[f64; D]; D]);

impl<const D: usize> Moments<D> {
    /// Of nothing.
    pub(in super::super) fn none() -> Self {
        Self([[0.0; D]; D])
    }

    /// Adds a mass at the end of an arm.
    #[inline]
    pub(in super::super) fn add(&mut self, mass: f64, r: &[f64; D]) {
        for i in 0..D {
            for j in i..D {
                self.0[i][j] += mass * (r[i] * r[j]);
            }
        }
    }

    #[inline]
    pub(super) fn trace(&self) -> f64 {
        (0..D).fold(0.0, |sum, axis| sum + self.0[axis][axis])
    }
}

//! Modified Newton: the factors of one tangent serve several iterations where finding them is most of the work.

use crate::algebra::lu::Singular;
use crate::algebra::system::LinearSystem;
use crate::step::newton::CONTRACTION;
use eem_material::number::scalar::Scalar;

/// Whether the factors of an earlier tangent of the same step can still be used.
///
/// They can while each update is at most a tenth of the one before, as the last one must be anyway. The error after an
/// update is then up to a tenth of it instead of its square, so that the last update must be smaller.
#[derive(Clone, Copy, Debug)]
pub(super) struct KeptFactors {
    /// Whether keeping factors pays in this scene.
    is_worthwhile: bool,
    /// The present factors can be used in the next iteration.
    are_near: bool,
    /// They were used in the last one.
    have_served: bool,
}

impl KeptFactors {
    /// Of a scene with this tangent.
    pub(super) fn new(tangent: &LinearSystem<1>) -> Self {
        Self {
            is_worthwhile: tangent.keeps_factors(),
            are_near: false,
            have_served: false,
        }
    }

    /// Solves the system of an iteration.
    #[expect(
        clippy::inline_always,
        reason = "two unknowns are solved in fewer instructions than the call takes"
    )]
    #[inline(always)]
    pub(super) fn solve(&mut self, tangent: &mut LinearSystem<1>) -> Result<(), Singular> {
        if self.is_worthwhile {
            self.solve_with_kept(tangent)
        } else {
            tangent.solve()
        }
    }

    fn solve_with_kept(&mut self, tangent: &mut LinearSystem<1>) -> Result<(), Singular> {
        self.have_served = self.are_near && tangent.solve_with_last_factors();
        if !self.have_served {
            tangent.solve()?;
        }
        self.are_near = true;
        Ok(())
    }

    /// Makes the next iteration find new factors.
    pub(super) const fn renew(&mut self) {
        self.are_near = false;
    }

    /// The bound for the last update: `tolerance` with new factors, at most ε^¾ with kept ones, of which an error of a
    /// tenth is left.
    #[inline]
    pub(super) fn tolerance(self, tolerance: f64) -> f64 {
        if self.have_served {
            Scalar::minimum(tolerance, Scalar::powf(f64::EPSILON, 0.75))
        } else {
            tolerance
        }
    }

    /// Judges the factors by an update and the one before.
    #[inline]
    pub(super) fn judge(&mut self, update: f64, before: Option<f64>) {
        let shrinks = |before: f64| update <= CONTRACTION * before;
        if self.is_worthwhile && !before.is_none_or(shrinks) {
            self.renew();
        }
    }
}

//! Where several numbers move together, those that have found their new state keep it.

use super::drag::Drag;
use super::point::Point;
use crate::element::conjugates::ElementScheme;
use crate::element::kinematics::Kinematics;
use eem_material::free_energy::FreeEnergy;
use eem_material::number::scalar::{Mask, Real};

/// What closing a step asks of an element.
#[derive(Clone, Copy)]
pub(super) struct Found<S: Real, M: FreeEnergy<S>> {
    x: M::Variables,
    creep: M::Viscosities,
    response: M::Response,
    viscosities: M::Viscosities,
    drag: Drag<M::Drag>,
}

impl<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    Point<S, M, K, C, D>
{
    /// What has been found so far, if some numbers have settled. A single one is not asked any more.
    #[inline]
    pub(super) fn found_by(&self, settled: S::Mask) -> Option<Found<S, M>> {
        if S::LANES == 1 || !settled.any() {
            return None;
        }
        Some(Found {
            x: self.x,
            creep: self.creep,
            response: self.response,
            viscosities: self.viscosities.0,
            drag: self.drag,
        })
    }

    /// Returns to what has been found where numbers have settled.
    #[inline]
    pub(super) fn return_to(&mut self, found: Option<Found<S, M>>, settled: S::Mask) {
        let Some(found) = found else {
            return;
        };
        let keep = |values: &mut [S], kept: &[S]| {
            for (value, &kept) in values.iter_mut().zip(kept) {
                *value = S::select(settled, kept, *value);
            }
        };
        keep(self.x.as_mut(), found.x.as_ref());
        keep(self.creep.as_mut(), found.creep.as_ref());
        keep(self.response.as_mut(), found.response.as_ref());
        keep(self.viscosities.0.as_mut(), found.viscosities.as_ref());
        let drag = &mut self.drag;
        keep(drag.viscosity.0.as_mut(), found.drag.viscosity.0.as_ref());
        keep(drag.extension.as_mut(), found.drag.extension.as_ref());
        keep(drag.force.as_mut(), found.drag.force.as_ref());
    }
}

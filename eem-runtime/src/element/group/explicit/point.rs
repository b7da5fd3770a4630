//! One spring in an explicit scheme.

use crate::element::group::explicit::stage::Stage;
use crate::element::handle::Element;
use crate::element::kinematics::Kinematics;
use crate::element::layout::Slots;
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::compact::compact;

/// A spring, and where its variables are.
pub(crate) struct ExplicitPoint<M: FreeEnergy<f64>, K: Kinematics<D>, const D: usize> {
    pub(super) model: M,
    pub(super) kinematics: K,
    /// Its handle.
    pub(super) element: Element,
    /// The indices of its first viscous stretch, and of its temperature, if it has one, among the internal variables of a stage.
    viscous: u32,
    temperature: u32,
    /// Its thermal slot, if it has a temperature.
    slot: u32,
    pub(super) component: u32,
    /// The indices of its nodes among the places of a stage.
    pub(super) nodes: K::PerNode<u32>,
}

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitPoint<M, K, D> {
    /// The index of the temperature among the variables.
    pub(super) const TEMPERATURE: usize = M::MEASURES + M::DASHPOTS;

    pub(crate) fn new((element, slots): (Element, Slots), model: M, kinematics: K) -> Self {
        let slot = compact(slots.thermal.unwrap_or(0));
        Self {
            model,
            kinematics,
            element,
            viscous: compact(slots.viscous),
            temperature: slot,
            slot,
            component: 0,
            nodes: K::PerNode::filled(0),
        }
    }

    /// Takes its component and its places.
    pub(super) fn join(&mut self, (component, places): (u32, &[u32]), first_temperature: usize) {
        self.component = component;
        self.temperature = self.slot + compact(first_temperature);
        self.nodes.as_mut().copy_from_slice(places);
    }

    /// Its thermal slot, if it has a temperature.
    #[inline]
    pub(super) fn slot(&self) -> Option<usize> {
        self.model.is_thermal().then_some(self.slot as usize)
    }

    /// The index of a viscous stretch among the internal variables of a stage.
    #[inline]
    pub(super) fn viscous(&self, dashpot: usize) -> usize {
        self.viscous as usize + dashpot
    }

    /// The index of its temperature there.
    #[inline]
    pub(super) fn temperature(&self) -> usize {
        self.temperature as usize
    }

    /// Its temperature at a stage; zero without one.
    #[inline]
    pub(super) fn temperature_in(&self, stage: &Stage) -> f64 {
        if self.model.is_thermal() {
            stage.inner[self.temperature()]
        } else {
            0.0
        }
    }
}

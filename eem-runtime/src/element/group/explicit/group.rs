//! The elements of one model in an explicit scheme.

use crate::element::conjugates::PointRule;
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::explicit::closed::Closed;
use crate::element::group::explicit::view::{
    ClosingView, NodeStiffness, PlaceOf, StageRates, StageView,
};
use crate::element::group::interface::{Elements, ExplicitGroup, Loose};
use crate::element::group::loose::LooseElements;
use crate::element::group::view::Placed;
use crate::element::kinematics::{Kinematics, QuadraticStrain};
use crate::element::state::State;
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

/// Elements of the model `M` with the kinematics `K`. Their forces follow from the state alone.
pub(crate) struct FreeGroup<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> {
    /// What they are in a state.
    pub(super) elements: ElementGroup<S, M, K, PointRule, D>,
    /// The component of each member.
    pub(super) components: Vec<u32>,
    /// Where its nodes are in the vectors of stages.
    pub(super) places: Vec<K::PerNode<u32>>,
    /// Per point, what was found when it was closed last.
    pub(super) closed: Vec<Closed<S, M, K, D>>,
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> FreeGroup<S, M, K, D> {
    pub(crate) fn new(elements: LooseElements<S, M, K, D>, placed: Placed<'_>) -> Self {
        let elements = ElementGroup::new(PointRule::Variational, elements, placed);
        let points = elements.points().count();
        Self {
            components: vec![0; elements.members.len()],
            places: vec![K::PerNode::filled(0); elements.members.len()],
            closed: (0..points).map(|_| Closed::none()).collect(),
            elements,
        }
    }
}

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> ExplicitGroup<S, D>
    for FreeGroup<S, M, K, D>
{
    fn elements(&self) -> &dyn Elements<S, D> {
        &self.elements
    }

    fn elements_mut(&mut self) -> &mut dyn Elements<S, D> {
        &mut self.elements
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<S, D>> {
        Box::new(self.elements.into_loose())
    }

    fn join(&mut self, component_of: &[u32], places: &dyn PlaceOf) {
        let own = self.components.iter_mut().zip(&mut self.places);
        for (member, (component, own)) in self.elements.members.iter().zip(own) {
            *component = component_of[member.only().element.index()];
            for (place, &node) in own.as_mut().iter_mut().zip(member.site.nodes.as_ref()) {
                *place = places.place_of(*component, node);
            }
        }
    }

    fn rates(
        &self,
        view: &StageView<'_, S>,
        rates: &mut StageRates<'_, S>,
    ) -> Result<(), StateError> {
        self.rates_of_all(view, rates)
    }

    fn close(&mut self, view: &mut ClosingView<'_, S>) -> Result<(), StateError> {
        self.close_all(view)
    }

    fn pull(&self, asked: &[bool], forces: &mut [S], creeping: [&mut [S]; 2]) {
        self.pull_all(asked, forces, creeping);
    }

    fn finish(
        &self,
        view: &StageView<'_, S>,
        rates: &mut StageRates<'_, S>,
    ) -> Result<(), StateError> {
        self.finish_all(view, rates)
    }

    fn stiffness(&self, state: &State<S>, see: &mut dyn FnMut(NodeStiffness<S>)) {
        self.stiffness_of_all(state, see);
    }
}

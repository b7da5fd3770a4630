//! The elements of one model in an explicit scheme.

use crate::element::conjugates::{OneSet, PointRule};
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::explicit::closed::Closed;
use crate::element::group::explicit::stage::Stage;
use crate::element::group::explicit::view::ClosingView;
use crate::element::group::interface::{Elements, ExplicitGroup, Loose};
use crate::element::group::loose::LooseElements;
use crate::element::group::placed::PlacedPoint;
use crate::element::group::view::Placed;
use crate::element::kinematics::{Kinematics, QuadraticStrain};
use eem_material::free_energy::{Array, Material};

/// Springs of the model `M` with the kinematics `K`. Their forces follow from the state alone.
pub(crate) struct ExplicitElements<M: Material, K: Kinematics<D>, const D: usize> {
    /// The elements in a state.
    pub(super) elements: ElementGroup<M, K, D>,
    /// Per element: its component, and the indices of its nodes among the places of a stage.
    pub(super) places: Vec<(u32, K::PerNode<u32>)>,
    /// Per element: its last evaluation in a closing.
    pub(super) closed: Vec<Closed<M, K, D>>,
    /// The elements without a scheme, whose models may be behind a table.
    loose: Box<dyn Loose<D>>,
}

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitElements<M, K, D> {
    pub(crate) fn new(
        elements: LooseElements<M, K, D>,
        placed: Placed<'_>,
        loose: Box<dyn Loose<D>>,
    ) -> Self {
        let scheme = OneSet::Point(PointRule::Variational);
        let elements = ElementGroup::new(scheme, elements, placed);
        let count = elements.members.len();
        Self {
            places: vec![(0, K::PerNode::filled(0)); count],
            closed: (0..count).map(|_| Closed::none()).collect(),
            elements,
            loose,
        }
    }

    /// All elements, each with the places of its nodes.
    #[inline]
    pub(super) fn placed(&self) -> impl Iterator<Item = (&PlacedPoint<M, K, D>, K::PerNode<u32>)> {
        let members = self.elements.members.iter().zip(&self.places);
        members.map(|(member, &(_, nodes))| (member.only(), nodes))
    }
}

impl<M: Material, K: QuadraticStrain<D>, const D: usize> ExplicitGroup<D>
    for ExplicitElements<M, K, D>
{
    fn elements(&self) -> &dyn Elements<D> {
        &self.elements
    }

    fn elements_mut(&mut self) -> &mut dyn Elements<D> {
        &mut self.elements
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>> {
        self.loose
    }

    fn join(&mut self, component_of: &[u32], place_of: &dyn Fn(u32, u32) -> u32) {
        let members = self.elements.members.iter().zip(&mut self.places);
        for (member, (component, places)) in members {
            *component = component_of[member.only().element.index()];
            for (place, &node) in places.as_mut().iter_mut().zip(member.site.nodes.as_ref()) {
                *place = place_of(*component, node);
            }
        }
    }

    fn rates(&self, stage: &mut Stage<D>) -> Result<(), StateError> {
        self.rates_of_all(stage)
    }

    fn integrate_thermostats(&self, stage: &mut Stage<D>, is_start: bool) {
        self.integrate_thermostats_of_all(stage, is_start);
    }

    fn close(&mut self, view: &mut ClosingView<'_, D>) -> Result<(), StateError> {
        self.close_all(view)
    }

    fn pull(&self, components: &[bool], forces: &mut [[f64; D]], creep: &mut [[f64; 2]]) {
        self.pull_all(components, forces, creep);
    }

    fn finish(&self, stage: &mut Stage<D>) -> Result<(), StateError> {
        self.finish_all(stage)
    }
}

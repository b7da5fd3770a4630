//! The elements of one model in an explicit scheme.

use crate::element::conjugates::{OneSet, PointRule};
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::explicit::closed::Closed;
use crate::element::group::explicit::stage::{Place, Stage};
use crate::element::group::explicit::view::ClosingView;
use crate::element::group::interface::{Elements, ExplicitGroup, Loose};
use crate::element::group::loose::LooseElements;
use crate::element::group::placed::PlacedPoint;
use crate::element::group::view::Placed;
use crate::element::kinematics::{Kinematics, QuadraticStrain};
use eem_material::free_energy::Material;
use eem_material::number::compact::compact;

/// Where an element is in a stage.
pub(super) struct Spot<N> {
    pub(super) component: u32,
    /// The index of its temperature among the internal variables, if it has one.
    pub(super) temperature: u32,
    /// The indices of its nodes among the places.
    pub(super) nodes: N,
}

/// Springs of the model `M` with the kinematics `K`. Their forces follow from the state alone.
pub(crate) struct ExplicitElements<M: Material, K: Kinematics<D>, const D: usize> {
    /// The elements in a state.
    pub(super) elements: ElementGroup<M, K, D>,
    /// Per element.
    pub(super) spots: Vec<Spot<K::PerNode<u32>>>,
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
            spots: Vec::with_capacity(count),
            closed: (0..count).map(|_| Closed::none()).collect(),
            elements,
            loose,
        }
    }

    /// All elements with their spots.
    #[inline]
    pub(super) fn placed(
        &self,
    ) -> impl Iterator<Item = (&PlacedPoint<M, K, D>, &Spot<K::PerNode<u32>>)> {
        let members = self.elements.members.iter().zip(&self.spots);
        members.map(|(member, spot)| (member.only(), spot))
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

    fn join(
        &mut self,
        (component_of, first_temperature): (&[u32], usize),
        place_of: &dyn Fn(u32, u32) -> u32,
    ) {
        for member in &self.elements.members {
            let point = member.only();
            let component = component_of[point.element.index()];
            let mut nodes = member.site.nodes;
            for node in nodes.as_mut() {
                *node = place_of(component, *node);
            }
            let thermal = point.slots().thermal.unwrap_or(0);
            self.spots.push(Spot {
                component,
                temperature: compact(first_temperature + thermal),
                nodes,
            });
        }
    }

    fn rates(&self, places: &mut [Place<D>], stage: &mut Stage) -> Result<(), StateError> {
        self.rates_of_all(places, stage)
    }

    fn integrate_thermostats(&self, places: &[Place<D>], stage: &mut Stage, is_start: bool) {
        self.integrate_thermostats_of_all(places, stage, is_start);
    }

    fn close(&mut self, view: &mut ClosingView<'_, D>) -> Result<(), StateError> {
        self.close_all(view)
    }

    fn pull(&self, components: &[bool], forces: &mut [[f64; D]], creep: &mut [[f64; 2]]) {
        self.pull_all(components, forces, creep);
    }

    fn finish(&self, places: &mut [Place<D>], stage: &mut Stage) -> Result<(), StateError> {
        self.finish_all(places, stage)
    }
}

//! The bodies of a scene of any dimension, for what is not worth being compiled for each.

use super::view::View;
use crate::element::group::{ExplicitGroup, Place, Stiffness, points};
use crate::element::handle::{Element, Node};
use crate::scene::loads::TemperatureCourse;
use crate::step::control::LoadRounding;

/// A function of the stiffnesses of an element.
pub(super) type See<'a> = &'a mut dyn FnMut(Stiffness<'_>);

/// A mass or an anchor.
pub(super) struct Seen<'a> {
    pub(super) q: &'a [f64],
    pub(super) p: &'a [f64],
    /// Both at the start of the step.
    pub(super) start: [&'a [f64]; 2],
    /// The kept rates of both, one row after the other.
    pub(super) rates: &'a [f64],
    /// Its weight and the constant loads on it, N.
    pub(super) force: &'a [f64],
    /// m, zero for anchors, kg; and 1/m.
    pub(super) mass: f64,
    pub(super) per_mass: f64,
}

/// Masses, anchors, elements and loads in a step.
pub(super) trait Bodies {
    /// The start of the step.
    fn view(&self) -> &View<'_>;

    fn at(&self, place: usize) -> Seen<'_>;

    /// Writes the constant forces on places and those of elements in some components, and `γ̇` and `g γ̇` of their dashpots.
    fn find_forces(&self, components: &[bool], forces: &mut [f64], creep: &mut [[f64; 2]]);

    /// Calls a function for each element.
    fn see_stiffnesses(&self, see: See<'_>);

    /// Finds the rounding of the loads.
    fn find_rounding(&self, rounding: &mut LoadRounding);

    /// Acceleration of free fall, m/s².
    fn gravity(&self) -> &[f64];

    /// Writes the position of a moved anchor at a time, s, and so much after the start of the step, m. Returns the anchor.
    fn find_position(&self, motion: usize, times: [f64; 2], position: &mut [f64]) -> Node;

    fn temperatures(&self) -> &[(Element, TemperatureCourse)];
}

/// The same in a dimension.
#[derive(Clone, Copy)]
pub(super) struct BodiesIn<'a, const D: usize> {
    pub(super) places: &'a [Place<D>],
    pub(super) groups: &'a [Box<dyn ExplicitGroup<D>>],
    pub(super) view: &'a View<'a>,
}

impl<const D: usize> Bodies for BodiesIn<'_, D> {
    fn view(&self) -> &View<'_> {
        self.view
    }

    fn at(&self, place: usize) -> Seen<'_> {
        let place = &self.places[place];
        let [q, p] = &place.past.start;
        Seen {
            q: place.q(),
            p: place.p(),
            start: [q, p],
            rates: place.past.rates.as_flattened().as_flattened(),
            force: &place.force,
            mass: place.mass,
            per_mass: place.per_mass(),
        }
    }

    fn find_forces(&self, components: &[bool], forces: &mut [f64], creep: &mut [[f64; 2]]) {
        let forces = forces.as_chunks_mut().0;
        for (force, place) in forces.iter_mut().zip(self.places) {
            *force = place.force;
        }
        for group in self.groups {
            group.pull(components, forces, creep);
        }
    }

    fn see_stiffnesses(&self, see: See<'_>) {
        for group in self.groups {
            group.elements().stiffness(self.view.state, see);
        }
    }

    fn find_rounding(&self, rounding: &mut LoadRounding) {
        let View {
            step, state, least, ..
        } = *self.view;
        rounding.find(self.view.loads, least, [state.time.value, step]);
    }

    fn gravity(&self) -> &[f64] {
        &self.view.loads.gravity
    }

    fn find_position(
        &self,
        motion: usize,
        [time, elapsed]: [f64; 2],
        position: &mut [f64],
    ) -> Node {
        let (node, course) = &self.view.loads.motions[motion];
        let old = points::<D>(self.view.state.positions.values());
        let found = course.position(time, &old[node.index], elapsed);
        position.copy_from_slice(found.as_slice());
        *node
    }

    fn temperatures(&self) -> &[(Element, TemperatureCourse)] {
        &self.view.loads.temperatures
    }
}

//! The bodies of a scene of any dimension, for what is not worth being compiled for each.

use super::View;
use crate::element::group::{ExplicitGroup, Place, Stiffness};
use crate::element::state::State;
use crate::scene::loads::Loads;
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

/// Masses, anchors, elements and loads.
pub(super) trait Bodies {
    fn at(&self, place: usize) -> Seen<'_>;

    /// Writes the constant forces on places and those of elements in some components, and `γ̇` and `g γ̇` of their dashpots.
    fn find_forces(&self, components: &[bool], forces: &mut [f64], creep: &mut [[f64; 2]]);

    /// Calls a function for each element.
    fn see_stiffnesses(&self, state: &State, see: See<'_>);

    /// Finds the rounding of the loads of a step.
    fn find_rounding(&self, rounding: &mut LoadRounding, view: &View<'_>);
}

/// The same in a dimension.
#[derive(Clone, Copy)]
pub(super) struct BodiesIn<'a, const D: usize> {
    pub(super) places: &'a [Place<D>],
    pub(super) groups: &'a [Box<dyn ExplicitGroup<D>>],
    pub(super) loads: &'a Loads<D>,
}

impl<const D: usize> Bodies for BodiesIn<'_, D> {
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

    fn see_stiffnesses(&self, state: &State, see: See<'_>) {
        for group in self.groups {
            group.elements().stiffness(state, see);
        }
    }

    fn find_rounding(&self, rounding: &mut LoadRounding, view: &View<'_>) {
        rounding.find(self.loads, view.least, [view.state.time.value, view.step]);
    }
}

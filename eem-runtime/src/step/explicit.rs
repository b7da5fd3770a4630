//! The explicit energy–entropy–momentum scheme of order 8.
//!
//! Stages of DOP853 in positions, momenta, viscous stretches and temperatures; entropies by quadrature over
//! the stages, with productions that are never negative; one closing per step and connected component that
//! puts energy and momenta back to their targets to rounding.
//!
//! ```text
//! stages     stage vectors, their rates, and the integrals of the step   (stages, outside, error)
//! book       entropies and targets from the integrals                    (booking, guard, thermostats)
//! close      momenta, then energy: by heat, by motion, by shape          (closing)
//! prove      what is left of all laws has to be rounding                 (proof)
//! ```

mod attempt;
mod booking;
mod closing;
mod components;
mod demand;
mod error;
mod guard;
mod inertia;
mod memory;
mod origin;
mod outside;
mod prescribed;
mod proof;
mod saved;
mod stability;
mod stages;
mod start;
mod tableau;
mod thermostats;

use core::mem;

use crate::element::conduction::Conduction;
use crate::element::ends::Ends;
use crate::element::group::{Elements, ExplicitGroup, Loose, Stage, Thermostat};
use crate::element::layout::Layout;
use crate::element::loads::StepLoads;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::scene::loads::Loads;
use crate::step::control::{LeastScales, LoadRounding};
use components::Components;
use memory::{Books, LoadSums, Scratch};
use prescribed::Prescribed;

pub(crate) use demand::Demand;
pub(crate) use memory::SavedExplicit;
pub(crate) use tableau::{REAL_LIMIT, load_rule, motion_rule};

/// The explicit scheme for a scene.
#[expect(
    clippy::struct_excessive_bools,
    reason = "each says something of its own"
)]
pub(crate) struct Explicit<const D: usize> {
    groups: Vec<Box<dyn ExplicitGroup<D>>>,
    components: Components,
    /// Whether each thermal slot has a path of heat or a dashpot.
    produces: Vec<bool>,
    prescribed: Prescribed<D>,
    /// Whether forces are functions of time.
    has_functions: bool,
    /// The loads at the present stage, and at the start of the step.
    loads: StepLoads,
    start_loads: StepLoads,
    /// Whether loads, moved anchors, thermostats or dashpots that lose heat act, so that integrals of the step change targets.
    is_driven: bool,
    /// The number of places, entries of the stage vector, whose rates are kept: masses, and anchors where some are moved.
    kept_places: usize,
    /// The present stage; between steps, the end of the last one, with its rates.
    stage: Stage<D>,
    /// Work and impulses of the loads on each component since the start of the step; empty without loads.
    load_sums: Vec<LoadSums<D>>,
    /// Targets and sums, now and before the step.
    books: Books<D>,
    old_books: Books<D>,
    scratch: Scratch<D>,
    /// Whether energy defects are closed by motion before heat.
    is_motion_first: bool,
    /// Whether rates and targets belong to the state, now and before the last attempt.
    is_ready: bool,
    was_ready: bool,
    /// Whether the stage has left the start of a step that was not accepted, so that it has to be restored.
    has_left: bool,
    /// How often all elements have been evaluated.
    evaluations: u64,
    /// The rounding of the loads of the last step where it was needed.
    rounding: LoadRounding,
}

/// The input of a step.
#[derive(Clone, Copy)]
pub(crate) struct ExplicitView<'a, const D: usize> {
    /// h, s.
    pub(crate) step: f64,
    /// The old state.
    pub(crate) state: &'a State,
    pub(crate) conduction: &'a Conduction,
    pub(crate) loads: &'a Loads<D>,
    pub(crate) masses: &'a Masses,
    pub(crate) least: &'a LeastScales,
}

/// The scene for which an explicit scheme is built.
#[derive(Clone, Copy)]
pub(crate) struct Site<'a, const D: usize> {
    pub(crate) masses: &'a Masses,
    pub(crate) elements: &'a Ends,
    pub(crate) layout: &'a Layout,
    pub(crate) conduction: &'a Conduction,
    pub(crate) loads: &'a Loads<D>,
}

impl<const D: usize> Explicit<D> {
    /// For these groups, which know their entropies already.
    pub(crate) fn new(mut groups: Vec<Box<dyn ExplicitGroup<D>>>, site: Site<'_, D>) -> Self {
        let mut components =
            Components::new(site.masses, site.elements, site.layout, site.conduction);
        let place_of = components.place_of();
        for group in &mut groups {
            group.join((&components.of_element, site.layout.viscous), &place_of);
        }
        let reservoirs = &site.conduction.reservoirs;
        let prescribed = Prescribed::new(site.loads, site.layout, &components);
        let mut thermostats = Vec::new();
        for held in &prescribed.held {
            thermostats.resize(site.layout.thermal, Thermostat::new(false));
            thermostats[held.slot] = Thermostat::new(true);
        }
        for path in &mut components.paths {
            for (stores, end) in path.stores.iter_mut().zip(path.ends) {
                *stores &= !thermostats.get(end).is_some_and(|of| of.holds);
            }
        }
        let loads = StepLoads::new(site.masses.len() * D, site.layout, site.loads, false);
        let counts = [site.masses.len(), site.layout.thermal];
        let rounding = LoadRounding::new(site.loads, loads.slots.clone(), counts);
        let moves = !prescribed.moved.is_empty();
        let has_loads = loads.has_total_force() || moves;
        let masses = components.masses_of(site.masses);
        let stage = Stage::new(&masses, site.layout, reservoirs.len(), thermostats);
        let books = Books::new(&components);
        Self {
            produces: produces(&components, site.layout),
            load_sums: vec![LoadSums::none(); if has_loads { components.all.len() } else { 0 }],
            old_books: books.clone(),
            books,
            scratch: Scratch::new(&components, site.layout, site.masses.len()),
            is_driven: has_loads
                || stage.has_thermostats
                || components
                    .dashpots
                    .iter()
                    .any(|dashpot| dashpot.slot.is_none()),
            kept_places: if moves {
                components.nodes.len()
            } else {
                components.masses
            },
            stage,
            groups,
            components,
            prescribed,
            start_loads: loads.clone(),
            loads,
            has_functions: site.loads.have_forces_of_time(),
            is_motion_first: false,
            is_ready: false,
            was_ready: false,
            has_left: false,
            evaluations: 0,
            rounding,
        }
    }

    /// A group of elements.
    pub(crate) fn elements(&self, group: usize) -> &dyn Elements<D> {
        self.groups[group].elements()
    }

    /// How many groups of elements there are.
    pub(crate) fn groups(&self) -> usize {
        self.groups.len()
    }

    /// Calls a function for each group of elements.
    pub(crate) fn each_mut(&mut self, mut visit: impl FnMut(&mut dyn Elements<D>)) {
        for group in &mut self.groups {
            visit(group.elements_mut());
        }
    }

    /// Takes the elements out; the scheme cannot step afterwards.
    pub(crate) fn take_elements(&mut self) -> Vec<Box<dyn Loose<D>>> {
        let groups = mem::take(&mut self.groups).into_iter();
        groups.map(ExplicitGroup::into_loose).collect()
    }

    /// How often all elements have been evaluated.
    pub(crate) const fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Whether energy defects are closed by motion before heat.
    pub(crate) const fn is_motion_first(&self) -> bool {
        self.is_motion_first
    }

    /// Chooses whether motion or heat closes energy defects first.
    pub(crate) const fn set_motion_first(&mut self, is_motion_first: bool) {
        self.is_motion_first = is_motion_first;
    }
}

/// Whether each thermal slot has a path of heat or a dashpot.
fn produces(components: &Components, layout: &Layout) -> Vec<bool> {
    let mut produces = vec![false; layout.thermal];
    let ends = components.paths.iter().flat_map(|path| path.ends);
    let dashpots = components.dashpots.iter();
    for slot in ends.chain(dashpots.filter_map(|dashpot| dashpot.slot)) {
        // Reservoirs come after the thermal slots.
        if let Some(produces) = produces.get_mut(slot) {
            *produces = true;
        }
    }
    produces
}

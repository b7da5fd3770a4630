//! The explicit energy–entropy–momentum scheme of order 8.
//!
//! Stages of DOP853 in positions, momenta, viscous stretches and temperatures; entropies by quadrature over
//! the stages, with productions that are never negative; one closing per step and connected component that
//! puts energy and momenta back to their targets to rounding.
//!
//! ```text
//! accounts   what does not depend on the dimension: internal variables, energies, entropies
//! stages     stage vectors, their rates, and the integrals of the step   (stages, outside, error)
//! book       entropies and targets from the integrals                    (booking, guard, thermostats)
//! close      momenta, then energy: by heat, by motion, by shape          (closing)
//! prove      what is left of all laws has to be rounding                 (proof)
//! ```

mod accounts;
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
use core::ops::{Deref, DerefMut};

use crate::element::conduction::Conduction;
use crate::element::ends::Ends;
use crate::element::group::{Elements, ExplicitGroup, Loose, Place};
use crate::element::layout::Layout;
use crate::element::loads::StepLoads;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::scene::loads::Loads;
use crate::step::control::{LeastScales, LoadRounding};
use accounts::Accounts;
use components::Components;
use memory::{LoadSums, Momenta, Motion};
use prescribed::{Prescribed, held};

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
    accounts: Accounts,
    /// Masses, then anchors.
    places: Vec<Place<D>>,
    prescribed: Prescribed<D>,
    /// Whether forces are functions of time.
    has_functions: bool,
    /// The loads at the present stage, and at the start of the step.
    loads: StepLoads,
    start_loads: StepLoads,
    /// The number of places, entries of the stage vector, whose rates are kept: masses, and anchors where some are moved.
    kept_places: usize,
    /// Work and impulses of the loads on each component since the start of the step; empty without loads.
    load_sums: Vec<LoadSums<D>>,
    /// The targets of the momenta of each component, now and before the step.
    momenta: Vec<Momenta<D>>,
    old_momenta: Vec<Momenta<D>>,
    /// The motion of each component.
    motions: Vec<Motion<D>>,
    /// The forces of the elements on places, where they are needed, N.
    forces: Vec<[f64; D]>,
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
        let components = Components::new(site.masses, site.elements, site.layout, site.conduction);
        let place_of = components.place_of();
        for group in &mut groups {
            group.join((&components.of_element, site.layout.viscous), &place_of);
        }
        let prescribed = Prescribed::new(site.loads, &components);
        let held = held(&site.loads.temperatures, site.layout);
        let loads = StepLoads::new(site.masses.len() * D, site.layout, site.loads, false);
        let counts = [site.masses.len(), site.layout.thermal];
        let rounding = LoadRounding::new(site.loads, loads.slots.clone(), counts);
        let moves = !prescribed.moved.is_empty();
        let has_loads = loads.has_total_force() || moves;
        let mut places = Vec::with_capacity(components.nodes.len());
        for &node in &components.nodes {
            places.push(Place::new(site.masses.get(node).unwrap_or(0.0)));
        }
        let count = components.all.len();
        let momenta = vec![Momenta::none(); count];
        Self {
            load_sums: vec![LoadSums::none(); if has_loads { count } else { 0 }],
            old_momenta: momenta.clone(),
            momenta,
            motions: vec![Motion::none(); count],
            forces: vec![[0.0; D]; places.len()],
            kept_places: if moves {
                places.len()
            } else {
                components.masses
            },
            places,
            accounts: Accounts::new(
                (components, held),
                (site.layout, site.conduction, site.masses.len()),
                has_loads,
            ),
            groups,
            prescribed,
            start_loads: loads.clone(),
            loads,
            has_functions: site.loads.have_forces_of_time(),
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
        self.accounts.is_motion_first
    }

    /// Chooses whether motion or heat closes energy defects first.
    pub(crate) const fn set_motion_first(&mut self, is_motion_first: bool) {
        self.accounts.is_motion_first = is_motion_first;
    }
}

impl<const D: usize> Deref for Explicit<D> {
    type Target = Accounts;

    #[inline]
    fn deref(&self) -> &Accounts {
        &self.accounts
    }
}

impl<const D: usize> DerefMut for Explicit<D> {
    #[inline]
    fn deref_mut(&mut self) -> &mut Accounts {
        &mut self.accounts
    }
}

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
mod bodies;
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
mod view;

use core::mem;
use core::ops::{Deref, DerefMut};

use crate::element::conduction::Conduction;
use crate::element::ends::Ends;
use crate::element::group::{Elements, ExplicitGroup, Loose, Place};
use crate::element::layout::Layout;
use crate::element::loads::StepLoads;
use crate::element::masses::Masses;
use crate::scene::loads::SceneLoads;
use crate::step::control::LoadRounding;
use accounts::Accounts;
use bodies::BodiesIn;
use components::Components;
use memory::Momenta;
use prescribed::Prescribed;

pub(crate) use demand::Demand;
pub(crate) use memory::SavedExplicit;
pub(crate) use tableau::{REAL_LIMIT, load_rule, motion_rule};
pub(crate) use view::View;

/// The explicit scheme for a scene.
pub(crate) struct Explicit<const D: usize> {
    groups: Vec<Box<dyn ExplicitGroup<D>>>,
    accounts: Accounts,
    /// Masses, then anchors.
    places: Vec<Place<D>>,
    /// The momenta of each component.
    momenta: Vec<Momenta<D>>,
    /// The impulses of the loads on each component since the start of the step, per step; empty without loads.
    impulses: Vec<Momenta<D>>,
}

/// The scene for which an explicit scheme is built.
#[derive(Clone, Copy)]
pub(crate) struct Site<'a> {
    pub(crate) masses: &'a Masses,
    pub(crate) elements: &'a Ends,
    pub(crate) layout: &'a Layout,
    pub(crate) conduction: &'a Conduction,
    pub(crate) loads: &'a SceneLoads,
}

impl<const D: usize> Explicit<D> {
    /// For these groups, which know their entropies already.
    pub(crate) fn new(mut groups: Vec<Box<dyn ExplicitGroup<D>>>, site: Site<'_>) -> Self {
        let (components, ends) =
            Components::new(site.masses, site.elements, site.layout, site.conduction);
        for group in &mut groups {
            group.join((&components.of_element, &ends), site.layout.viscous);
        }
        let mut places = Vec::with_capacity(components.nodes.len());
        for &node in &components.nodes {
            places.push(Place::new(site.masses.get(node).unwrap_or(0.0)));
        }
        let loads = StepLoads::new(site.masses.len() * D, site.layout, site.loads, false);
        let counts = [site.masses.len(), site.layout.thermal];
        let mut moved = Vec::with_capacity(site.loads.motions.len());
        for (node, _) in &site.loads.motions {
            moved.push(Some(node.index));
        }
        let prescribed = Prescribed::new([&moved, &loads.slots], &components, D);
        let rounding = LoadRounding::new(site.loads, loads.slots.clone(), counts);
        let accounts = Accounts::new(
            (components, prescribed),
            (loads, rounding, site.loads.have_forces_of_time()),
            (site.layout, site.conduction),
            [site.masses.len(), D],
        );
        Self {
            momenta: vec![Momenta::none(); accounts.motions.len()],
            impulses: vec![Momenta::none(); accounts.load_sums.len()],
            places,
            accounts,
            groups,
        }
    }

    /// The accounts, and what they may ask of the bodies.
    fn parts<'a>(&'a mut self, view: &'a View<'a>) -> (&'a mut Accounts, BodiesIn<'a, D>) {
        let (groups, places) = (&self.groups, &self.places);
        let bodies = BodiesIn {
            places,
            groups,
            view,
        };
        (&mut self.accounts, bodies)
    }

    /// A group of elements.
    pub(crate) fn elements(&self, group: usize) -> &dyn Elements {
        self.groups[group].elements()
    }

    /// How many groups of elements there are.
    pub(crate) fn groups(&self) -> usize {
        self.groups.len()
    }

    /// Calls a function for each group of elements.
    pub(crate) fn each_mut(&mut self, visit: &mut dyn FnMut(&mut dyn Elements)) {
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
        self.accounts.evaluations
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

//! What does not depend on the dimension: internal variables, energies and entropies, with their books.

use core::mem;

use super::components::Components;
use super::memory::{Books, LoadSums, Motion, Scratch};
use super::prescribed::Prescribed;
use crate::element::conduction::Conduction;
use crate::element::group::{Stage, Thermostat};
use crate::element::layout::Layout;
use crate::element::loads::StepLoads;
use crate::step::control::LoadRounding;

/// Internal variables, energies, entropies and targets of all components, and what acts on them.
#[expect(
    clippy::struct_excessive_bools,
    reason = "each says something of its own"
)]
pub(crate) struct Accounts {
    /// The dimension of space.
    pub(super) dimension: usize,
    pub(super) components: Components,
    /// Whether each thermal slot has a path of heat or a dashpot.
    pub(super) produces: Vec<bool>,
    pub(super) prescribed: Prescribed,
    /// Whether loads, moved anchors, thermostats or dashpots that lose heat act, so that integrals of the step change targets.
    pub(super) is_driven: bool,
    /// Whether forces are functions of time.
    pub(super) has_functions: bool,
    /// The loads at the present stage, and at the start of the step.
    pub(super) loads: StepLoads,
    pub(super) start_loads: StepLoads,
    /// The rounding of the loads of the last step where it was needed.
    pub(super) rounding: LoadRounding,
    /// Work of the loads on each component since the start of the step; empty without loads.
    pub(super) load_sums: Vec<LoadSums>,
    /// The number of places, entries of the stage vector, whose rates are kept: masses, and anchors where some are moved.
    pub(super) kept_places: usize,
    /// The present stage; between steps, the end of the last one, with its rates.
    pub(super) stage: Stage,
    /// Targets and sums, now and before the step.
    pub(super) books: Books,
    pub(super) old_books: Books,
    /// The motion of each component.
    pub(super) motions: Vec<Motion>,
    pub(super) scratch: Scratch,
    /// Whether energy defects are closed by motion before heat.
    pub(super) is_motion_first: bool,
    /// Whether rates and targets belong to the state, now and before the last attempt.
    pub(super) is_ready: bool,
    pub(super) was_ready: bool,
    /// Whether the stage has left the start of a step that was not accepted, so that it has to be restored.
    pub(super) has_left: bool,
    /// How often all elements have been evaluated.
    pub(super) evaluations: u64,
}

impl Accounts {
    /// For a scene with this many nodes in a space of this dimension.
    pub(super) fn new(
        (mut components, prescribed): (Components, Prescribed),
        (loads, rounding, has_functions): (StepLoads, LoadRounding, bool),
        (layout, conduction): (&Layout, &Conduction),
        [nodes, dimension]: [usize; 2],
    ) -> Self {
        let mut thermostats = Vec::new();
        for held in &prescribed.held {
            thermostats.resize(layout.thermal, Thermostat::new(false));
            thermostats[held.slot] = Thermostat::new(true);
        }
        for path in &mut components.paths {
            for (stores, end) in path.stores.iter_mut().zip(path.ends) {
                *stores &= !thermostats.get(end).is_some_and(|of| of.holds);
            }
        }
        let stage = Stage::new(layout, conduction.reservoirs.len(), thermostats);
        let loses = components.dashpots.iter().any(|of| of.slot.is_none());
        let moves = !prescribed.moved.is_empty();
        let has_loads = loads.has_total_force() || moves;
        let (count, places) = (components.all.len(), components.nodes.len());
        let books = Books::new(&components, dimension);
        Self {
            dimension,
            produces: produces(&components, layout),
            prescribed,
            is_driven: has_loads || loses || stage.has_thermostats,
            has_functions,
            start_loads: loads.clone(),
            loads,
            rounding,
            load_sums: vec![LoadSums::default(); if has_loads { count } else { 0 }],
            kept_places: if moves { places } else { components.masses },
            stage,
            old_books: books.clone(),
            books,
            motions: vec![Motion::default(); count],
            scratch: Scratch::new(&components, layout, [nodes, dimension]),
            is_motion_first: false,
            is_ready: false,
            was_ready: false,
            has_left: false,
            evaluations: 0,
            components,
        }
    }

    /// Exchanges the books with those before the step.
    pub(super) fn swap_books(&mut self) {
        mem::swap(&mut self.books, &mut self.old_books);
    }
}

/// Whether each thermal slot has a path of heat or a dashpot.
fn produces(components: &Components, layout: &Layout) -> Vec<bool> {
    let mut produces = vec![false; layout.thermal];
    for path in &components.paths {
        for end in path.ends {
            // Reservoirs come after the thermal slots.
            if let Some(produces) = produces.get_mut(end) {
                *produces = true;
            }
        }
    }
    for dashpot in &components.dashpots {
        if let Some(slot) = dashpot.slot {
            produces[slot] = true;
        }
    }
    produces
}

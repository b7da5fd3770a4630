//! What does not depend on the dimension: internal variables, energies and entropies, with their books.

use core::mem;

use super::components::Components;
use super::memory::{Books, Scratch};
use super::prescribed::Held;
use crate::element::conduction::Conduction;
use crate::element::group::{Stage, Thermostat};
use crate::element::layout::Layout;

/// Internal variables, energies and entropies of all components.
pub(crate) struct Accounts {
    pub(super) components: Components,
    /// Whether each thermal slot has a path of heat or a dashpot.
    pub(super) produces: Vec<bool>,
    /// The elements with thermostats.
    pub(super) held: Vec<Held>,
    /// Whether loads, moved anchors, thermostats or dashpots that lose heat act, so that integrals of the step change targets.
    pub(super) is_driven: bool,
    /// The present stage; between steps, the end of the last one, with its rates.
    pub(super) stage: Stage,
    /// Targets and sums, now and before the step.
    pub(super) books: Books,
    pub(super) old_books: Books,
    pub(super) scratch: Scratch,
    /// Whether energy defects are closed by motion before heat.
    pub(super) is_motion_first: bool,
}

impl Accounts {
    /// For a scene with this many nodes; `is_driven` says whether loads or moved anchors act.
    pub(super) fn new(
        (mut components, held): (Components, Vec<Held>),
        (layout, conduction, nodes): (&Layout, &Conduction, usize),
        is_driven: bool,
    ) -> Self {
        let mut thermostats = Vec::new();
        for held in &held {
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
        let books = Books::new(&components);
        Self {
            produces: produces(&components, layout),
            held,
            is_driven: is_driven || loses || stage.has_thermostats,
            stage,
            old_books: books.clone(),
            books,
            scratch: Scratch::new(&components, layout, nodes),
            is_motion_first: false,
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

//! Temperatures at which every element receives as much heat as it gives.
//!
//! ```text
//! Σ κ (θ_partner − θ) + Σ κ (θ_r − θ) = 0
//! ```
//!
//! At rest nothing is dissipated, and conductances do not depend on the deformation, so that temperatures follow from the
//! paths of heat alone.

use super::motion::EquilibriumError;
use crate::algebra::memory::MemoryLimit;
use crate::algebra::pattern::Pattern;
use crate::algebra::system::LinearSystem;
use crate::element::conduction::{Conduction, Partner};
use crate::element::handle::Element;
use crate::element::layout::Layout;
use crate::scene::plan::{Groups, Plan};

/// The second solution corrects the rounding of the first.
const SOLUTIONS: usize = 2;

/// Replaces the temperatures of elements with paths of heat by those of thermal balance, and returns the largest heat that an
/// element still receives, W. Elements with thermostats or without paths keep their temperatures.
pub(super) fn balance(
    scene: &Plan,
    groups: &dyn Groups,
    layout: &Layout,
    temperatures: &mut [f64],
) -> Result<f64, EquilibriumError> {
    let reservoirs = scene.reservoir_temperatures().into_owned();
    let conduction = Conduction::new(&scene.conductors, reservoirs, layout);
    let slot_of = |element: usize| layout.elements[element].thermal;
    let mut is_fixed = vec![false; temperatures.len()];
    for (element, _) in &scene.loads.temperatures {
        if let Some(slot) = slot_of(element.index()) {
            is_fixed[slot] = true;
        }
    }
    let element_at = |element: usize| scene.element_at(element, groups);
    refuse_insulated((&conduction, layout), &is_fixed, &element_at)?;
    solve(&conduction, &is_fixed, scene.memory_limit, temperatures)
}

/// Finds the temperatures that are not fixed; the largest heat that an element still receives, W.
fn solve(
    conduction: &Conduction,
    is_fixed: &[bool],
    memory_limit: MemoryLimit,
    temperatures: &mut [f64],
) -> Result<f64, EquilibriumError> {
    let slots =
        (0..temperatures.len()).filter(|&slot| !is_fixed[slot] && has_path(conduction, slot));
    let slots: Vec<_> = slots.collect();
    let mut unknowns = vec![None; temperatures.len()];
    for (unknown, &slot) in slots.iter().enumerate() {
        unknowns[slot] = Some(unknown);
    }
    let pattern = Pattern::new(slots.len(), |pair| {
        for (row, &slot) in slots.iter().enumerate() {
            for link in conduction.links(slot) {
                if let Partner::Slot(partner) = link.partner
                    && let Some(column) = unknowns[partner].filter(|&column| column < row)
                {
                    pair(row, column);
                }
            }
        }
    });
    let system = LinearSystem::<1>::new(&pattern, 1, memory_limit);
    let mut system = system.map_err(|error| EquilibriumError::Scene {
        errors: vec![error.into()],
    })?;
    for _ in 0..SOLUTIONS {
        system.clear();
        for (row, &slot) in slots.iter().enumerate() {
            let diagonal = system.place(Some(row), Some(row));
            for link in conduction.links(slot) {
                let place = match link.partner {
                    Partner::Slot(partner) => system.place(Some(row), unknowns[partner]),
                    Partner::Reservoir(_) => system.place(Some(row), None),
                };
                let (values, _) = system.parts();
                values[diagonal] += link.conductance;
                values[place] -= link.conductance;
            }
            let flow = conduction.heat_flow(slot, temperatures[slot], temperatures);
            let (_, right) = system.parts();
            right[row] = [flow.heat];
        }
        let solved = system.solve();
        solved.map_err(|_| EquilibriumError::HeatNotBalanced)?;
        for (&[change], &slot) in system.solution().iter().zip(&slots) {
            temperatures[slot] += change;
        }
    }
    let flows = slots
        .iter()
        .map(|&slot| conduction.heat_flow(slot, temperatures[slot], temperatures));
    Ok(flows.fold(0.0, |most, flow| most.max(flow.heat.abs())))
}

fn has_path(conduction: &Conduction, slot: usize) -> bool {
    conduction
        .links(slot)
        .iter()
        .any(|link| link.conductance > 0.0)
}

/// An error if an element has paths of heat, but none that leads, directly or through others, to a reservoir or a thermostat.
fn refuse_insulated(
    (conduction, layout): (&Conduction, &Layout),
    is_fixed: &[bool],
    element_at: &dyn Fn(usize) -> Element,
) -> Result<(), EquilibriumError> {
    let mut is_linked = is_fixed.to_vec();
    for (slot, is_linked) in is_linked.iter_mut().enumerate() {
        let mut links = conduction.links(slot).iter();
        *is_linked |= links
            .any(|link| link.conductance > 0.0 && matches!(link.partner, Partner::Reservoir(_)));
    }
    let linked = is_linked
        .iter()
        .enumerate()
        .filter(|(_, is_linked)| **is_linked);
    let mut found: Vec<_> = linked.map(|(slot, _)| slot).collect();
    while let Some(slot) = found.pop() {
        for link in conduction
            .links(slot)
            .iter()
            .filter(|link| link.conductance > 0.0)
        {
            if let Partner::Slot(partner) = link.partner
                && !is_linked[partner]
            {
                is_linked[partner] = true;
                found.push(partner);
            }
        }
    }
    let mut slots = layout.elements.iter().map(|slots| slots.thermal);
    let insulated = slots
        .position(|slot| slot.is_some_and(|slot| !is_linked[slot] && has_path(conduction, slot)));
    match insulated {
        None => Ok(()),
        Some(element) => Err(EquilibriumError::Insulated {
            element: element_at(element),
        }),
    }
}

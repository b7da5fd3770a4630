//! The initial state of a scene.

use nalgebra::SVector;

use crate::algebra::vector;
use crate::element::group::Elements;
use crate::element::layout::Layout;
use crate::element::meters::Meters;
use crate::element::state::{Energy, State};
use crate::run::ledger::Ledger;
use crate::scene::Scene;
use crate::scene::entry::NodeEntry;
use crate::scene::error::SceneError;
use crate::scene::loads::{Course, Loads, Written, written};
use crate::scene::solid_error::SolidError;
use crate::step::explicit::Site;
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::derivative::{derivative, shares};

/// The initial state, without entropies, in the memory of one with as many entries if there is some: with velocities if the first
/// step, s, is given, else at rest. Errors for motions without an initial velocity.
pub(crate) fn initial_state<const D: usize>(
    scene: &Scene<D>,
    layout: &Layout,
    step: Option<f64>,
    used: Option<Box<State>>,
) -> Result<Box<State>, Vec<SceneError>> {
    let coordinates = scene.nodes.len() * D;
    let is_coupled = !scene.pairs.is_empty();
    let zeros = |count| Compensated::new(vec![0.0; count]);
    let zero = Sum::new(0.0);
    let mut state = used.unwrap_or_else(|| {
        Box::new(State {
            time: zero,
            positions: zeros(coordinates),
            momenta: zeros(coordinates),
            velocities: zeros(if is_coupled { coordinates } else { 0 }),
            viscous: zeros(layout.viscous),
            entropies: zeros(layout.thermal),
            temperatures: vec![0.0; layout.thermal],
            energies: vec![Energy::zero(); scene.elements.len()],
            reservoir_entropies: zeros(scene.reservoirs.len()),
            work: zero,
            heat: zero,
            thermostat_entropy: zero,
            dissipated: zero,
            meters: Meters::default(),
        })
    });
    let (moves, still) = (step.is_some(), SVector::from([0.0; D]));
    let positions = &mut state.positions;
    positions.write(|all| write_points(all, scene, |node| node.position));
    state.momenta.write(|all| {
        write_points(all, scene, |node| {
            let momentum = node.start_momentum(node.mass.unwrap_or(0.0));
            if moves { momentum } else { still }
        });
    });
    let mut errors = Vec::new();
    if is_coupled {
        state.velocities.write(|all| {
            write_points(all, scene, |node| match node.mass.filter(|_| moves) {
                Some(_) => node.velocity,
                None => still,
            });
            if let Some(step) = step {
                errors = find_speeds(&scene.loads, [scene.start, step], all);
            }
        });
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    state.viscous.write(|all| all.fill(0.0));
    state.temperatures.fill(0.0);
    for (entry, slots) in scene.elements.iter().zip(&layout.elements) {
        for &(dashpot, stretch) in &entry.viscous_stretches {
            state.viscous.set(slots.viscous + dashpot, stretch);
        }
        if let (Some(slot), Some(temperature)) = (slots.thermal, entry.temperature) {
            state.temperatures[slot] = temperature;
        }
    }
    state.entropies.write(|all| all.fill(0.0));
    state.energies.fill(Energy::zero());
    state.reservoir_entropies.write(|all| all.fill(0.0));
    state.time = Sum::new(scene.start);
    (state.work, state.heat) = (zero, zero);
    (state.thermostat_entropy, state.dissipated) = (zero, zero);
    state.meters = Meters::default();
    Ok(state)
}

/// Writes a vector for each node of a scene.
fn write_points<const D: usize>(
    all: &mut [f64],
    scene: &Scene<D>,
    of: impl Fn(&NodeEntry<D>) -> SVector<f64, D>,
) {
    for (own, node) in all.as_chunks_mut::<D>().0.iter_mut().zip(&scene.nodes) {
        *own = of(node).into();
    }
}

/// Writes the initial velocities of all motions; the errors of those that have none.
pub(super) fn find_speeds<const D: usize>(
    loads: &Loads<D>,
    span: [f64; 2],
    velocities: &mut [f64],
) -> Vec<SceneError> {
    let mut errors = Vec::new();
    for (node, motion) in &loads.motions {
        let Course::Function(motion) = motion else {
            continue;
        };
        let speeds = &mut velocities[node.index * D..][..D];
        find_speed(&written(motion), span, speeds);
        for (axis, speed) in speeds.iter().enumerate() {
            if !speed.is_finite() {
                errors.push(SolidError::AnchorSpeed { node: *node, axis }.into());
            }
        }
    }
    errors
}

/// Finds the initial velocity of a motion from its positions within the first step, m/s; not a number if it has none.
fn find_speed(motion: Written<'_>, [start, step]: [f64; 2], speeds: &mut [f64]) {
    let place_at = |time: f64| {
        let mut place = vec![0.0; speeds.len()];
        motion(time, &mut place);
        place
    };
    let spans = shares().map(|share| share * step);
    let (first, places) = (place_at(start), spans.map(|span| place_at(start + span)));
    for (axis, speed) in speeds.iter_mut().enumerate() {
        let values = vector(|at| places[at][axis]);
        *speed = derivative(first[axis], (spans, values));
    }
}

/// Finds the entropies of the initial state; all its errors if it is impossible.
pub(super) fn find_entropies<const D: usize>(
    elements: &mut [&mut dyn Elements<D>],
    state: &mut State,
    site: Site<'_, D>,
) -> Result<(), Vec<SceneError>> {
    let mut errors = Vec::new();
    for group in &mut *elements {
        group.initialize(state, &mut |error| errors.push(SceneError::State(error)));
    }
    if errors.is_empty() {
        let (reservoirs, gravity) = (&site.conduction.reservoirs, &site.loads.gravity);
        let mut groups = elements.iter().map(|group| &**group);
        let ledger = Ledger::of(state, site.masses, &mut groups, reservoirs, gravity);
        let infinite = ledger.infinite_entry();
        errors.extend(infinite.map(|(quantity, value, unit)| SceneError::Total {
            quantity,
            value,
            unit,
        }));
    }
    if errors.is_empty() {
        Ok(())
    } else {
        Err(errors)
    }
}

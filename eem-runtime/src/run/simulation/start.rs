//! The state in which a scene begins.

use core::mem;

use nalgebra::SVector;

use super::groups::Groups;
use super::totals::check_totals;
use crate::element::conduction::Conduction;
use crate::element::group::Placed;
use crate::element::layout::Layout;
use crate::element::loads::first_speed;
use crate::element::masses::Masses;
use crate::element::state::{Energy, State};
use crate::number::compact::compact;
use crate::number::compensated::{Compensated, Sum};
use crate::number::scalar::Real;
use crate::run::ledger::Ledger;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::step::scheme::Scheme;
use crate::step::systems::Systems;

/// The group of each element, and its place there.
pub(super) fn places_in<const D: usize, S: Real>(scene: &Scene<D, S>) -> Vec<[u32; 2]> {
    let elements = scene.elements.iter();
    let places = elements.map(|entry| [entry.group, entry.place].map(compact));
    places.collect()
}

/// The linear systems of a scheme, unless they take more memory than they may.
pub(super) fn systems_of<const D: usize, S: Real>(
    scene: &Scene<D, S>,
    scheme: Scheme,
    layout: &Layout,
    conduction: &Conduction<S>,
) -> Result<Systems<S, D>, Vec<SceneError>> {
    let elements = (&scene.elements[..], layout);
    let rockets = scene.loads.rocket_lines();
    Systems::new(scheme, elements, conduction, &rockets, scene.memory_limit)
        .map_err(|error| vec![error.into()])
}

/// The state that the scene describes, given the first step; its entropies are still to be found.
pub(super) fn initial_state<const D: usize, S: Real>(
    scene: &Scene<D, S>,
    layout: &Layout,
    step: S,
) -> State<S> {
    let coordinates = scene.nodes.len() * D;
    let mut positions = Vec::with_capacity(coordinates);
    let mut momenta = Vec::with_capacity(coordinates);
    let mut velocities = Vec::new();
    let still = SVector::from([S::zero(); D]);
    let is_coupled = !scene.pairs.is_empty();
    for node in &scene.nodes {
        let mass = node.mass.unwrap_or(S::zero());
        positions.extend(node.position.iter());
        momenta.extend(node.start_momentum(mass).iter());
        if is_coupled {
            let moving = node.mass.map_or(still, |_| node.velocity);
            velocities.extend(moving.iter());
        }
    }
    if is_coupled {
        let share = S::from_f64(FIRST_SHARE) * step;
        let times = [S::zero(), S::from_f64(0.5) * share, share];
        for (node, motion) in &scene.loads.motions {
            let places = times.map(|time| motion(time));
            for axis in 0..D {
                let speed = first_speed(places.map(|place| place[axis]), share);
                // What is no number is so in the first step, which says of what and when.
                if speed.is_finite() {
                    velocities[node.index * D + axis] = speed;
                }
            }
        }
    }
    let mut viscous = vec![S::zero(); layout.viscous];
    let mut temperatures = vec![S::zero(); layout.thermal];
    for (entry, slots) in scene.elements.iter().zip(&layout.elements) {
        for &(dashpot, stretch) in &entry.viscous_stretches {
            viscous[slots.viscous + dashpot] = stretch;
        }
        if let (Some(slot), Some(temperature)) = (slots.thermal, entry.temperature) {
            temperatures[slot] = temperature;
        }
    }
    State {
        time: Sum::new(S::zero()),
        positions: Compensated::new(positions),
        momenta: Compensated::new(momenta),
        velocities: Compensated::new(velocities),
        viscous: Compensated::new(viscous),
        entropies: Compensated::new(vec![S::zero(); temperatures.len()]),
        temperatures,
        energies: vec![Energy::zero(); scene.elements.len()],
        reservoir_entropies: Compensated::new(vec![S::zero(); scene.reservoirs.len()]),
        work: Sum::new(S::zero()),
        heat: Sum::new(S::zero()),
        thermostat_entropy: Sum::new(S::zero()),
        dissipated: Sum::new(S::zero()),
    }
}

/// The share of the first step within which a node of a solid that is moved gets its initial velocity: of the error
/// h² of that from the whole step it leaves nothing that counts, and of the digits of its places most.
const FIRST_SHARE: f64 = 1.0 / 256.0;

/// The elements of a scene, ready for a scheme in the initial state, whose entropies are found; or everything for which
/// it cannot be one, and the scene as it was.
pub(super) fn begin_groups<const D: usize, S: Real>(
    scene: &mut Scene<D, S>,
    scheme: Scheme,
    (layout, masses): (&Layout, &Masses<S>),
    state: &mut State<S>,
) -> Result<Groups<S, D>, Vec<SceneError>> {
    let elements = mem::take(&mut scene.groups);
    let placed = Placed {
        nodes: &scene.elements,
        layout,
    };
    let mut groups = Groups::new(elements, scheme, placed);
    let errors = groups.initialize(state).into_iter();
    let mut errors: Vec<_> = errors.map(SceneError::from).collect();
    if errors.is_empty() {
        let all = groups.all().into_iter();
        let ledger = Ledger::of(state, masses, all, &scene.reservoirs, &scene.loads.gravity);
        errors.extend(check_totals(&ledger).err());
    }
    if errors.is_empty() {
        return Ok(groups);
    }
    scene.groups = groups.into_loose();
    Err(errors)
}

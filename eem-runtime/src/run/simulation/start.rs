//! The initial state of a scene.

use nalgebra::SVector;

use super::stepper::Parts;
use crate::algebra::vector;
use crate::element::group::Elements;
use crate::element::layout::Layout;
use crate::element::meters::Meters;
use crate::element::state::{Energy, State};
use crate::run::ledger::Ledger;
use crate::scene::Scene;
use crate::scene::entry::ElementEntry;
use crate::scene::error::SceneError;
use crate::scene::loads::{Course, Loads, Written, written};
use crate::scene::solid_error::SolidError;
use crate::step::control::Tolerance;
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::derivative::{derivative, shares};

/// What a run begins with.
#[derive(Clone, Copy, Debug)]
pub(super) enum Begin {
    /// A step, s: constant, or the first one that step control tries.
    WithStep(f64),
    /// A tolerance, from which the first step follows.
    WithTolerance(Tolerance),
}

impl Begin {
    /// The step, s; 1 s before it is found.
    pub(super) fn step(&self) -> f64 {
        match self {
            Self::WithStep(step) => *step,
            Self::WithTolerance(_) => 1.0,
        }
    }
}

/// The initial state, without entropies: with velocities if the first step, s, is given, else at rest. Errors for motions
/// without an initial velocity.
pub(crate) fn initial_state<const D: usize>(
    scene: &Scene<D>,
    layout: &Layout,
    step: Option<f64>,
) -> Result<State, Vec<SceneError>> {
    let mut errors = Vec::new();
    let coordinates = scene.nodes.len() * D;
    let mut positions = Vec::with_capacity(coordinates);
    let mut momenta = Vec::with_capacity(coordinates);
    let mut velocities = Vec::new();
    let is_coupled = !scene.pairs.is_empty();
    for node in &scene.nodes {
        let mass = node.mass.unwrap_or(0.0);
        let still = SVector::from([0.0; D]);
        let moves = step.is_some();
        positions.extend_from_slice(node.position.as_slice());
        let momentum = if moves {
            node.start_momentum(mass)
        } else {
            still
        };
        momenta.extend_from_slice(momentum.as_slice());
        if is_coupled {
            let has_speed = moves && node.mass.is_some();
            let velocity = if has_speed { &node.velocity } else { &still };
            velocities.extend_from_slice(velocity.as_slice());
        }
    }
    if let Some(step) = step.filter(|_| is_coupled) {
        let span = [scene.start, step];
        errors.extend(find_speeds(&scene.loads, span, &mut velocities));
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let nodes = [
        Compensated::new(positions),
        Compensated::new(momenta),
        Compensated::new(velocities),
    ];
    let reservoirs = scene.reservoirs.len();
    Ok(state(
        scene.start,
        nodes,
        (&scene.elements, layout),
        reservoirs,
    ))
}

/// The initial state with these positions, momenta and velocities of nodes.
fn state(
    time: f64,
    [positions, momenta, velocities]: [Compensated; 3],
    (elements, layout): (&[ElementEntry], &Layout),
    reservoirs: usize,
) -> State {
    let zeros = |count| vec![0.0; count];
    let zero = Sum::new(0.0);
    let mut viscous = zeros(layout.viscous);
    let mut temperatures = zeros(layout.thermal);
    for (entry, slots) in elements.iter().zip(&layout.elements) {
        for &(dashpot, stretch) in &entry.viscous_stretches {
            viscous[slots.viscous + dashpot] = stretch;
        }
        if let (Some(slot), Some(temperature)) = (slots.thermal, entry.temperature) {
            temperatures[slot] = temperature;
        }
    }
    State {
        time: Sum::new(time),
        positions,
        momenta,
        velocities,
        viscous: Compensated::new(viscous),
        entropies: Compensated::new(zeros(layout.thermal)),
        temperatures,
        energies: vec![Energy::zero(); elements.len()],
        reservoir_entropies: Compensated::new(zeros(reservoirs)),
        work: zero,
        heat: zero,
        thermostat_entropy: zero,
        dissipated: zero,
        meters: Meters::default(),
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
    parts: Parts<'_, D>,
) -> Result<(), Vec<SceneError>> {
    let mut errors = Vec::new();
    for group in &mut *elements {
        group.initialize(state, &mut |error| errors.push(SceneError::State(error)));
    }
    if errors.is_empty() {
        let (reservoirs, gravity) = (&parts.conduction.reservoirs, &parts.loads.gravity);
        let mut groups = elements.iter().map(|group| &**group);
        let ledger = Ledger::of(state, parts.masses, &mut groups, reservoirs, gravity);
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

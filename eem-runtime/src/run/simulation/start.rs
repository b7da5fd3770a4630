//! The rules for the scheme and the step of a run, and the initial state of its scene.

use crate::algebra::vector;
use crate::element::group::{ElementTotals, Elements};
use crate::element::handle::{Element, Node};
use crate::element::layout::Layout;
use crate::element::meters::Meters;
use crate::element::state::{Energy, State};
use crate::run::ledger::Ledger;
use crate::scene::Scene;
use crate::scene::entry::{ElementEntry, NodeEntry};
use crate::scene::error::{RocketError, SceneError};
use crate::scene::loads::{Course, SceneLoads, Written};
use crate::scene::solid_error::SolidError;
use crate::step::automatic::FIRST;
use crate::step::control::Tolerance;
use crate::step::explicit::Site;
use crate::step::features::Feature;
use crate::step::scheme::{Closing, Scheme};
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::derivative::{derivative, shares};
use nalgebra::SVector;

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
    let velocities = if is_coupled { coordinates } else { 0 };
    let counts = [coordinates, velocities, scene.reservoirs.len()];
    let mut state = cleared_state(counts, layout, used);
    state.time = Sum::new(scene.start);
    set_internal(&scene.elements, layout, &mut state);
    let (moves, still) = (step.is_some(), SVector::from([0.0; D]));
    let positions = &mut state.positions;
    positions.write(|all| write_points(all, scene, &|node| node.position));
    state.momenta.write(|all| {
        write_points(all, scene, &|node| {
            let momentum = node.start_momentum(node.mass.unwrap_or(0.0));
            if moves { momentum } else { still }
        });
    });
    let mut errors = Vec::new();
    if is_coupled {
        state.velocities.write(|all| {
            write_points(all, scene, &|node| match node.mass.filter(|_| moves) {
                Some(_) => node.velocity,
                None => still,
            });
            if let Some(step) = step {
                errors = find_speeds(&scene.loads, [scene.start, step], all);
            }
        });
    }
    if errors.is_empty() {
        Ok(state)
    } else {
        Err(errors)
    }
}

/// A state of these numbers of coordinates, velocities and reservoirs, in the memory of one if there is some. All but the first two
/// are zero.
fn cleared_state(
    [coordinates, velocities, reservoirs]: [usize; 3],
    layout: &Layout,
    used: Option<Box<State>>,
) -> Box<State> {
    let zeros = |count| Compensated::new(vec![0.0; count]);
    let zero = Sum::new(0.0);
    let Some(mut state) = used else {
        return Box::new(State {
            time: zero,
            positions: zeros(coordinates),
            momenta: zeros(coordinates),
            velocities: zeros(velocities),
            viscous: zeros(layout.viscous),
            entropies: zeros(layout.thermal),
            temperatures: vec![0.0; layout.thermal],
            energies: vec![Energy::zero(); layout.elements.len()],
            reservoir_entropies: zeros(reservoirs),
            work: zero,
            heat: zero,
            thermostat_entropy: zero,
            dissipated: zero,
            meters: Meters::default(),
        });
    };
    let sums = [
        &mut state.viscous,
        &mut state.entropies,
        &mut state.reservoir_entropies,
    ];
    for sums in sums {
        sums.write(|all| all.fill(0.0));
    }
    state.temperatures.fill(0.0);
    state.energies.fill(Energy::zero());
    (state.work, state.heat) = (zero, zero);
    (state.thermostat_entropy, state.dissipated) = (zero, zero);
    state.meters = Meters::default();
    state
}

/// Writes viscous stretches and temperatures as they are given.
fn set_internal(elements: &[ElementEntry], layout: &Layout, state: &mut State) {
    for (entry, slots) in elements.iter().zip(&layout.elements) {
        for &(dashpot, stretch) in &entry.viscous_stretches {
            state.viscous.set(slots.viscous + dashpot, stretch);
        }
        if let (Some(slot), Some(temperature)) = (slots.thermal, entry.temperature) {
            state.temperatures[slot] = temperature;
        }
    }
}

/// Writes a vector for each node of a scene.
fn write_points<const D: usize>(
    all: &mut [f64],
    scene: &Scene<D>,
    of: &dyn Fn(&NodeEntry<D>) -> SVector<f64, D>,
) {
    for (own, node) in all.as_chunks_mut::<D>().0.iter_mut().zip(&scene.nodes) {
        *own = of(node).into();
    }
}

/// Writes the initial velocities of all motions; the errors of those that have none.
pub(super) fn find_speeds(
    loads: &SceneLoads,
    span: [f64; 2],
    velocities: &mut [f64],
) -> Vec<SceneError> {
    let mut errors = Vec::new();
    for (node, motion) in &loads.motions {
        let Course::Function(motion) = motion else {
            continue;
        };
        let dimension = loads.dimension();
        let speeds = &mut velocities[node.index * dimension..][..dimension];
        find_speed(&**motion, span, speeds);
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
        let mut totals = ElementTotals::new();
        for group in elements {
            group.add_totals(state, &mut totals);
        }
        let ledger = Ledger::of(state, site.masses, &totals, reservoirs, gravity);
        let infinite = ledger.infinite_entry(state, D);
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

/// The features of a scene that not every scheme can step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Needs {
    has_solids: bool,
    /// The node of a rocket.
    rocket: Option<Node>,
    /// An element with a dashpot in parallel with its spring.
    drag: Option<Element>,
}

impl Needs {
    /// The features of this scene.
    pub(super) fn of<const D: usize>(scene: &Scene<D>) -> Self {
        let group = |index: usize| scene.groups.get(index);
        let has_drag = |index| group(index).is_some_and(|group| group.shape().drag);
        let mut elements = scene.elements.iter();
        let drag = elements.position(|entry| has_drag(entry.group));
        let mut groups = scene.groups.iter();
        Self {
            has_solids: groups.any(|group| !group.shape().is_spring),
            rocket: scene.loads.rockets.first().map(|rocket| rocket.line.node),
            drag: drag.map(|index| scene.element_at(index)),
        }
    }

    /// The scheme with which a run set to `asked` begins.
    pub(super) fn first(&self, asked: Scheme) -> Scheme {
        let mut first = FIRST.into_iter();
        match asked {
            Scheme::Auto => first.find(|&scheme| self.allows(scheme)).unwrap_or(asked),
            own => own,
        }
    }

    /// Whether a scheme can step the scene.
    pub(super) fn allows(&self, scheme: Scheme) -> bool {
        self.check(scheme).is_ok()
    }

    /// An error unless a scheme can step the scene.
    pub(super) fn check(&self, scheme: Scheme) -> Result<(), SceneError> {
        let name = scheme.name();
        if self.has_solids && !scheme.steps(Feature::Solids) {
            let why = if scheme.closing() == Closing::Explicit {
                "so that every stage would solve a large linear system, and their small stiff elements allow only tiny steps"
            } else {
                "and only schemes that take the end of a step from its increments allow that"
            };
            return Err(SceneError::NotForSolids { scheme: name, why });
        }
        if let Some(node) = self.rocket.filter(|_| !scheme.steps(Feature::Rockets)) {
            return Err(RocketError::Scheme { scheme: name, node }.into());
        }
        let steps = scheme.steps(Feature::ParallelDashpots);
        self.drag.filter(|_| !steps).map_or(Ok(()), |element| {
            Err(SceneError::NoDrag {
                scheme: name,
                element,
            })
        })
    }
}

/// The shortest step, s: its square, which the equations of a step contain, is the least normal number, 2⁻¹⁰²².
pub(super) const SHORTEST: f64 = f64::from_bits((1023 - 511) << 52);

/// An error unless a step is finite and at least the shortest one.
pub(super) fn check_step(step: f64) -> Result<(), SceneError> {
    if (SHORTEST..=f64::MAX).contains(&step) {
        Ok(())
    } else {
        let value = step;
        Err(SceneError::Step { value })
    }
}

/// An error unless steps of a scheme, and of the one that it uses first, can be controlled with a tolerance.
pub(super) fn check_tolerance(
    tolerance: &Tolerance,
    (scheme, in_use): (Scheme, Scheme),
) -> Result<(), SceneError> {
    if scheme.may_change_steps() {
        return tolerance.check(in_use.accuracy());
    }
    let scheme = scheme.name();
    Err(SceneError::FixedSteps { scheme })
}

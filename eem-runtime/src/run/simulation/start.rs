//! The rules for the scheme and the step of a run, and the initial state of its scene.

use crate::algebra::vector;
use crate::element::conduction::Conduction;
use crate::element::ends::Ends;
use crate::element::group::{ElementTotals, Elements};
use crate::element::handle::{Element, Node};
use crate::element::layout::{Layout, Shape};
use crate::element::masses::Masses;
use crate::element::meters::Meters;
use crate::element::state::{Energy, State};
use crate::run::ledger::Ledger;
use crate::scene::entry::ElementEntry;
use crate::scene::error::{RocketError, SceneError};
use crate::scene::loads::{Course, SceneLoads, Written};
use crate::scene::plan::{Groups, Plan};
use crate::scene::solid_error::SolidError;
use crate::step::automatic::FIRST;
use crate::step::control::Tolerance;
use crate::step::explicit::Site;
use crate::step::features::Feature;
use crate::step::scheme::{Closing, Scheme};
use crate::step::solver::Effort;
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::derivative::{derivative, shares};

/// The initial state, without entropies, in the memory of one with as many entries if there is some: with velocities if the first
/// step, s, is given, else at rest. Errors for motions without an initial velocity.
pub(crate) fn initial_state(
    scene: &Plan,
    layout: &Layout,
    step: Option<f64>,
    used: Option<Box<State>>,
) -> Result<Box<State>, Vec<SceneError>> {
    let coordinates = scene.entries.positions.len();
    let is_coupled = !scene.entries.pairs.is_empty();
    let velocities = if is_coupled { coordinates } else { 0 };
    let counts = [coordinates, velocities, scene.reservoirs.len()];
    let mut state = cleared_state(counts, layout, used);
    state.time = Sum::new(scene.start);
    set_internal(&scene.entries.elements, layout, &mut state);
    let moves = step.is_some();
    (state.positions).write(|all| all.copy_from_slice(&scene.entries.positions));
    state.momenta.write(|all| {
        write_points(
            all,
            scene,
            &|node, own| match scene.entries.nodes[node].mass {
                Some(mass) if moves => scene.find_momentum(node, mass, own),
                _ => own.fill(0.0),
            },
        );
    });
    let mut errors = Vec::new();
    if is_coupled {
        state.velocities.write(|all| {
            write_points(
                all,
                scene,
                &|node, own| match scene.entries.nodes[node].mass {
                    Some(_) if moves => own.copy_from_slice(scene.velocity(node)),
                    _ => own.fill(0.0),
                },
            );
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
fn write_points(all: &mut [f64], scene: &Plan, write: &dyn Fn(usize, &mut [f64])) {
    for (node, own) in all.chunks_exact_mut(scene.dimension()).enumerate() {
        write(node, own);
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
pub(super) fn find_entropies(
    elements: &mut [&mut dyn Elements],
    state: &mut State,
    site: Site<'_>,
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
        let infinite = ledger.infinite_entry(state, site.loads.dimension());
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

/// How the parts of a scene are numbered and joined.
pub(super) struct Outline {
    pub(super) masses: Masses,
    /// The nodes of the elements.
    ends: Ends,
    pub(super) places: Vec<[u32; 2]>,
    pub(super) shapes: Vec<Shape>,
    pub(super) layout: Layout,
    pub(super) conduction: Conduction,
}

impl Outline {
    pub(super) fn new(scene: &Plan, shapes: Vec<Shape>) -> Self {
        let (masses, places) = (scene.masses(), scene.places());
        let (layout, conduction) = scene.numbering(&masses, (&places, &shapes));
        Self {
            masses,
            ends: scene.ends(),
            places,
            shapes,
            layout,
            conduction,
        }
    }

    /// The same, for a scheme.
    pub(super) fn site<'a>(&'a self, loads: &'a SceneLoads) -> Site<'a> {
        Site {
            masses: &self.masses,
            elements: &self.ends,
            layout: &self.layout,
            conduction: &self.conduction,
            loads,
        }
    }
}

/// What a run has before its first step, except for entropies.
pub(super) struct FirstState {
    pub(super) effort: Effort,
    pub(super) state: Box<State>,
    /// Memory for another state, if there is some.
    pub(super) next: Option<Box<State>>,
}

/// What is left of another run of the same kind.
pub(super) struct Used {
    pub(super) effort: Effort,
    pub(super) state: Box<State>,
    pub(super) next: Box<State>,
}

impl FirstState {
    /// With velocities for this first step, s.
    pub(super) fn new(
        scene: &Plan,
        outline: &Outline,
        step: f64,
        used: Option<Used>,
    ) -> Result<Self, Vec<SceneError>> {
        let (effort, state, next) = match used {
            Some(used) => (used.effort, Some(used.state), Some(used.next)),
            None => (Effort::new(), None, None),
        };
        let mut state = initial_state(scene, &outline.layout, Some(step), state)?;
        state.follow_velocities(scene.dimension(), &outline.masses);
        Ok(Self {
            effort,
            state,
            next,
        })
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
    pub(super) fn of(scene: &Plan, groups: &dyn Groups, shapes: &[Shape]) -> Self {
        let mut elements = scene.entries.elements.iter();
        let has_drag = |shape: &Shape| shape.drag;
        let drag = elements.position(|entry| shapes.get(entry.group).is_some_and(has_drag));
        Self {
            has_solids: shapes.iter().any(|shape| !shape.is_spring),
            rocket: scene.loads.rockets.first().map(|rocket| rocket.line.node),
            drag: drag.map(|index| scene.element_at(index, groups)),
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

    /// Adds the errors of a run with these schemes, set and in use, and its steps.
    pub(super) fn check_run(
        &self,
        schemes: (Scheme, Scheme),
        (step, tolerance): (f64, Option<Tolerance>),
        errors: &mut Vec<SceneError>,
    ) {
        errors.extend(self.check(schemes.1).err());
        errors.extend(check_step(step).err());
        let checked = tolerance.map_or(Ok(()), |own| check_tolerance(&own, schemes));
        errors.extend(checked.err());
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

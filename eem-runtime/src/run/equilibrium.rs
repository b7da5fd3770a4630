//! Loaded states at rest, to start runs from.

mod heat;
pub(crate) mod motion;

use crate::algebra::ascending;
use crate::element::conduction::Conduction;
use crate::element::conjugates::{Conjugates, OneSet, PointRule};
use crate::element::ends::Ends;
#[cfg(not(test))]
use crate::element::group::springs::of_dimension;
use crate::element::group::{Placed, StepView};
use crate::element::handle::Node;
use crate::element::layout::{Layout, Shape};
use crate::element::loads::{Prescribed, StepLoads};
use crate::element::masses::Masses;
use crate::element::phase::Phase;
use crate::element::state::State;
use crate::run::simulation::start::initial_state;
use crate::scene::Scene;
use crate::scene::entry::{self, ElementEntry};
use crate::scene::error::SceneError;
use crate::scene::plan::{Entries, Groups, Plan};
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;
use crate::step::solver::Solver;
use crate::step::solver::rest::{AtRest, LONG, Softest};
use crate::step::systems::Systems;
use motion::{EquilibriumError, FreeMotion, LIKENESS, Moved};

/// How to find a loaded state at rest, see [`Scene::equilibrium`].
///
/// ```
/// use eem::materials::MaxwellDamper;
/// use eem::prelude::*;
///
/// let damper = MaxwellDamper {
///     stiffness: 100.0, coupling: 0.0, capacity: 2.0, natural_length: 1.0,
///     theta_ref: 300.0, a: 0.0, mu: 40.0, eta: 20.0,
/// };
/// let mut scene = Scene::<1>::new();
/// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [0.0])];
/// let damper = scene.spring(damper, ends);
/// scene.set_temperature(damper, 300.0);
/// // The force of the spring alone, 100 J ln λ/λ, and with 40 N/m (λ − 1) of the branch, at λ = 1.1 m.
/// let spring = 100.0 * 1.1_f64.ln() / 1.1;
/// for (settings, load) in [
///     (Equilibrium::new().relaxed(), spring),
///     (Equilibrium::new().held(), spring + 4.0),
/// ] {
///     let mut scene = scene.clone();
///     scene.dead_load(ends[1], [load]);
///     scene.equilibrium(settings)?;
///     let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
///     assert!((run.stretch(damper)? - 1.1).abs() < 1e-14);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium {
    phase: Phase,
    balances_heat: bool,
    load_steps: u32,
    newton: NewtonSettings,
}

impl Default for Equilibrium {
    fn default() -> Self {
        Self::new()
    }
}

impl Equilibrium {
    /// Dashpots relaxed, temperatures as they are, in four load steps.
    #[must_use]
    pub fn new() -> Self {
        Self {
            phase: Phase::Relaxed,
            balances_heat: false,
            load_steps: 4,
            newton: NewtonSettings::default(),
        }
    }

    /// Dashpots have crept until they have no force, `∂ψ/∂γ = 0`: the state after a long time.
    #[must_use]
    pub fn relaxed(self) -> Self {
        let phase = Phase::Relaxed;
        Self { phase, ..self }
    }

    /// Viscous stretches and strains stay as they are: the state right after the loads are applied, in which dashpots still
    /// have forces.
    #[must_use]
    pub fn held(self) -> Self {
        let phase = Phase::Held;
        Self { phase, ..self }
    }

    /// Temperatures are those at which every element receives as much heat as it gives, through its paths to other
    /// elements and to reservoirs. Elements with thermostats and elements without paths keep theirs.
    #[must_use]
    pub fn thermal_balance(self) -> Self {
        Self {
            balances_heat: true,
            ..self
        }
    }

    /// The number of load steps, 4 by default. A load step that fails is halved.
    #[must_use]
    pub fn load_steps(self, load_steps: u32) -> Self {
        Self { load_steps, ..self }
    }

    /// Settings of Newton's method: the largest update that can be the last one, relative to the lengths of elements, and the
    /// maximum number of iterations of a load step. A motion against friction has at most ten times as many steps.
    #[must_use]
    pub fn newton(self, newton: NewtonSettings) -> Self {
        Self { newton, ..self }
    }

    fn check(&self) -> Result<(), EquilibriumError> {
        let iterations = u32::from(self.newton.max_iterations > 0);
        let settings = [
            ("number of load steps", f64::from(self.load_steps)),
            ("tolerance", self.newton.tolerance),
            ("number of iterations", f64::from(iterations)),
        ];
        let mut settings = settings.into_iter();
        match settings.find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
            None => Ok(()),
            Some((name, value)) => Err(EquilibriumError::Setting { name, value }),
        }
    }
}

/// How a state at rest was found.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct EquilibriumReport {
    /// The largest component of a force out of balance, N.
    pub residual: f64,
    /// The node with that force; `None` without moving nodes.
    pub node: Option<Node>,
    /// The largest heat that an element still receives, W; zero unless temperatures are in thermal balance.
    pub heat: f64,
    /// The share of the loads up to which states at rest were followed: 1, or less if the state was then found by motion
    /// against friction.
    pub followed: f64,
    /// The number of load steps.
    pub load_steps: usize,
    /// The number of Newton iterations in all load steps.
    pub iterations: usize,
    /// The number of steps of the motion against friction.
    pub friction_steps: usize,
}

/// The function that finds an equilibrium. In one to three dimensions it is compiled with this crate, else where it is used.
#[cfg(not(test))]
type Find<const D: usize> =
    fn(&mut Scene<D>, Equilibrium) -> Result<EquilibriumReport, EquilibriumError>;

#[cfg(not(test))]
static LINE: Find<1> = Scene::find_equilibrium;
#[cfg(not(test))]
static PLANE: Find<2> = Scene::find_equilibrium;
#[cfg(not(test))]
static SPACE: Find<3> = Scene::find_equilibrium;

/// # Equilibrium
impl<const D: usize> Scene<D> {
    /// Moves the scene into a stable state at rest under its loads at the start, to start a run from.
    ///
    /// ```text
    /// Σ ∂ψ/∂q = m g + F(t₀) + thrust(t₀) n(q),   v = 0
    /// ```
    ///
    /// Positions of masses become those of this state, velocities zero. Viscous stretches are [relaxed](Equilibrium::relaxed) or
    /// [held](Equilibrium::held); temperatures stay, or come into [thermal balance](Equilibrium::thermal_balance). Anchors stay.
    /// Dashpots in parallel with springs have no force at rest.
    ///
    /// The state is the one that is connected with the present positions by the load path: forces that are not balanced
    /// there are released in [load steps](Equilibrium::load_steps), and solutions are followed as long as they are stable,
    /// that is, as long as the tangent stiffness is positive definite beyond rounding. Where it is not, as in a slack chain
    /// at first, or where a frame snaps through, the scene moves on under all its loads against friction until it is at
    /// rest, without inertia: against friction in proportion to the stiffness, and if that finds no stable state, from the start in
    /// proportion to the masses. So the state that is returned is always stable.
    /// With [rockets](Self::rocket) the tangent is not symmetric, and its symmetric part decides.
    ///
    /// # Errors
    ///
    /// [`EquilibriumError`]; the scene is unchanged then. The error names the nodes of a motion that no force resists, or along
    /// which the state is unstable.
    ///
    /// ```
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let ends = [scene.anchor([0.0, 0.0]), scene.mass(2.0, [0.0, -1.0], [0.0, 0.0])];
    /// scene.spring(Hooke { stiffness: 100.0, natural_length: 1.0 }, ends);
    /// scene.set_gravity([0.0, -10.0]);
    /// assert!(scene.equilibrium(Equilibrium::new())?.residual < 1e-12);
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// // 20 N stretch it by 0.2 m, and there it stays.
    /// run.step()?;
    /// assert!((run.position(ends[1])?[1] + 1.2).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn equilibrium(
        &mut self,
        settings: Equilibrium,
    ) -> Result<EquilibriumReport, EquilibriumError> {
        // A branch that a constant rules out is not compiled.
        #[cfg(not(test))]
        if const { 0 < D && D < 4 } {
            let find: &Find<D> = of_dimension(D, [&LINE, &PLANE, &SPACE]);
            return find(self, settings);
        }
        self.find_equilibrium(settings)
    }

    fn find_equilibrium(
        &mut self,
        settings: Equilibrium,
    ) -> Result<EquilibriumReport, EquilibriumError> {
        settings.check()?;
        let shapes = self.shapes();
        let mut problem = self.plan.problem(&self.groups, &shapes, settings)?;
        let (next, report) = self.find_rest(settings, &mut problem)?;
        self.plan.take_state(&self.groups, &problem.layout, &next);
        Ok(EquilibriumReport {
            heat: problem.heat,
            ..report
        })
    }

    fn find_rest(
        &self,
        settings: Equilibrium,
        problem: &mut Problem,
    ) -> Result<(State, EquilibriumReport), EquilibriumError> {
        let refuse = |errors: Vec<SceneError>| EquilibriumError::Scene { errors };
        let (layout, nodes) = (&problem.layout, &problem.ends);
        // The rows of this scheme are `2 m/h Δq − 2 p⁰ + h F`; at rest only h F is left.
        let scheme = Scheme::Midpoint;
        let (rockets, limit) = (self.plan.loads.rocket_lines(), self.plan.memory_limit);
        let conduction = &problem.conduction;
        let systems = Systems::new(scheme, (nodes, layout), conduction, &rockets, limit);
        let systems = systems.map_err(|error| refuse(vec![error.into()]))?;
        let by = Conjugates::One(OneSet::Point(PointRule::Rest));
        let mut groups = Vec::with_capacity(self.groups.len());
        let mut errors = Vec::new();
        for group in &self.groups {
            let mut group = group.duplicate().build(by, Placed { nodes, layout });
            let elements = group.elements_mut();
            elements.initialize(&mut problem.state, &mut |error| errors.push(error.into()));
            groups.push(group);
        }
        if !errors.is_empty() {
            return Err(refuse(errors));
        }
        let (masses, loads) = (&problem.masses, &problem.loads);
        let mut solver = Solver::new(scheme, systems, masses, layout, conduction, loads);
        for group in &mut groups {
            group.connect(&solver.sites(layout, conduction));
        }
        let view = StepView {
            phase: settings.phase,
            step: LONG,
            per_step: 0.0,
            state: &problem.state,
            conduction,
            loads,
            stages: &[],
            masses,
        };
        let how = (settings.newton, arms(&self.plan.entries.elements));
        let rest = AtRest::new(&mut solver, &mut groups, &view, how);
        let mut rest = rest.map_err(EquilibriumError::Start)?;
        (self.plan).follow(&mut rest, settings.load_steps, &problem.state)
    }
}

/// What is to come to rest. Temperatures are no unknowns.
struct Problem {
    masses: Masses,
    layout: Layout,
    ends: Ends,
    state: State,
    /// The largest heat that an element receives, W.
    heat: f64,
    conduction: Conduction,
    loads: StepLoads,
}

impl Plan {
    fn problem(
        &self,
        groups: &dyn Groups,
        shapes: &[Shape],
        settings: Equilibrium,
    ) -> Result<Problem, EquilibriumError> {
        let errors = self.check(groups);
        if !errors.is_empty() {
            return Err(EquilibriumError::Scene { errors });
        }
        let masses = self.masses();
        let layout = entry::layout(self.dimension(), &masses, (&self.places(), shapes));
        let state = initial_state(self, &layout, None, None);
        let mut state = state.map_err(|errors| EquilibriumError::Scene { errors })?;
        let heat = if settings.balances_heat {
            heat::balance(self, groups, &layout, &mut state.temperatures)?
        } else {
            0.0
        };
        let mut loads = StepLoads::new(self.entries.positions.len(), &layout, &self.loads, false);
        let evaluated = loads.evaluate_forces_at(&self.loads, &masses, self.start);
        evaluated.map_err(EquilibriumError::Start)?;
        let held = state.temperatures.iter().map(|&theta| Prescribed {
            middle: theta,
            end: theta,
        });
        loads.prescribed = held.map(Some).collect();
        Ok(Problem {
            conduction: Conduction::new(&[], Vec::new(), &layout),
            ends: self.ends(),
            state: *state,
            masses,
            layout,
            heat,
            loads,
        })
    }

    fn follow(
        &self,
        rest: &mut AtRest<'_>,
        load_steps: u32,
        state: &State,
    ) -> Result<(State, EquilibriumReport), EquilibriumError> {
        let (followed, found) = rest.follow(load_steps);
        let ((residual, node), forces) = (rest.residual(), rest.forces());
        let node = node.map(|node| self.node_at(node));
        if !rest.is_stable()
            && let Some(softest) = rest.softest()
        {
            let is_free = softest.relative.abs() <= softest.rounding;
            // A motion that nothing starts, though the scene would leave along it.
            let is_left = softest.share_of(&forces) <= LIKENESS;
            if is_free || found.is_ok() || is_left {
                let motion = self.name(rest, &softest);
                return Err(if is_free {
                    EquilibriumError::Free { motion }
                } else {
                    EquilibriumError::Unstable { motion, followed }
                });
            }
        }
        let refuse = |failure| EquilibriumError::NotFound {
            node,
            residual,
            followed,
            failure: Box::new(failure),
        };
        found.map_err(refuse)?;
        let mut next = state.clone();
        rest.close(&mut next).map_err(refuse)?;
        let effort = rest.effort;
        let report = EquilibriumReport {
            residual,
            node,
            heat: 0.0,
            followed,
            load_steps: effort.load_steps,
            iterations: effort.iterations,
            friction_steps: effort.friction_steps,
        };
        Ok((next, report))
    }

    fn name(&self, rest: &AtRest<'_>, softest: &Softest) -> FreeMotion {
        let mut displacements = vec![0.0; self.entries.positions.len()];
        for (&node, by) in softest
            .nodes
            .iter()
            .zip(softest.motion.chunks_exact(self.dimension()))
        {
            displacements[node * self.dimension()..][..self.dimension()].copy_from_slice(by);
        }
        let moved = Moved {
            dimension: self.dimension(),
            positions: &rest.positions(),
            displacements: &displacements,
            elements: &self.entries.elements,
            is_mass: &|node| self.entries.nodes[node].mass.is_some(),
            node_at: &|node| self.node_at(node),
        };
        moved.name(softest.stiffness)
    }

    /// Takes over positions, temperatures and viscous stretches, at rest.
    fn take_state(&mut self, groups: &dyn Groups, layout: &Layout, state: &State) {
        let dimension = self.dimension();
        let Entries {
            nodes,
            positions,
            velocities,
            elements,
            ..
        } = &mut self.entries;
        for (index, node) in nodes.iter_mut().enumerate() {
            if node.mass.is_some() {
                let own = index * dimension..(index + 1) * dimension;
                positions[own.clone()].copy_from_slice(&state.positions.values()[own.clone()]);
                velocities[own].fill(0.0);
                node.momentum = None;
            }
        }
        for (entry, slots) in elements.iter_mut().zip(&layout.elements) {
            if let Some(slot) = slots.thermal {
                entry.temperature = Some(state.temperatures[slot]);
            }
            let dashpots = groups.shape(entry.group).map_or(0, |shape| shape.dashpots);
            let viscous = &state.viscous.values()[slots.viscous..][..dashpots];
            entry.viscous_stretches = viscous.iter().copied().enumerate().collect();
        }
    }
}

/// The edges of all elements from their first node to the others, each once, as pairs of nodes.
fn arms(elements: &[ElementEntry]) -> Vec<[usize; 2]> {
    let mut arms = Vec::new();
    for entry in elements {
        if let [first, others @ ..] = &entry.nodes[..] {
            arms.extend(others.iter().map(|other| [*first, *other]));
        }
    }
    ascending(arms)
}

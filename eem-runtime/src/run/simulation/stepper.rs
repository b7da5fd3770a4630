//! The elements of a scene with the solver of its scheme.

use crate::algebra::memory::{MemoryLimit, TooLarge};
use crate::element::group::{Elements, ExplicitGroup, Group, Loose, Placed, StepView};
use crate::element::loads::StepLoads;
use crate::element::phase::Phase;
use crate::element::state::State;
use crate::element::tableau::Tableau;
use crate::scene::error::SceneError;
use crate::step::error::StepFailure;
use crate::step::explicit::{Explicit, Site, View};
use crate::step::outcome::Attempt;
use crate::step::scheme::{Closing, Scheme};
use crate::step::solver::{Effort, Solver};
use crate::step::systems::Systems;

/// The elements of a scene without a scheme, a set per model.
type Models<const D: usize> = Vec<Box<dyn Loose<D>>>;

/// What is done with the elements in their initial state before memory for the solver is reserved.
type Begin<'a, const D: usize> =
    &'a mut dyn FnMut(&mut State, &mut [&mut dyn Elements]) -> Result<(), Vec<SceneError>>;

/// What becomes of each of these.
pub(super) fn each<T, U>(all: Vec<T>, mut change: impl FnMut(T) -> U) -> Vec<U> {
    let mut changed = Vec::with_capacity(all.len());
    for own in all {
        changed.push(change(own));
    }
    changed
}

/// The solver of a scheme with the elements of a scene.
pub(super) enum Stepper<const D: usize> {
    /// Newton's method.
    Newton(Box<Newton<D>>),
    /// An explicit scheme.
    Explicit(Box<Explicit<D>>),
}

/// Elements, loads and solver of an implicit scheme.
pub(super) struct Newton<const D: usize> {
    pub(super) groups: Vec<Box<dyn Group<D>>>,
    pub(super) solver: Solver<D>,
    /// The loads of the step.
    pub(super) loads: StepLoads,
    /// The loads at its stages, if the scheme has several.
    pub(super) stages: Vec<StepLoads>,
    /// The intermediate state of the staggered scheme.
    pub(super) intermediate: Option<State>,
}

/// What a solver is made of.
#[expect(clippy::large_enum_variant, reason = "it is used at once")]
pub(super) enum Memory<const D: usize> {
    /// Linear systems that have not been used.
    New(Systems<D>),
    /// Those of a scene that differs in numbers only: see [`Solver::renew`].
    Used(Box<Newton<D>>),
}

impl<const D: usize> Memory<D> {
    /// The linear systems of a scheme for a scene.
    pub(super) fn new(
        scheme: Scheme,
        site: Site<'_>,
        limit: MemoryLimit,
    ) -> Result<Self, TooLarge> {
        let elements = (site.elements, site.layout);
        let rockets = site.loads.rocket_lines();
        let systems = Systems::new(scheme, elements, site.conduction, &rockets, limit)?;
        Ok(Self::New(systems))
    }
}

impl<const D: usize> Stepper<D> {
    /// A stepper for elements in a state. `begin` is called with the elements before memory for the solver is reserved; if it
    /// fails, the elements are returned.
    pub(super) fn new(
        elements: Models<D>,
        memory: Memory<D>,
        (scheme, site): (Scheme, Site<'_>),
        state: &mut State,
        begin: Begin<'_, D>,
    ) -> Result<Self, (Vec<SceneError>, Models<D>)> {
        let placed = Placed {
            nodes: site.elements,
            layout: site.layout,
        };
        let mut all = Vec::with_capacity(elements.len());
        if scheme.closing() == Closing::Explicit {
            let mut groups = each(elements, |elements| elements.build_explicit(placed));
            for group in &mut groups {
                all.push(group.elements_mut());
            }
            if let Err(errors) = begin(state, &mut all) {
                return Err((errors, each(groups, ExplicitGroup::into_loose)));
            }
            return Ok(Self::Explicit(Box::new(Explicit::new(groups, site))));
        }
        let by = scheme.conjugates();
        let mut groups = each(elements, |elements| elements.build(by, placed));
        for group in &mut groups {
            all.push(group.elements_mut());
        }
        if let Err(errors) = begin(state, &mut all) {
            return Err((errors, each(groups, Group::into_loose)));
        }
        let newton = Newton::new(groups, memory, (scheme, site), state);
        Ok(Self::Newton(newton))
    }

    pub(super) fn explicit(&mut self) -> Option<&mut Explicit<D>> {
        match self {
            Self::Newton(_) => None,
            Self::Explicit(explicit) => Some(explicit),
        }
    }

    /// Calls a function with each group.
    pub(super) fn each_mut(&mut self, mut visit: impl FnMut(&mut dyn Elements)) {
        match self {
            Self::Newton(newton) => {
                for group in &mut newton.groups {
                    visit(group.elements_mut());
                }
            }
            Self::Explicit(explicit) => explicit.each_mut(&mut visit),
        }
    }
}

impl<const D: usize> Newton<D> {
    fn new(
        groups: Vec<Box<dyn Group<D>>>,
        memory: Memory<D>,
        (scheme, site): (Scheme, Site<'_>),
        state: &State,
    ) -> Box<Self> {
        let (masses, layout, conduction) = (site.masses, site.layout, site.conduction);
        let (coordinates, is_coupled) = (masses.len() * D, masses.are_coupled());
        let mut newton = match memory {
            Memory::New(systems) => {
                let loads = StepLoads::new(coordinates, layout, site.loads, is_coupled);
                let stages = scheme.tableau().map_or(0, Tableau::stages);
                Box::new(Self {
                    groups,
                    solver: Solver::new(scheme, systems, masses, layout, conduction, &loads),
                    stages: vec![loads.clone(); stages],
                    loads,
                    intermediate: scheme.is_split().then(|| state.clone()),
                })
            }
            // Weights are found in every step.
            Memory::Used(mut newton) => {
                newton.solver.renew(masses);
                newton.groups = groups;
                if let Some(intermediate) = &mut newton.intermediate {
                    intermediate.copy_all_from(state);
                }
                newton
            }
        };
        for group in &mut newton.groups {
            group.connect(&newton.solver.sites(layout, conduction));
        }
        newton
    }

    /// Writes the state after a step.
    pub(super) fn step(
        &mut self,
        start: &View<'_>,
        effort: &mut Effort,
        next: &mut State,
    ) -> Result<Attempt, StepFailure> {
        let loads = (&self.loads, &self.stages[..]);
        let (groups, solver) = (&mut self.groups, &mut self.solver);
        let Some(intermediate) = &mut self.intermediate else {
            let view = view_of(start, Phase::Whole, start.state, loads);
            return Ok(Attempt::made(solver.solve(groups, &view, effort, next)?));
        };
        let view = view_of(start, Phase::Mechanics, start.state, loads);
        let motion = *solver.solve(groups, &view, effort, intermediate)?;
        let view = view_of(start, Phase::Heat, intermediate, loads);
        let mut whole = motion.and(*solver.solve(groups, &view, effort, next)?);
        if whole.is_bound_wide() {
            whole.find_terms(groups, [start.state, next]);
        }
        Ok(Attempt::made(&whole))
    }

    /// Residual and tangent of a step at given unknowns.
    pub(super) fn linearize(
        &mut self,
        start: &View<'_>,
        unknowns: &[f64],
        effort: &mut Effort,
    ) -> Result<(Vec<f64>, Vec<f64>), StepFailure> {
        let loads = (&self.loads, &self.stages[..]);
        let view = view_of(start, Phase::Whole, start.state, loads);
        let groups = &mut self.groups;
        self.solver.linearize(groups, &view, unknowns, effort)
    }
}

/// Evaluates the loads of a step, and those at its stages if the scheme has several.
pub(super) fn evaluate_loads(
    (whole, stages): (&mut StepLoads, &mut [StepLoads]),
    start: &View<'_>,
    scheme: Scheme,
) -> Result<(), StepFailure> {
    let (loads, masses, old) = (start.loads, start.masses, start.state);
    let (time, step) = (old.time.value, start.step);
    let span = [time, step];
    let Some(rule) = scheme.tableau() else {
        return whole.evaluate(loads, masses, span, old);
    };
    whole.evaluate_supports(loads, (span, 1.0), old)?;
    for (stage, &share) in stages.iter_mut().zip(rule.times) {
        let time = loads.inside(span, time + share * step);
        stage.evaluate_forces_at(loads, masses, time)?;
    }
    // The paths of elements have their own times for supports.
    let supports = rule.path.map_or(rule.times, |path| path.supports.times);
    for (stage, &share) in stages.iter_mut().zip(supports) {
        stage.evaluate_supports(loads, ([time, share * step], share), old)?;
    }
    Ok(())
}

/// The data shared by all elements during a step.
#[inline]
fn view_of<'a>(
    start: &View<'a>,
    phase: Phase,
    state: &'a State,
    (loads, stages): (&'a StepLoads, &'a [StepLoads]),
) -> StepView<'a> {
    StepView {
        phase,
        step: start.step,
        per_step: start.step.recip(),
        state,
        conduction: start.conduction,
        loads,
        stages,
        masses: start.masses,
    }
}

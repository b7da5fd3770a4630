//! The elements of a scene with the solver of its scheme.

use core::mem;

use crate::algebra::memory::{MemoryLimit, TooLarge};
use crate::element::group::{Elements, ExplicitGroup, Group, Loose, Placed};
use crate::element::loads::StepLoads;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::element::tableau::Tableau;
use crate::scene::error::SceneError;
use crate::scene::loads::Loads;
use crate::step::error::StepFailure;
use crate::step::explicit::{Explicit, SavedExplicit, Site};
use crate::step::scheme::{Closing, Scheme};
use crate::step::solver::{SavedPast, Solver};
use crate::step::systems::Systems;

/// The elements of a scene without a scheme, a set per model.
type Models<const D: usize> = Vec<Box<dyn Loose<D>>>;

/// What is done with the elements in their initial state before memory for the solver is reserved.
type Begin<'a, const D: usize> =
    &'a mut dyn FnMut(&mut State, &mut [&mut dyn Elements<D>]) -> Result<(), Vec<SceneError>>;

/// What becomes of each of these.
fn each<T, U>(all: Vec<T>, mut change: impl FnMut(T) -> U) -> Vec<U> {
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
        site: Site<'_, D>,
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
        (scheme, site): (Scheme, Site<'_, D>),
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

    /// Takes the elements out of the stepper, which cannot step afterwards.
    pub(super) fn take_elements(&mut self) -> Models<D> {
        match self {
            Self::Newton(newton) => each(mem::take(&mut newton.groups), Group::into_loose),
            Self::Explicit(explicit) => explicit.take_elements(),
        }
    }

    /// How often all elements have been evaluated, at all stages.
    pub(super) fn evaluations(&self) -> u64 {
        match self {
            Self::Newton(newton) => {
                let stages = u64::try_from(newton.stages.len().max(1)).unwrap_or(u64::MAX);
                newton.solver.evaluations().saturating_mul(stages)
            }
            Self::Explicit(explicit) => explicit.evaluations(),
        }
    }

    /// The history on which the step from this state depends.
    pub(super) fn past(&self, state: &State) -> (SavedPast, Option<SavedExplicit>) {
        match self {
            Self::Newton(newton) => (newton.solver.past(), None),
            Self::Explicit(explicit) => (SavedPast::none(), Some(explicit.save(state))),
        }
    }

    /// Overwrites a saved history of Newton's method.
    pub(super) fn save_past_to(&self, past: &mut SavedPast) {
        if let Self::Newton(newton) = self {
            newton.solver.save_past_to(past);
        }
    }

    /// Continues from a saved history.
    pub(super) fn restore(&mut self, past: &SavedPast, saved: Option<&SavedExplicit>) {
        match self {
            Self::Newton(newton) => newton.solver.restore(past),
            Self::Explicit(explicit) => match saved {
                Some(saved) => explicit.restore(saved),
                None => explicit.forget(),
            },
        }
    }

    /// Undoes the effect of the last step on the history.
    pub(super) fn undo(&mut self) {
        match self {
            Self::Newton(newton) => newton.solver.undo(),
            Self::Explicit(explicit) => explicit.undo(),
        }
    }

    /// A group.
    pub(super) fn elements(&self, group: usize) -> &dyn Elements<D> {
        match self {
            Self::Newton(newton) => newton.groups[group].elements(),
            Self::Explicit(explicit) => explicit.elements(group),
        }
    }

    /// All groups.
    pub(super) fn all(&self) -> impl Iterator<Item = &dyn Elements<D>> {
        let groups = match self {
            Self::Newton(newton) => newton.groups.len(),
            Self::Explicit(explicit) => explicit.groups(),
        };
        (0..groups).map(|group| self.elements(group))
    }

    /// Calls a function with each group.
    pub(super) fn each_mut(&mut self, mut visit: impl FnMut(&mut dyn Elements<D>)) {
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
        (scheme, site): (Scheme, Site<'_, D>),
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

    /// Evaluates the loads of the step from `time` by `step`, from the old state.
    pub(super) fn evaluate_loads(
        &mut self,
        loads: &Loads<D>,
        masses: &Masses,
        scheme: Scheme,
        [time, step]: [f64; 2],
        old: &State,
    ) -> Result<(), StepFailure> {
        let span = [time, step];
        let Some(rule) = scheme.tableau() else {
            return self.loads.evaluate(loads, masses, span, old);
        };
        self.loads.evaluate_supports(loads, (span, 1.0), old)?;
        for (stage, &share) in self.stages.iter_mut().zip(rule.times) {
            let time = loads.inside(span, time + share * step);
            stage.evaluate_forces_at(loads, masses, time)?;
        }
        // The paths of elements have their own times for supports.
        let supports = rule.path.map_or(rule.times, |path| path.supports.times);
        for (stage, &share) in self.stages.iter_mut().zip(supports) {
            stage.evaluate_supports(loads, ([time, share * step], share), old)?;
        }
        Ok(())
    }
}

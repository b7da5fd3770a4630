//! What steps a scene: its elements, what acts on them, and the solver.

use core::mem;

use super::groups::Groups;
use crate::algebra::system::MOST_FIXED;
use crate::element::conduction::Conduction;
use crate::element::group::{Elements, Group, Loose};
use crate::element::layout::Layout;
use crate::element::loads::StepLoads;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::element::tableau::Tableau;
use crate::scene::entry::ElementEntry;
use crate::scene::loads::Loads;
use crate::step::error::StepFailure;
use crate::step::explicit::{Explicit, SavedExplicit, Site};
use crate::step::scheme::Scheme;
use crate::step::solver::{SavedPast, Solver};
use crate::step::systems::Systems;
use eem_material::number::scalar::Real;

/// What steps a scene.
pub(super) enum Stepper<S: Real, const D: usize> {
    /// Newton's method.
    Newton(Box<Newton<S, D>>),
    /// An explicit scheme.
    Explicit(Box<Explicit<S, D>>),
}

/// Elements, loads and solver of a scene.
pub(super) struct Newton<S: Real, const D: usize> {
    pub(super) groups: Vec<Box<dyn Group<S, D>>>,
    pub(super) solver: Solver<S, D>,
    /// What acts in the next step.
    pub(super) loads: StepLoads<S>,
    /// What acts at the times of its stages, if the scheme has some.
    pub(super) stages: Vec<StepLoads<S>>,
    /// The state between the two parts of a step of the staggered scheme.
    pub(super) between: Option<State<S>>,
}

/// What a stepper is made from, besides its groups.
#[derive(Clone, Copy)]
pub(super) struct Parts<'a, S: Real, const D: usize> {
    pub(super) scheme: Scheme,
    pub(super) masses: &'a Masses<S>,
    pub(super) elements: &'a Vec<ElementEntry<S>>,
    pub(super) layout: &'a Layout,
    pub(super) conduction: &'a Conduction<S>,
    pub(super) loads: &'a Loads<S, D>,
}

impl<S: Real, const D: usize> Stepper<S, D> {
    /// For groups in a state whose entropies are known, or still to be found, with the systems of the scheme.
    pub(super) fn new(
        groups: Groups<S, D>,
        systems: Systems<S, D>,
        parts: Parts<'_, S, D>,
        state: &State<S>,
    ) -> Self {
        match groups {
            Groups::Newton(groups) => {
                Self::Newton(Box::new(Newton::new(groups, systems, parts, state)))
            }
            Groups::Explicit(groups) => {
                let site = Site {
                    masses: parts.masses,
                    elements: parts.elements,
                    layout: parts.layout,
                    conduction: parts.conduction,
                    loads: parts.loads,
                };
                Self::Explicit(Box::new(Explicit::new(groups, site)))
            }
        }
    }

    /// Gives its elements away; it cannot step any more.
    pub(super) fn take_elements(&mut self) -> Vec<Box<dyn Loose<S, D>>> {
        match self {
            Self::Newton(newton) => {
                let groups = mem::take(&mut newton.groups).into_iter();
                groups.map(Group::into_loose).collect()
            }
            Self::Explicit(explicit) => explicit.take_elements(),
        }
    }

    /// Whether an explicit scheme closes its steps by motion before heat.
    pub(super) fn is_motion_first(&self) -> bool {
        match self {
            Self::Newton(_) => false,
            Self::Explicit(explicit) => explicit.is_motion_first(),
        }
    }

    /// Chooses what closes the steps of an explicit scheme.
    pub(super) fn set_motion_first(&mut self, is_motion_first: bool) {
        if let Self::Explicit(explicit) = self {
            explicit.set_motion_first(is_motion_first);
        }
    }

    /// Number of sets of unknowns of an iteration.
    pub(super) fn sets(&self) -> usize {
        match self {
            Self::Newton(newton) => newton.solver.sets(),
            Self::Explicit(_) => 0,
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

    /// Whether several numbers in one S can go through a step of so many unknowns together.
    pub(super) fn suits_lanes(&self, unknowns: usize) -> bool {
        match self {
            Self::Newton(newton) => newton.stages.is_empty() && unknowns <= MOST_FIXED,
            Self::Explicit(_) => true,
        }
    }

    /// What the start of the step from this state depends on besides.
    pub(super) fn past(&self, state: &State<S>) -> (SavedPast<S>, Option<SavedExplicit<S>>) {
        match self {
            Self::Newton(newton) => (newton.solver.past(), None),
            Self::Explicit(explicit) => (SavedPast::none(), Some(explicit.save(state))),
        }
    }

    /// The past of Newton's method where it was saved before.
    pub(super) fn save_past_to(&self, past: &mut SavedPast<S>) {
        if let Self::Newton(newton) = self {
            newton.solver.save_past_to(past);
        }
    }

    /// Goes on from a saved past.
    pub(super) fn restore(&mut self, past: &SavedPast<S>, saved: Option<&SavedExplicit<S>>) {
        match self {
            Self::Newton(newton) => newton.solver.restore(past),
            Self::Explicit(explicit) => match saved {
                Some(saved) => explicit.restore(saved),
                None => explicit.forget(),
            },
        }
    }

    /// Takes back what the last step left for the next ones.
    pub(super) fn undo(&mut self) {
        match self {
            Self::Newton(newton) => newton.solver.undo(),
            Self::Explicit(explicit) => explicit.undo(),
        }
    }

    /// A group.
    pub(super) fn elements(&self, group: usize) -> &dyn Elements<S, D> {
        match self {
            Self::Newton(newton) => newton.groups[group].elements(),
            Self::Explicit(explicit) => explicit.elements(group),
        }
    }

    /// All groups.
    pub(super) fn all(&self) -> impl Iterator<Item = &dyn Elements<S, D>> {
        let groups = match self {
            Self::Newton(newton) => newton.groups.len(),
            Self::Explicit(explicit) => explicit.groups(),
        };
        (0..groups).map(|group| self.elements(group))
    }

    /// Does something with all groups.
    pub(super) fn each_mut(&mut self, mut visit: impl FnMut(&mut dyn Elements<S, D>)) {
        match self {
            Self::Newton(newton) => {
                for group in &mut newton.groups {
                    visit(group.elements_mut());
                }
            }
            Self::Explicit(explicit) => explicit.each_mut(visit),
        }
    }
}

impl<S: Real, const D: usize> Newton<S, D> {
    fn new(
        mut groups: Vec<Box<dyn Group<S, D>>>,
        systems: Systems<S, D>,
        parts: Parts<'_, S, D>,
        state: &State<S>,
    ) -> Self {
        let Parts {
            scheme,
            masses,
            layout,
            conduction,
            loads,
            ..
        } = parts;
        let memory = || StepLoads::new(masses.len() * D, layout, loads, masses.are_coupled());
        let stages = scheme.tableau().map_or(0, Tableau::stages);
        let whole = memory();
        let solver = Solver::new(scheme, systems, masses, layout, conduction, &whole);
        for group in &mut groups {
            group.connect(&solver.sites(layout, conduction));
        }
        Self {
            groups,
            solver,
            loads: whole,
            stages: (0..stages).map(|_| memory()).collect(),
            between: scheme.is_split().then(|| state.clone()),
        }
    }

    /// Evaluates the loads of the step from `time` by `step` at the positions `q0`.
    pub(super) fn evaluate_loads(
        &mut self,
        loads: &Loads<S, D>,
        masses: &Masses<S>,
        scheme: Scheme,
        [time, step]: [S; 2],
        q0: &[S],
    ) -> Result<(), StepFailure> {
        let span = [time, step];
        let Some(rule) = scheme.tableau() else {
            return self.loads.evaluate(loads, masses, span, q0);
        };
        self.loads.evaluate_supports(loads, span, q0)?;
        for (stage, &share) in self.stages.iter_mut().zip(rule.times) {
            stage.evaluate_forces_at(loads, masses, time + S::from_f64(share) * step)?;
        }
        // The path of an element looks at what is prescribed at times of its own.
        let supports = rule.path.map_or(rule.times, |path| path.supports.times);
        for (stage, &share) in self.stages.iter_mut().zip(supports) {
            stage.evaluate_supports(loads, [time, S::from_f64(share) * step], q0)?;
        }
        Ok(())
    }
}

//! What steps a scene: its elements, what acts on them, and the solver.

use crate::element::conduction::Conduction;
use crate::element::group::{Elements, Group};
use crate::element::layout::Layout;
use crate::element::loads::StepLoads;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::element::tableau::Tableau;
use crate::number::scalar::Real;
use crate::scene::entry::ElementEntry;
use crate::scene::error::SceneError;
use crate::scene::loads::Loads;
use crate::step::error::StepFailure;
use crate::step::scheme::Scheme;
use crate::step::solver::{SavedPast, Solver};

/// Elements, loads and solver of a scene.
pub(super) struct Stepper<S: Real, const D: usize> {
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
    pub(super) elements: &'a [ElementEntry<S>],
    pub(super) layout: &'a Layout,
    pub(super) conduction: &'a Conduction<S>,
    pub(super) loads: &'a Loads<S, D>,
}

impl<S: Real, const D: usize> Stepper<S, D> {
    /// Finds the entropies of an initial state, and gets ready.
    pub(super) fn new(
        mut groups: Vec<Box<dyn Group<S, D>>>,
        parts: Parts<'_, S, D>,
        state: &mut State<S>,
    ) -> Result<Self, SceneError> {
        for group in &mut groups {
            group.elements_mut().initialize(state)?;
        }
        let Parts {
            scheme,
            masses,
            elements,
            layout,
            conduction,
            loads,
        } = parts;
        let memory = || StepLoads::new(masses.len() * D, layout, loads);
        let stages = scheme.tableau().map_or(0, Tableau::stages);
        let whole = memory();
        let solver = Solver::new(scheme, masses, elements, layout, conduction, &whole);
        for group in &mut groups {
            group.connect(&solver.sites(layout, conduction));
        }
        Ok(Self {
            groups,
            solver,
            loads: whole,
            stages: (0..stages).map(|_| memory()).collect(),
            between: scheme.is_split().then(|| state.clone()),
        })
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
            return self.loads.evaluate(loads, masses, scheme, span, q0);
        };
        self.loads.evaluate_supports(loads, span, q0)?;
        for (stage, &share) in self.stages.iter_mut().zip(rule.times) {
            let at = [time + S::from_f64(share) * step, S::zero()];
            stage.evaluate(loads, masses, scheme, at, q0)?;
        }
        // The path of an element looks at what is prescribed at times of its own.
        let supports = rule.path.iter().flat_map(|path| path.supports.times);
        for (stage, &share) in self.stages.iter_mut().zip(supports) {
            let at = [time + S::from_f64(share) * step, S::zero()];
            stage.evaluate_supports(loads, at, q0)?;
        }
        Ok(())
    }

    /// What the start of the next step depends on besides the state.
    pub(super) fn past(&self) -> SavedPast<S> {
        self.solver.past()
    }

    /// The same where it was saved before.
    pub(super) fn save_past_to(&self, past: &mut SavedPast<S>) {
        self.solver.save_past_to(past);
    }

    /// Goes on from a saved past.
    pub(super) fn restore(&mut self, past: &SavedPast<S>) {
        self.solver.restore(past);
    }

    /// Takes back what the last step left for the next ones.
    pub(super) fn undo(&mut self) {
        self.solver.undo();
    }

    /// A group.
    pub(super) fn elements(&self, group: usize) -> &dyn Elements<S, D> {
        self.groups[group].elements()
    }

    /// All groups.
    pub(super) fn all(&self) -> impl Iterator<Item = &dyn Elements<S, D>> {
        self.groups.iter().map(|group| group.elements())
    }

    /// Does something with all groups.
    pub(super) fn each_mut(&mut self, mut visit: impl FnMut(&mut dyn Elements<S, D>)) {
        for group in &mut self.groups {
            visit(group.elements_mut());
        }
    }
}

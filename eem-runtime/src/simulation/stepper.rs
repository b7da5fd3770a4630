//! What steps a scene: all that its scheme needs, and nothing that another one would.

use crate::blueprint::Built;
use crate::conduction::Conduction;
use crate::error::{SceneError, StepFailure};
use crate::group::{Elements, Group};
use crate::layout::Layout;
use crate::loads::{Loads, StepLoads};
use crate::masses::Masses;
use crate::scalar::Real;
use crate::scene::ElementEntry;
use crate::scheme::Scheme;
use crate::solver::{SavedPast, Solver, Staged};
use crate::state::State;

/// Elements, loads and solver of a scene.
pub(super) enum Stepper<S: Real, const D: usize> {
    /// With one set of forces per step.
    AtOnce(Box<AtOnce<S, D>>),
    /// Through the stages of [`Scheme::Variational4`].
    InStages(Box<Staged<S, D>>),
}

/// A scene that is stepped with one set of forces.
pub(super) struct AtOnce<S: Real, const D: usize> {
    pub(super) groups: Vec<Box<dyn Group<S, D>>>,
    pub(super) solver: Solver<S, D>,
    /// What acts in the next step.
    pub(super) loads: StepLoads<S>,
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
        built: impl Iterator<Item = Built<S, D>>,
        parts: Parts<'_, S, D>,
        state: &mut State<S>,
    ) -> Result<Self, SceneError> {
        let (mut groups, mut staged) = (Vec::new(), Vec::new());
        for group in built {
            match group {
                Built::AtOnce(mut group) => {
                    group.initialize(state)?;
                    groups.push(group);
                }
                Built::InStages(mut group) => {
                    group.initialize(state)?;
                    staged.push(group);
                }
            }
        }
        let Parts {
            scheme,
            masses,
            elements,
            layout,
            conduction,
            loads,
        } = parts;
        if scheme == Scheme::Variational4 {
            let staged = Staged::new(staged, masses, elements, layout, conduction, loads);
            return Ok(Self::InStages(Box::new(staged)));
        }
        let loads = StepLoads::new(masses.len() * D, layout, loads);
        let solver = Solver::new(scheme, masses, elements, layout, conduction, &loads);
        for group in &mut groups {
            group.connect(&solver.sites(layout, conduction));
        }
        Ok(Self::AtOnce(Box::new(AtOnce {
            groups,
            solver,
            loads,
            between: (scheme == Scheme::Staggered).then(|| state.clone()),
        })))
    }

    /// Evaluates the loads of the step from `time` by `step` at the positions `q0`.
    pub(super) fn evaluate_loads(
        &mut self,
        loads: &Loads<S, D>,
        masses: &Masses<S>,
        scheme: Scheme,
        span: [S; 2],
        q0: &[S],
    ) -> Result<(), StepFailure> {
        match self {
            Self::AtOnce(stepper) => {
                let own = &mut stepper.loads;
                own.evaluate(loads, masses, scheme, span, q0)
            }
            Self::InStages(staged) => staged.evaluate_loads(loads, masses, span, q0),
        }
    }

    /// What the start of the next step depends on besides the state.
    pub(super) fn past(&self) -> SavedPast<S> {
        match self {
            Self::AtOnce(stepper) => stepper.solver.past(),
            Self::InStages(_) => SavedPast::none(),
        }
    }

    /// Goes on from a saved past.
    pub(super) fn restore(&mut self, past: &SavedPast<S>) {
        match self {
            Self::AtOnce(stepper) => stepper.solver.restore(past),
            Self::InStages(_) => (),
        }
    }

    /// Takes back what the last step left for the next ones.
    pub(super) fn undo(&mut self) {
        match self {
            Self::AtOnce(stepper) => stepper.solver.undo(),
            Self::InStages(_) => (),
        }
    }

    /// How many copies of the unknowns of the layout are solved for.
    pub(super) const fn copies(&self) -> usize {
        match self {
            Self::AtOnce(_) => 1,
            Self::InStages(_) => 2,
        }
    }

    /// Number of groups.
    fn len(&self) -> usize {
        match self {
            Self::AtOnce(stepper) => stepper.groups.len(),
            Self::InStages(staged) => staged.groups.len(),
        }
    }

    /// A group, whatever steps it.
    pub(super) fn elements(&self, group: usize) -> &dyn Elements<S, D> {
        match self {
            Self::AtOnce(stepper) => &*stepper.groups[group],
            Self::InStages(staged) => &*staged.groups[group],
        }
    }

    /// The same, to be changed.
    fn elements_mut(&mut self, group: usize) -> &mut dyn Elements<S, D> {
        match self {
            Self::AtOnce(stepper) => &mut *stepper.groups[group],
            Self::InStages(staged) => &mut *staged.groups[group],
        }
    }

    /// All groups, whatever steps them.
    pub(super) fn all(&self) -> impl Iterator<Item = &dyn Elements<S, D>> {
        (0..self.len()).map(|group| self.elements(group))
    }

    /// Does something with all groups.
    pub(super) fn each_mut(&mut self, mut visit: impl FnMut(&mut dyn Elements<S, D>)) {
        for group in 0..self.len() {
            visit(self.elements_mut(group));
        }
    }
}

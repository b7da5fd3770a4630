//! All elements of one model, stepped together through three stages.
//!
//! [`StageGroup`] is to the solver of [`Scheme::Variational4`](crate::Scheme::Variational4) what [`Group`](super::Group)
//! is to that of the other schemes; the equations are in `scheme/variational_4.rs`. Stages are numbered
//! 0, 1, 2 for the start, the middle and the end of the step.
//!
//! ```text
//! begin     look at the old state, once                                     (member)
//! evaluate  free energy at the three stages, local unknowns eliminated      (point, local)
//! assemble  contributions to the global residual and tangent                (assemble, heat)
//! correct   local unknowns from the global solution                         (correct, heat)
//! close     increments of the internal variables, and the new state         (closing)
//! ```

mod assemble;
mod closing;
mod correct;
mod heat;
mod local;
mod member;
mod point;
mod secant;
mod site;

use super::{ElementGeneric, ElementGroup, ElementView, Elements, GroupTotals, Placed, StepView};
use crate::checkpoint::{Digest, RestoreError};
use crate::conduction::Conduction;
use crate::error::StateError;
use crate::free_energy::FreeEnergy;
use crate::handle::Element;
use crate::kinematics::Kinematics;
use crate::layout::Slots;
use crate::loads::StepLoads;
use crate::masses::Masses;
use crate::scalar::Real;
use crate::scheme::{Phase, Variational};
use crate::state::State;
use crate::system::LinearSystem;
use local::LocalStages;
use member::StageMember;

use site::{Quarters, StageSite};

/// The stage in the middle of the step.
const MIDDLE: usize = 1;
/// The stage at its end.
const END: usize = 2;

/// What all elements share during one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StageView<'a, S> {
    /// h, s.
    pub(crate) step: S,
    /// The old state.
    pub(crate) state: &'a State<S>,
    pub(crate) conduction: &'a Conduction<S>,
    /// What acts at the times of the stages.
    pub(crate) loads: &'a [StepLoads<S>; 3],
    /// m per node, kg; `None` for anchors.
    pub(crate) masses: &'a Masses<S>,
}

impl<'a, S: Real> StageView<'a, S> {
    /// The end of the step, as those see it who look at states.
    pub(crate) fn at_end(&self) -> StepView<'a, S> {
        StepView {
            phase: Phase::Whole,
            step: self.step,
            state: self.state,
            conduction: self.conduction,
            loads: &self.loads[END],
            masses: self.masses,
        }
    }

    /// The temperatures prescribed on a thermal slot at the stages, K.
    fn prescribed(&self, slot: usize) -> Option<[S; 3]> {
        let [start, middle, end] = self.loads.each_ref().map(|loads| loads.prescribed(slot));
        Some([start?.end, middle?.end, end?.end])
    }
}

/// The global part of the stages that Newton's method tries.
#[derive(Clone, Debug)]
pub(crate) struct StageTrial<S, const D: usize> {
    /// `q_m − q⁰` and `q¹ − q⁰` of all nodes, m.
    pub(crate) displacements: [Vec<[S; D]>; 2],
    /// Positions of all nodes at the stages, m.
    pub(crate) positions: [Vec<[S; D]>; 3],
    /// The temperatures of the stages as elements in contact see them, per thermal slot, K; where a
    /// slot is coupled, the first and the last are unknowns.
    pub(crate) seen_temperatures: [Vec<S>; 3],
}

/// Elements of one model, stepped through three stages, whatever model and kinematics are.
///
/// Global unknowns are numbered as in the [`Layout`](crate::layout::Layout), first all displacements
/// `q_m − q⁰` and seen temperatures `Θ_0`, then all `q¹ − q⁰` and `Θ_1`.
pub(crate) trait StageGroup<S: Real, const D: usize>: Elements<S, D> {
    /// Learns where its elements write in the global systems; once per scene.
    fn connect(&mut self, quarters: &Quarters<'_, S, D>);

    /// Looks at the old state, starts the trial there, and reduces the unit of length of each node
    /// to the shortest measure.
    fn begin(&mut self, view: &StageView<'_, S>, lengths: &mut [S]);

    /// Computes everything that depends on the trial stages, element by element.
    fn evaluate(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S, D>,
    ) -> Result<(), StateError>;

    /// Adds residual and tangent of the elements, local unknowns eliminated.
    fn assemble(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S, D>,
        system: &mut LinearSystem<S, 1>,
    );

    /// Local corrections that go with the global ones; the largest, in units of the measure (viscous
    /// stretches) and of the temperature.
    fn correct(&mut self, view: &StageView<'_, S>, solution: &[[S; 1]]) -> S;

    /// Applies the fraction `share` of the last local corrections.
    fn apply(&mut self, share: S);

    /// The present trial is where the next correction starts; no local correction.
    fn hold(&mut self);

    /// Adds `(h/12) A` and `−(h/12) A q⁰`, where `A q_m` is the nodal force of the found middle; moved
    /// anchors are taken from the trial.
    fn add_secant(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S, D>,
        system: &mut LinearSystem<S, D>,
    );

    /// Subtracts the nodal forces of the elements at a stage, N: their magnitudes as found, their
    /// directions from the positions of the trial.
    fn subtract_forces(&mut self, stage: usize, trial: &StageTrial<S, D>, forces: &mut [[S; D]]);

    /// Adds the increments of the internal variables and of the reservoirs' entropies to a new state
    /// whose positions are known, and finds its temperatures.
    fn close(&mut self, view: &StageView<'_, S>, next: &mut State<S>) -> Result<(), StateError>;
}

/// Elements of the model `M` with the kinematics `K`.
pub(crate) struct ThreeStageGroup<S, M, K, const D: usize>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// What they are in a state.
    elements: ElementGroup<S, M, K, Variational, D>,
    members: Vec<StageMember<S, M, K, D>>,
    local: LocalStages<S>,
}

impl<S, M, K, const D: usize> ThreeStageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    pub(crate) fn new(kinematics: K, models: Vec<(Element, M)>, placed: Placed<'_>) -> Self {
        let elements = ElementGroup::new(kinematics, models, placed);
        let members = elements.members.iter();
        let members = members.map(StageMember::new);
        let unknowns = StageMember::<S, M, K, D>::UNKNOWNS;
        let inputs = StageMember::<S, M, K, D>::INPUTS;
        Self {
            members: members.collect(),
            local: LocalStages::new(unknowns, inputs),
            elements,
        }
    }
}

impl<S, M, K, const D: usize> StageGroup<S, D> for ThreeStageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    fn connect(&mut self, quarters: &Quarters<'_, S, D>) {
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            stages.site = StageSite::new(&member.site.nodes, member.slots().thermal, quarters);
        }
    }

    fn begin(&mut self, view: &StageView<'_, S>, lengths: &mut [S]) {
        let kinematics = self.elements.kinematics;
        for (member, stages) in self.elements.members.iter().zip(&mut self.members) {
            stages.begin(kinematics, member, view, lengths);
        }
    }

    fn evaluate(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S, D>,
    ) -> Result<(), StateError> {
        self.evaluate_all(view, trial)
    }

    fn assemble(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S, D>,
        system: &mut LinearSystem<S, 1>,
    ) {
        self.assemble_all(view, trial, system);
    }

    fn correct(&mut self, view: &StageView<'_, S>, solution: &[[S; 1]]) -> S {
        self.correct_all(view, solution)
    }

    fn apply(&mut self, share: S) {
        for stages in &mut self.members {
            stages.apply(share);
        }
    }

    fn hold(&mut self) {
        for stages in &mut self.members {
            stages.hold();
        }
    }

    fn add_secant(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S, D>,
        system: &mut LinearSystem<S, D>,
    ) {
        self.add_secant_all(view, trial, system);
    }

    fn subtract_forces(&mut self, stage: usize, trial: &StageTrial<S, D>, forces: &mut [[S; D]]) {
        self.subtract_all_forces(stage, trial, forces);
    }

    fn close(&mut self, view: &StageView<'_, S>, next: &mut State<S>) -> Result<(), StateError> {
        self.close_all(view, next)
    }
}

impl<S, M, K, const D: usize> Elements<S, D> for ThreeStageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    fn initialize(&mut self, state: &mut State<S>) -> Result<(), StateError> {
        self.elements.initialize(state)
    }

    fn totals(&self, state: &State<S>) -> GroupTotals<S> {
        self.elements.totals(state)
    }

    fn find_energies(&self, state: &mut State<S>) {
        self.elements.find_energies(state);
    }

    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>> {
        self.elements.generic_in(state)
    }

    fn slots(&self, place: usize) -> Slots {
        self.elements.slots(place)
    }

    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S> {
        self.elements.inspect(place, state)
    }

    fn digest(&self, digest: &mut Digest) {
        self.elements.digest(digest);
    }

    fn audit(&self, state: &State<S>) -> Result<(), RestoreError> {
        self.elements.audit(state)
    }
}

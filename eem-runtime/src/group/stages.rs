//! All elements of one model, stepped together through three stages.
//!
//! [`StageGroup`] is to the solver of [`Scheme::Variational4`](crate::Scheme::Variational4) what [`Group`]
//! is to that of the other schemes; the equations are in `scheme/variational_4.rs`. Stages are numbered
//! 0, 1, 2 for the start, the middle and the end of the step.
//!
//! ```text
//! begin     look at the old state, once
//! evaluate  free energy at the three stages, local unknowns condensed      (point, local)
//! assemble  contributions to the global residual and tangent               (assemble)
//! correct   local unknowns from the global solution                        (assemble)
//! close     increments of the internal variables from the found stages     (closing)
//! ```

mod assemble;
mod closing;
mod local;
mod member;
mod point;

use super::geometry::Geometry;
use super::{ElementGeneric, ElementGroup, ElementView, Elements, Group, GroupTotals, Placed};
use super::{StepView, variables};
use crate::conduction::Conduction;
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::handle::Element;
use crate::kinematics::Kinematics;
use crate::layout::Layout;
use crate::loads::StepLoads;
use crate::scalar::Real;
use crate::scheme::{Phase, Variational};
use crate::state::State;
use crate::system::LinearSystem;
use local::LocalStages;
use member::StageMember;

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
    pub(crate) layout: &'a Layout,
    /// What acts at the times of the stages.
    pub(crate) loads: &'a [StepLoads<S>; 3],
    /// m per node, kg; `None` for anchors.
    pub(crate) masses: &'a [Option<S>],
}

impl<'a, S: Real> StageView<'a, S> {
    /// The end of the step, as those see it who look at states.
    pub(crate) fn at_end(&self) -> StepView<'a, S> {
        StepView {
            phase: Phase::Whole,
            step: self.step,
            state: self.state,
            conduction: self.conduction,
            layout: self.layout,
            loads: &self.loads[END],
            masses: self.masses,
        }
    }

    /// The temperatures prescribed on a thermal slot at the stages, K.
    fn prescribed(&self, slot: usize) -> Option<[S; 3]> {
        let [start, middle, end] = self.loads.each_ref().map(|loads| loads.prescribed[slot]);
        Some([start?.end, middle?.end, end?.end])
    }
}

/// The global part of the stages that Newton's method tries.
#[derive(Clone, Debug)]
pub(crate) struct StageTrial<S> {
    /// `q_m − q⁰` and `q¹ − q⁰` of all nodes, m.
    pub(crate) displacements: [Vec<S>; 2],
    /// Positions of all nodes at the stages, m.
    pub(crate) positions: [Vec<S>; 3],
    /// The temperatures of the stages as elements in contact see them, per thermal slot, K; where a
    /// slot is coupled, the first and the last are unknowns.
    pub(crate) seen_temperatures: [Vec<S>; 3],
}

/// Elements of one model, stepped through three stages, whatever model and kinematics are.
///
/// Global unknowns are numbered as in the [`Layout`], first all displacements `q_m − q⁰` and seen
/// temperatures `Θ_0`, then all `q¹ − q⁰` and `Θ_1`.
pub(crate) trait StageGroup<S: Real, const D: usize>: Elements<S, D> {
    /// Looks at the old state.
    fn begin(&mut self, view: &StageView<'_, S>);

    /// Computes everything that depends on the trial stages, element by element.
    fn evaluate(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
    ) -> Result<(), StateError>;

    /// Adds residual and tangent of the elements, local unknowns condensed.
    fn assemble(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
        system: &mut LinearSystem<S>,
    );

    /// Local corrections that go with the global ones; the largest, in units of the measure (viscous
    /// stretches) and of the temperature.
    fn correct(&mut self, view: &StageView<'_, S>, solution: &[S]) -> S;

    /// Applies the fraction `share` of the last local corrections.
    fn apply(&mut self, share: S);

    /// The present trial is where the next correction starts; no local correction.
    fn hold(&mut self);

    /// Adds `(h/12) A` and `−(h/12) A q⁰`, where `A q_m` is the nodal force of the found middle; moved
    /// anchors are taken from the trial.
    fn add_secant(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
        system: &mut LinearSystem<S>,
    );

    /// Subtracts the nodal forces of the elements at a stage, N: their magnitudes as found, their
    /// directions from the positions of the trial.
    fn subtract_forces(&mut self, stage: usize, trial: &StageTrial<S>, forces: &mut [S]);

    /// Adds the increments of the internal variables and of the reservoirs' entropies.
    fn close(&mut self, view: &StageView<'_, S>, next: &mut State<S>);

    /// Reduces the unit of length of each node to the shortest measure of the old state.
    fn shorten(&self, lengths: &mut [S]);
}

/// Elements of the model `M` with the kinematics `K`.
pub(crate) struct ThreeStageGroup<S: Real, M: FreeEnergy<S> + Send + Sync + 'static, K> {
    /// What they are in a state.
    elements: ElementGroup<S, M, K, Variational>,
    members: Vec<StageMember<S, M>>,
    /// The elements at each stage.
    geometry: [Geometry<S>; 3],
    local: LocalStages<S>,
}

impl<S, M, K> ThreeStageGroup<S, M, K>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
{
    pub(crate) fn new<const D: usize>(
        kinematics: K,
        models: Vec<(Element, M)>,
        placed: Placed<'_>,
    ) -> Self {
        let elements = ElementGroup::new::<D>(kinematics, models, placed);
        let geometry = &elements.geometry;
        let count = elements.members.len();
        let members = (0..count).map(|_| StageMember::new());
        Self {
            members: members.collect(),
            geometry: [(); 3].map(|()| geometry.clone()),
            local: LocalStages::new::<M>(),
            elements,
        }
    }

    /// See [`StageGroup::begin`].
    fn begin_step(&mut self, view: &StageView<'_, S>) {
        let positions = view.state.positions.values();
        let kinematics = self.elements.kinematics;
        for (i, stages) in self.members.iter_mut().enumerate() {
            let geometry = &mut self.elements.geometry;
            geometry.measure_at(kinematics, i, positions);
            self.geometry[0].aim(kinematics, i, positions);
            let slots = self.elements.members[i].slots;
            let measures = &geometry.old_measures[geometry.measures_range(i)];
            stages.x = [variables::<S, M>(measures, slots, view.state); 3];
            stages.hold();
            let Some(slot) = slots.thermal else { continue };
            stages.entropy = view.state.entropies.values()[slot];
            stages.prescribed = view.prescribed(slot);
            for (x, theta) in stages
                .x
                .iter_mut()
                .zip(stages.prescribed.into_iter().flatten())
            {
                x.as_mut()[M::Variables::LEN - 1] = theta;
            }
            stages.hold();
        }
    }
}

impl<S, M, K, const D: usize> StageGroup<S, D> for ThreeStageGroup<S, M, K>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
{
    fn begin(&mut self, view: &StageView<'_, S>) {
        self.begin_step(view);
    }

    fn evaluate(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
    ) -> Result<(), StateError> {
        self.evaluate_trial(view, trial)
    }

    fn assemble(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S>,
        system: &mut LinearSystem<S>,
    ) {
        self.assemble_all(view, trial, system);
    }

    fn correct(&mut self, view: &StageView<'_, S>, solution: &[S]) -> S {
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
        trial: &StageTrial<S>,
        system: &mut LinearSystem<S>,
    ) {
        self.add_secant_all(view, trial, system);
    }

    fn subtract_forces(&mut self, stage: usize, trial: &StageTrial<S>, forces: &mut [S]) {
        self.subtract_all_forces(stage, trial, forces);
    }

    fn close(&mut self, view: &StageView<'_, S>, next: &mut State<S>) {
        self.close_all(view, next);
    }

    fn shorten(&self, lengths: &mut [S]) {
        Group::<S, D>::shorten(&self.elements, lengths);
    }
}

impl<S, M, K, const D: usize> Elements<S, D> for ThreeStageGroup<S, M, K>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
{
    fn initialize(&mut self, state: &mut State<S>) -> Result<(), StateError> {
        Elements::<S, D>::initialize(&mut self.elements, state)
    }

    fn settle(&mut self, view: &StepView<'_, S>, next: &mut State<S>) -> Result<(), StateError> {
        self.settle_all(view, next)
    }

    fn totals(&self, state: &State<S>) -> GroupTotals<S> {
        Elements::<S, D>::totals(&self.elements, state)
    }

    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>> {
        Elements::<S, D>::generic_in(&mut self.elements, state)
    }

    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S> {
        Elements::<S, D>::inspect(&self.elements, place, state)
    }
}

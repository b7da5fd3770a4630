//! All elements of one model, stepped together.
//!
//! [`Group`] is what the solver sees: one dynamic call per group and phase. [`ElementGroup`] is the one
//! implementation, monomorphic in model, kinematics and scheme. The phases of a step are
//!
//! ```text
//! begin     look at the old state, once                             (evaluate)
//! evaluate  response, local residual, local unknowns condensed  (evaluate, local)
//! assemble  contributions to the global residual and tangent        (assemble)
//! correct   local unknowns from the global solution                 (assemble)
//! close     increments of all variables from the found forces       (closing)
//! ```

mod assemble;
mod closing;
mod evaluate;
mod generic;
mod geometry;
mod inspect;
mod local;
mod member;
mod stages;

use crate::conduction::Conduction;
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::handle::Element;
use crate::kinematics::Kinematics;
use crate::layout::{Layout, Slots};
use crate::loads::StepLoads;
use crate::scalar::Real;
use crate::scene::ElementEntry;
use crate::scheme::{ElementScheme, Phase, Placement};
use crate::state::State;
use crate::system::LinearSystem;
pub(crate) use generic::ElementGeneric;
use geometry::Geometry;
use local::LocalSolver;
use member::Member;
pub(crate) use stages::{StageGroup, StageTrial, StageView, ThreeStageGroup};

/// What all elements share during one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepView<'a, S> {
    /// What changes.
    pub(crate) phase: Phase,
    /// h, s.
    pub(crate) step: S,
    /// The old state.
    pub(crate) state: &'a State<S>,
    pub(crate) conduction: &'a Conduction<S>,
    pub(crate) layout: &'a Layout,
    pub(crate) loads: &'a StepLoads<S>,
    /// m per node, kg; `None` for anchors.
    pub(crate) masses: &'a [Option<S>],
}

impl<S: Real> StepView<'_, S> {
    /// The old velocity of a coordinate; that of an anchor is its mean over the step, m/s.
    fn old_velocity(&self, coordinate: usize, dimension: usize) -> S {
        match self.masses[coordinate / dimension] {
            Some(mass) => self.state.momenta.values()[coordinate] / mass,
            None => self.loads.motion[coordinate] / self.step,
        }
    }

    /// The time during which internal variables evolve, s.
    fn thermal_step(&self) -> S {
        if self.phase.heats() {
            self.step
        } else {
            S::zero()
        }
    }

    /// The temperature prescribed on a thermal slot, as a scheme with this placement sees it.
    fn prescribed(&self, slot: Option<usize>, at: Placement) -> Option<S> {
        if !self.phase.heats() {
            return None;
        }
        let prescribed = self.loads.prescribed[slot?]?;
        Some(match at {
            Placement::Ends | Placement::End => prescribed.end,
            Placement::Middle | Placement::Start => prescribed.middle,
        })
    }
}

/// The global part of the new state that Newton's method tries.
#[derive(Clone, Debug)]
pub(crate) struct Trial<S> {
    /// q¹ − q⁰ of all nodes, m.
    pub(crate) displacements: Vec<S>,
    /// q¹ of all nodes, m.
    pub(crate) positions: Vec<S>,
    /// θ* as elements in contact see it, Θ, per thermal slot, K; an unknown where the slot is
    /// coupled.
    pub(crate) seen_temperatures: Vec<S>,
}

/// Internal energy (J) and entropy (J/K) of a group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroupTotals<S> {
    pub(crate) energy: S,
    pub(crate) entropy: S,
}

/// One element in a state, from the definitions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementView<S> {
    /// First measure: the stretch of a spring, m.
    pub(crate) measure: S,
    /// First component of ∂ψ/∂π: the force of a spring, N.
    pub(crate) force: S,
    /// `ψ + θ s`, J.
    pub(crate) internal_energy: S,
}

/// Elements of one model in a state, whatever steps them.
pub(crate) trait Elements<S: Real, const D: usize>: Send + Sync {
    /// Entropies of an initial state whose temperatures are given.
    fn initialize(&mut self, state: &mut State<S>) -> Result<(), StateError>;

    /// Temperatures of a new state whose entropies are given, and all that must be true of a state.
    fn settle(&mut self, view: &StepView<'_, S>, next: &mut State<S>) -> Result<(), StateError>;

    /// Energy and entropy, from their definitions.
    fn totals(&self, state: &State<S>) -> GroupTotals<S>;

    /// What the elements contribute to the GENERIC form in a state.
    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>>;

    /// The element at `place` in a state.
    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S>;
}

/// Elements of one model, whatever model, kinematics and scheme are.
pub(crate) trait Group<S: Real, const D: usize>: Elements<S, D> {
    /// Looks at the old state; adds the nodal forces that it alone decides to `old_force`, N.
    fn begin(&mut self, view: &StepView<'_, S>, old_force: &mut [S]) -> Result<(), StateError>;

    /// Computes everything that depends on the trial state, element by element.
    fn evaluate(&mut self, view: &StepView<'_, S>, trial: &Trial<S>) -> Result<(), StateError>;

    /// Adds residual and tangent of the elements, local unknowns condensed.
    fn assemble(&mut self, view: &StepView<'_, S>, trial: &Trial<S>, system: &mut LinearSystem<S>);

    /// Local corrections that go with the global ones; the largest, in units of the measure (viscous
    /// stretches) and of the temperature.
    fn correct(&mut self, view: &StepView<'_, S>, solution: &[S]) -> S;

    /// Applies the fraction `share` of the last local corrections.
    fn apply(&mut self, share: S);

    /// The present trial is where the next correction starts; no local correction.
    fn hold(&mut self);

    /// Adds `½h Σ A` and `−h Σ A q⁰`, where `A q_m` is the nodal force at the found response, if the
    /// scheme has that form; moved anchors are taken from the trial.
    fn add_secant(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
        system: &mut LinearSystem<S>,
    );

    /// From here on, nodal forces act along the gradient of the trial configuration.
    fn aim(&mut self, trial: &Trial<S>);

    /// Adds the nodal impulse `−h F` of the found response to `impulse`, N s.
    fn add_impulse(&mut self, view: &StepView<'_, S>, trial: &Trial<S>, impulse: &mut [S]);

    /// Adds the increments of the internal variables and of the reservoirs' entropies.
    fn close(&mut self, view: &StepView<'_, S>, trial: &Trial<S>, next: &mut State<S>);

    /// Reduces the unit of length of each node to the shortest measure of the old state.
    fn shorten(&self, lengths: &mut [S]);

    /// What they contributed to the discrete GENERIC form of the last step.
    fn generic_of_step(&self) -> Vec<ElementGeneric<S>>;
}

/// Where the elements of a group are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<'a> {
    pub(crate) nodes: &'a dyn NodesOf,
    pub(crate) layout: &'a Layout,
}

/// The nodes of an element of the scene.
pub(crate) trait NodesOf: core::fmt::Debug {
    fn nodes_of(&self, element: Element) -> &[usize];
}

impl<S: core::fmt::Debug> NodesOf for Vec<ElementEntry<S>> {
    fn nodes_of(&self, element: Element) -> &[usize] {
        &self[element.index].nodes
    }
}

/// Elements of the model `M` with the kinematics `K`, stepped by the scheme `C`.
pub(crate) struct ElementGroup<S: Real, M: FreeEnergy<S>, K, C: ElementScheme<S, M>> {
    kinematics: K,
    members: Vec<Member<S, M, C>>,
    geometry: Geometry<S>,
    local: LocalSolver<S>,
}

impl<S, M, K, C> ElementGroup<S, M, K, C>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
    C: ElementScheme<S, M>,
{
    pub(crate) fn new<const D: usize>(
        kinematics: K,
        models: Vec<(Element, M)>,
        placed: Placed<'_>,
    ) -> Self {
        let nodes = models
            .iter()
            .flat_map(|(element, _)| placed.nodes.nodes_of(*element).to_vec());
        let geometry = Geometry::new::<K, D>(nodes.collect(), models.len());
        let slots = |element: Element| placed.layout.elements[element.index];
        let members = models
            .into_iter()
            .map(|(element, model)| Member::new(element, model, slots(element)));
        Self {
            kinematics,
            members: members.collect(),
            geometry,
            local: LocalSolver::new(M::Variables::LEN - M::MEASURES),
        }
    }
}

impl<S, M, K, C, const D: usize> Elements<S, D> for ElementGroup<S, M, K, C>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
    C: ElementScheme<S, M>,
{
    fn initialize(&mut self, state: &mut State<S>) -> Result<(), StateError> {
        self.initialize_all(state)
    }

    fn settle(&mut self, view: &StepView<'_, S>, next: &mut State<S>) -> Result<(), StateError> {
        self.settle_all(view, next)
    }

    fn totals(&self, state: &State<S>) -> GroupTotals<S> {
        self.sum(state)
    }

    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>> {
        self.generic_in_all(state)
    }

    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S> {
        self.inspect_at(place, state)
    }
}

impl<S, M, K, C, const D: usize> Group<S, D> for ElementGroup<S, M, K, C>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
    C: ElementScheme<S, M>,
{
    fn begin(&mut self, view: &StepView<'_, S>, old_force: &mut [S]) -> Result<(), StateError> {
        self.begin_step(view, old_force)
    }

    fn evaluate(&mut self, view: &StepView<'_, S>, trial: &Trial<S>) -> Result<(), StateError> {
        self.evaluate_trial(view, trial)
    }

    fn assemble(&mut self, view: &StepView<'_, S>, trial: &Trial<S>, system: &mut LinearSystem<S>) {
        self.assemble_all(view, trial, system);
    }

    fn correct(&mut self, view: &StepView<'_, S>, solution: &[S]) -> S {
        self.correct_all(view, solution)
    }

    fn apply(&mut self, share: S) {
        for member in &mut self.members {
            member.apply(share);
        }
    }

    fn hold(&mut self) {
        for member in &mut self.members {
            member.hold();
        }
    }

    fn add_secant(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
        system: &mut LinearSystem<S>,
    ) {
        self.add_secant_all(view, trial, system);
    }

    fn aim(&mut self, trial: &Trial<S>) {
        for i in 0..self.members.len() {
            self.geometry.aim(self.kinematics, i, &trial.positions);
        }
    }

    fn add_impulse(&mut self, view: &StepView<'_, S>, trial: &Trial<S>, impulse: &mut [S]) {
        self.add_impulse_all(view, trial, impulse);
    }

    fn close(&mut self, view: &StepView<'_, S>, trial: &Trial<S>, next: &mut State<S>) {
        self.close_all(view, trial, next);
    }

    fn shorten(&self, lengths: &mut [S]) {
        for i in 0..self.members.len() {
            let own = &self.geometry.old_measures[self.geometry.measures_range(i)];
            for &node in self.geometry.nodes_of(i) {
                lengths[node] = own
                    .iter()
                    .fold(lengths[node], |least, &own| least.minimum(own));
            }
        }
    }

    fn generic_of_step(&self) -> Vec<ElementGeneric<S>> {
        self.generic_of_step_all()
    }
}

/// The variables `x = (π, γ, θ)` of an element in a state.
fn variables<S: Real, M: FreeEnergy<S>>(
    measures: &[S],
    slots: Slots,
    state: &State<S>,
) -> M::Variables {
    let mut x = M::Variables::filled(S::zero());
    let (own, rest) = x.as_mut().split_at_mut(M::MEASURES);
    own.copy_from_slice(measures);
    rest[..M::DASHPOTS]
        .copy_from_slice(&state.viscous.values()[slots.viscous..slots.viscous + M::DASHPOTS]);
    if let Some(slot) = slots.thermal {
        rest[M::DASHPOTS] = state.temperatures[slot];
    }
    x
}

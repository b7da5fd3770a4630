//! All elements of one model, stepped together.
//!
//! [`Group`] is what the solver sees: one dynamic call per group and phase. [`ElementGroup`] is the one
//! implementation, monomorphic in model, kinematics and scheme. The phases of a step are
//!
//! ```text
//! begin      look at the old state, once                                  (evaluate)
//! evaluate   response, local unknowns eliminated, contributions written    (evaluate, local, assemble)
//! correct    local unknowns from the global solution                       (assemble)
//! close      increments from the found forces, and the new state           (closing, settle)
//! ```

mod assemble;
mod closing;
mod evaluate;
mod generic;
mod inspect;
mod local;
mod member;
mod pose;
mod settle;
mod site;

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
use member::Member;
pub(crate) use pose::points;
use site::{Contact, Site};

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
    pub(crate) loads: &'a StepLoads<S>,
    /// m per node, kg; `None` for anchors.
    pub(crate) masses: &'a [Option<S>],
}

impl<S: Real> StepView<'_, S> {
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
pub(crate) struct Trial<S, const D: usize> {
    /// q¹ − q⁰ of all nodes, m.
    pub(crate) displacements: Vec<[S; D]>,
    /// q¹ of all nodes, m.
    pub(crate) positions: Vec<[S; D]>,
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

/// What the old state gives to the nodes.
#[derive(Debug)]
pub(crate) struct Old<'a, S, const D: usize> {
    /// The part of the nodal forces that it alone decides, N.
    pub(crate) force: &'a mut [[S; D]],
    /// The unit of length of each node: the shortest measure of its elements, m.
    pub(crate) lengths: &'a mut [S],
}

/// Along which gradient the found forces act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Along {
    /// That of the scheme, as the force `A q_m`.
    Secant,
    /// That of the scheme.
    Scheme,
    /// That of the new configuration.
    Gradient,
}

/// Elements of one model, whatever model, kinematics and scheme are.
pub(crate) trait Group<S: Real, const D: usize>: Send + Sync {
    /// Learns where its elements write in the global systems; once per scene.
    fn connect(&mut self, sites: &Sites<'_, S, D>);

    /// Looks at the old state, adds to what it gives to the nodes, and starts the trial there.
    fn begin(&mut self, view: &StepView<'_, S>, old: &mut Old<'_, S, D>) -> Result<(), StateError>;

    /// Applies the fraction `share` of the last local corrections.
    fn apply(&mut self, share: S);

    /// Computes everything that depends on the trial state, element by element, and adds residual
    /// and tangent, local unknowns eliminated, to a system if there is one.
    fn evaluate(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError>;

    /// Local corrections that go with the global ones; the largest, in units of the measure (viscous
    /// stretches) and of the temperature.
    fn correct(&mut self, view: &StepView<'_, S>, solution: &[[S; 1]]) -> S;

    /// The present trial is where the next correction starts; no local correction.
    fn hold(&mut self);

    /// Applies the last correction to the response through the tangent, without evaluating it.
    fn extrapolate(&mut self);

    /// Adds `½h Σ A` and `−h Σ A q⁰`, where `A q_m` is the nodal force at the found response; moved
    /// anchors are taken from the trial.
    fn add_secant(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: &mut LinearSystem<S, D>,
    );

    /// Adds the nodal impulse `−h F` of the found response to `impulse`, N s.
    fn add_impulse(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        along: Along,
        impulse: &mut [[S; D]],
    );

    /// Adds the increments of the internal variables and of the reservoirs' entropies to a new state
    /// whose positions are known, and finds its temperatures.
    fn close(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
    ) -> Result<(), StateError>;

    /// Entropies of an initial state whose temperatures are given.
    fn initialize(&mut self, state: &mut State<S>) -> Result<(), StateError>;

    /// Energy and entropy, from their definitions.
    fn totals(&self, state: &State<S>) -> GroupTotals<S>;

    /// What the elements contribute to the GENERIC form in a state.
    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>>;

    /// What they contributed to the discrete GENERIC form of the last step, between two states.
    fn generic_of_step(&self, ends: [&State<S>; 2]) -> Vec<ElementGeneric<S>>;

    /// The element at `place` in a state.
    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S>;
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

/// What decides where an element writes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sites<'a, S, const D: usize> {
    pub(crate) layout: &'a Layout,
    pub(crate) conduction: &'a Conduction<S>,
    /// The system of an iteration.
    pub(crate) tangent: &'a LinearSystem<S, 1>,
    /// The system that closes a step.
    pub(crate) secant: &'a LinearSystem<S, D>,
}

/// Elements of the model `M` with the kinematics `K`, stepped by the scheme `C`.
pub(crate) struct ElementGroup<S, M, K, C, const D: usize>
where
    S: Real,
    M: FreeEnergy<S>,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    kinematics: K,
    members: Vec<Member<S, M, K, C, D>>,
    contacts: Vec<Contact<K, S, D>>,
}

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    pub(crate) fn new(kinematics: K, models: Vec<(Element, M)>, placed: Placed<'_>) -> Self {
        let members = models.into_iter().map(|(element, model)| {
            let slots = placed.layout.elements[element.index];
            Member::new(element, model, slots, placed.nodes.nodes_of(element))
        });
        Self {
            kinematics,
            members: members.collect(),
            contacts: Vec::new(),
        }
    }
}

impl<S, M, K, C, const D: usize> Group<S, D> for ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    fn connect(&mut self, sites: &Sites<'_, S, D>) {
        for member in &mut self.members {
            let nodes = member.site.nodes;
            member.site = Site::new(nodes.as_ref(), sites);
            let slot = member.slots.thermal;
            if let Some(contact) = Contact::new(nodes.as_ref(), slot, sites) {
                member.site.contact = Some(self.contacts.len());
                self.contacts.push(contact);
            }
        }
    }

    fn begin(&mut self, view: &StepView<'_, S>, old: &mut Old<'_, S, D>) -> Result<(), StateError> {
        self.begin_all(view, old)
    }

    fn apply(&mut self, share: S) {
        for member in &mut self.members {
            member.apply(share);
        }
    }

    fn evaluate(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError> {
        self.evaluate_all(view, trial, system)
    }

    fn correct(&mut self, view: &StepView<'_, S>, solution: &[[S; 1]]) -> S {
        self.correct_all(view, solution)
    }

    fn hold(&mut self) {
        for member in &mut self.members {
            member.hold();
        }
    }

    fn extrapolate(&mut self) {
        for member in &mut self.members {
            member.extrapolate();
        }
    }

    fn add_secant(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: &mut LinearSystem<S, D>,
    ) {
        self.add_secant_all(view, trial, system);
    }

    fn add_impulse(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        along: Along,
        impulse: &mut [[S; D]],
    ) {
        self.add_impulse_all(view, trial, along, impulse);
    }

    fn close(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
    ) -> Result<(), StateError> {
        self.close_all(view, trial, next)
    }

    fn initialize(&mut self, state: &mut State<S>) -> Result<(), StateError> {
        self.initialize_all(state)
    }

    fn totals(&self, state: &State<S>) -> GroupTotals<S> {
        self.sum(state)
    }

    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>> {
        self.generic_in_all(state)
    }

    fn generic_of_step(&self, ends: [&State<S>; 2]) -> Vec<ElementGeneric<S>> {
        self.generic_of_step_all(ends)
    }

    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S> {
        self.inspect_at(place, state)
    }
}

/// The variables `x = (π, γ, θ)` of an element in a state.
#[inline]
fn variables<S: Real, M: FreeEnergy<S>>(
    measures: &[S],
    slots: Slots,
    state: &State<S>,
) -> M::Variables {
    let mut x = M::Variables::filled(S::zero());
    for (a, &measure) in measures.iter().enumerate() {
        x[a] = measure;
    }
    for k in 0..M::DASHPOTS {
        x[M::MEASURES + k] = state.viscous.values()[slots.viscous + k];
    }
    if let Some(slot) = slots.thermal {
        x[M::MEASURES + M::DASHPOTS] = state.temperatures[slot];
    }
    x
}

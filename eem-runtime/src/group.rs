//! All elements of one model, stepped together.
//!
//! [`Group`] is what the solver sees: one dynamic call per group and phase. [`ElementGroup`] is the one
//! implementation, monomorphic in model, kinematics and scheme. The phases of a step are
//!
//! ```text
//! begin      look at the old state, once                            (begin)
//! evaluate   response at the trial                                  (evaluate, respond, pose, arms)
//!            local unknowns eliminated                              (local, eliminate)
//!            contributions written to their places                  (assemble, scatter, site)
//! correct    local unknowns from the global solution                (correct, member)
//! close      impulses, what is booked, and the new state            (closing, settle, certify)
//! ```

mod arms;
mod assemble;
mod at_point;
mod audit;
mod begin;
mod certify;
mod closing;
mod correct;
mod eliminate;
mod evaluate;
mod generic;
mod inspect;
mod local;
mod member;
mod pose;
mod respond;
mod scatter;
mod settle;
mod settled;
mod site;
mod stages;
mod view;

use crate::certificate::{Recount, Tally};
use crate::checkpoint::{Digest, RestoreError};
use crate::compact::compact;
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::handle::Element;
use crate::impulse::Impulses;
use crate::kinematics::Kinematics;
use crate::layout::Slots;
use crate::scalar::Real;
use crate::scheme::ElementScheme;
use crate::state::State;
use crate::system::LinearSystem;
pub(crate) use arms::points;
pub(crate) use generic::ElementGeneric;
use member::Member;
use site::{Contact, Site};
pub(crate) use stages::StageGroup;
pub(crate) use view::{Along, ElementView, GroupTotals, Old, Placed, Sites, StepView, Trial};

/// Elements of one model in a state, whatever steps them.
pub(crate) trait Elements<S: Real, const D: usize>: Send + Sync {
    /// Entropies of an initial state whose temperatures are given.
    fn initialize(&mut self, state: &mut State<S>) -> Result<(), StateError>;

    /// Energy and entropy, from their definitions.
    fn totals(&self, state: &State<S>) -> GroupTotals<S>;

    /// Writes the energies of a state whose temperatures and entropies are known.
    fn find_energies(&self, state: &mut State<S>);

    /// What the elements contribute to the GENERIC form in a state.
    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>>;

    /// Where the element at `place` keeps its internal variables.
    fn slots(&self, place: usize) -> Slots;

    /// The element at `place` in a state.
    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S>;

    /// Adds the parameters of all elements to a digest.
    fn digest(&self, digest: &mut Digest);

    /// An error unless the elements can be in a state that comes from outside, and its entropies are
    /// those of its temperatures.
    fn audit(&self, state: &State<S>) -> Result<(), RestoreError>;
}

/// Elements of one model, whatever model, kinematics and scheme are.
pub(crate) trait Group<S: Real, const D: usize>: Elements<S, D> {
    /// Learns where its elements write in the global systems; once per scene.
    fn connect(&mut self, sites: &Sites<'_, S, D>);

    /// Looks at the old state, adds to what it gives to the nodes, and starts the trial there.
    fn begin(&mut self, view: &StepView<'_, S>, old: &mut Old<'_, S, D>) -> Result<(), StateError>;

    /// Computes everything that depends on the trial state, element by element, and adds residual and
    /// tangent, local unknowns eliminated, to a system if there is one.
    fn evaluate(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError>;

    /// Applies the local corrections that go with the global ones, but for numbers that have settled; the
    /// largest, in units of the measure (viscous stretches) and of the temperature.
    fn correct(&mut self, solution: &[[S; 1]], settled: S::Mask) -> S;

    /// Applies a share of the last corrections instead.
    fn apply(&mut self, share: S);

    /// The present trial is where the next correction starts; no local correction.
    fn hold(&mut self);

    /// Adds the nodal impulse `−h F` of the found response, N s, and, where it acts along the gradient of
    /// the scheme, the magnitude of what it is computed from to that of each node.
    fn add_impulse(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        along: Along,
        impulses: &mut Impulses<'_, S, D>,
        magnitudes: &mut [S],
    );

    /// Adds `(h w) A` and `−(h w) A q⁰`, where `A q_i` is the nodal force found at the stage of a set and w
    /// its weight in the rows of the set; moved anchors are taken from the trial. Only of stages.
    fn add_secant(
        &mut self,
        _set: usize,
        _: &StepView<'_, S>,
        _: &Trial<S, D>,
        _: &mut LinearSystem<S, D>,
    ) {
    }

    /// Adds the increments of the internal variables and of the reservoirs' entropies to a new state
    /// whose positions are known, and finds its temperatures and energies.
    fn close(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError>;

    /// The energy balances of the elements in the last step, from the old state to a closed one.
    fn recount(&self, ends: [&State<S>; 2], recount: &mut Recount<S>);

    /// What they contributed to the discrete GENERIC form of the last step, between two states.
    fn generic_of_step(&self, ends: [&State<S>; 2]) -> Vec<ElementGeneric<S>>;
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

impl<S, M, K, C, const D: usize> Elements<S, D> for ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    fn initialize(&mut self, state: &mut State<S>) -> Result<(), StateError> {
        self.initialize_all(state)
    }

    fn totals(&self, state: &State<S>) -> GroupTotals<S> {
        self.sum(state)
    }

    fn find_energies(&self, state: &mut State<S>) {
        self.find_all_energies(state);
    }

    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>> {
        self.generic_in_all(state)
    }

    fn slots(&self, place: usize) -> Slots {
        self.members[place].slots()
    }

    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S> {
        self.inspect_at(place, state)
    }

    fn digest(&self, digest: &mut Digest) {
        self.digest_all(digest);
    }

    fn audit(&self, state: &State<S>) -> Result<(), RestoreError> {
        self.audit_all(state)
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
        self.contacts.clear();
        for member in &mut self.members {
            let (nodes, slot) = (member.site.nodes, member.slots().thermal);
            member.site = Site::new(nodes, sites);
            member.meets_reservoirs =
                slot.is_some_and(|slot| sites.conduction.meets_reservoirs(slot));
            if let Some(contact) = Contact::new(&nodes, slot, sites) {
                member.contact = compact(self.contacts.len());
                self.contacts.push(contact);
            }
        }
    }

    fn begin(&mut self, view: &StepView<'_, S>, old: &mut Old<'_, S, D>) -> Result<(), StateError> {
        self.begin_all(view, old)
    }

    fn evaluate(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: Option<&mut LinearSystem<S, 1>>,
    ) -> Result<(), StateError> {
        self.evaluate_all(view, trial, system)
    }

    fn correct(&mut self, solution: &[[S; 1]], settled: S::Mask) -> S {
        self.correct_all(solution, settled)
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

    fn add_impulse(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        along: Along,
        impulses: &mut Impulses<'_, S, D>,
        magnitudes: &mut [S],
    ) {
        self.add_impulse_all(view, trial, along, (impulses, magnitudes));
    }

    fn close(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError> {
        self.close_all(view, trial, next, tally)
    }

    fn recount(&self, ends: [&State<S>; 2], recount: &mut Recount<S>) {
        self.recount_all(ends, recount);
    }

    fn generic_of_step(&self, ends: [&State<S>; 2]) -> Vec<ElementGeneric<S>> {
        self.generic_of_step_all(ends)
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

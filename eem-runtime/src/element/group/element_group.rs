//! The elements of one model, with one set of forces in a step.

use super::interface::{Elements, Group, Loose};
use super::loose::LooseElements;
use super::member::Member;
use super::point::Point;
use super::share::Share;
use super::site::{Contact, Site};
use super::view::{Along, ElementTotals, ElementView, Old, Placed, Sites, StepView, Trial};
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::ElementScheme;
use crate::element::error::StateError;
use crate::element::group::misfit::Misfit;
use crate::element::group::view::ElementGeneric;
use crate::element::impulse::Impulses;
use crate::element::kinematics::{Kinematics, Points, QuadraticStrain, SolidState};
use crate::element::layout::Slots;
use crate::element::recount::Recount;
use crate::element::state::State;
use crate::element::tally::Tally;
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::compact::compact;
use eem_material::number::digest::Digest;
use eem_material::number::scalar::Real;

/// Elements of the model `M` with the kinematics `K`, stepped by the scheme `C`.
pub(crate) struct ElementGroup<
    S: Real,
    M: Material<S>,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
    const D: usize,
> {
    pub(super) scheme: C,
    pub(super) members: Vec<Member<S, M, K, C, D>>,
    pub(super) contacts: Vec<Contact<K, S, D>>,
    /// Of elements with many points, some at a time.
    pub(super) shares: Vec<Share<K, S, D>>,
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    ElementGroup<S, M, K, C, D>
{
    pub(crate) fn new(scheme: C, loose: LooseElements<S, M, K, D>, placed: Placed<'_>) -> Self {
        let members = loose.elements.into_iter();
        let members = members.map(|parts| Member::new(scheme, parts, placed));
        Self {
            scheme,
            members: members.collect(),
            contacts: Vec::new(),
            shares: Vec::new(),
        }
    }

    /// What it was made of.
    pub(super) fn into_loose(self) -> LooseElements<S, M, K, D> {
        let elements = self.members.into_iter().map(Member::into_parts);
        LooseElements {
            elements: elements.collect(),
        }
    }

    /// All points.
    pub(super) fn points(&self) -> impl Iterator<Item = &Point<S, M, K, C, D>> {
        let members = self.members.iter();
        members.flat_map(|member| member.points.as_ref())
    }

    /// All points, to be changed.
    pub(super) fn points_mut(&mut self) -> impl Iterator<Item = &mut Point<S, M, K, C, D>> {
        let members = self.members.iter_mut();
        members.flat_map(|member| member.points.as_mut())
    }

    /// The element of the point at a place, and which of its points it is.
    pub(super) fn at(&self, place: usize) -> (&Member<S, M, K, C, D>, usize) {
        let points = K::PerPoint::<Point<S, M, K, C, D>>::LEN;
        (&self.members[place / points], place % points)
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    Elements<S, D> for ElementGroup<S, M, K, C, D>
{
    fn initialize(&mut self, state: &mut State<S>, refuse: &mut dyn FnMut(StateError)) {
        self.initialize_all(state, refuse);
    }

    fn add_totals(&self, state: &State<S>, totals: &mut ElementTotals<S>) {
        self.add_all_totals(state, totals);
    }

    fn find_energies(&self, state: &mut State<S>) {
        self.find_all_energies(state);
    }

    fn generic_in(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>> {
        self.generic_in_all(state)
    }

    fn slots(&self, place: usize) -> Slots {
        let (member, point) = self.at(place);
        member.points.as_ref()[point].slots()
    }

    fn inspect(&self, place: usize, state: &State<S>) -> ElementView<S> {
        self.inspect_at(place, state)
    }

    fn solid_state(&self, place: usize, state: &State<S>) -> Option<SolidState<S>> {
        self.solid_state_at(place, state)
    }

    fn dissipation(&self, place: usize, state: &State<S>, velocity: &dyn Fn(usize) -> [S; D]) -> S {
        self.dissipation_at(place, state, velocity)
    }

    fn digest(&self, digest: &mut Digest) {
        self.digest_all(digest);
    }

    fn audit(&self, state: &State<S>) -> Result<(), Misfit> {
        self.audit_all(state)
    }
}

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, C: ElementScheme<S, M>, const D: usize>
    Group<S, D> for ElementGroup<S, M, K, C, D>
{
    fn elements(&self) -> &dyn Elements<S, D> {
        self
    }

    fn elements_mut(&mut self) -> &mut dyn Elements<S, D> {
        self
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<S, D>> {
        Box::new(Self::into_loose(*self))
    }

    fn connect(&mut self, sites: &Sites<'_, S, D>) {
        self.contacts.clear();
        for member in &mut self.members {
            let nodes = member.site.nodes;
            member.site = Site::new(nodes, sites);
            for point in member.points.as_mut() {
                let slot = point.slots().thermal;
                point.meets_reservoirs =
                    slot.is_some_and(|slot| sites.conduction.meets_reservoirs(slot));
                if let Some(contact) = Contact::new(&nodes, slot, sites) {
                    point.contact = compact(self.contacts.len());
                    self.contacts.push(contact);
                }
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
        self.points_mut().for_each(|point| point.apply(share));
    }

    fn hold(&mut self) {
        self.points_mut().for_each(Point::hold);
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
pub(super) fn variables<S: Real, M: FreeEnergy<S>>(
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

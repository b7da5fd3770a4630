//! The elements of one model, with one set of forces in a step.

use super::ahead::Ahead;
use super::arms::change_in;
use super::interface::{Elements, Group, Loose};
use super::loose::{LooseElements, MakeExplicit};
use super::member::Member;
use super::placed::PlacedPoint;
use super::point::Point;
#[cfg(feature = "gradients")]
use super::point_step::{Direction, PastStep, PerVariable, SeeParameters, StepBack, StepWeights};
use super::share::Share;
use super::site::{Contact, Site};
use super::view::{Along, Old, Placed, Sites, StepView, Trial};
use crate::algebra::system::LinearSystem;
#[cfg(feature = "gradients")]
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Any, Exact, Family, OneSet, Placement};
use crate::element::error::StateError;
use crate::element::group::view::ElementGeneric;
use crate::element::impulse::Impulses;
use crate::element::kinematics::{Kinematics, MeasureSet, Points, QuadraticStrain};
use crate::element::state::State;
use crate::element::tally::{Reevaluation, Tally};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::compact::compact;
use eem_material::number::scalar::Scalar;

/// Elements of the model `A` with the kinematics `K`.
pub(crate) struct ElementGroup<A: Arrays, K: Kinematics<D>, const D: usize> {
    pub(super) scheme: OneSet,
    pub(super) members: Vec<Member<A, K, D>>,
    pub(super) contacts: Vec<Contact<K, D>>,
    make_explicit: MakeExplicit<D>,
    /// See [`Old::by_factors`].
    by_factors: bool,
    /// Workspace for elements with many points, a round of elements at a time.
    pub(super) shares: Vec<Share<K, D>>,
    /// Workspace for elements that are evaluated together.
    pub(super) ahead: Option<Box<Ahead<A>>>,
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> ElementGroup<A, K, D> {
    pub(crate) fn new(scheme: OneSet, loose: LooseElements<A, K, D>, placed: Placed<'_>) -> Self {
        // A loop: collected, it takes four times the code.
        let mut members = Vec::with_capacity(loose.elements.len());
        for parts in loose.elements {
            members.push(Member::new(scheme, parts, placed));
        }
        let ahead = if const { K::Measures::IS_SPRING } {
            Ahead::new(&mut members.iter().map(|member| &member.only().point.model))
        } else {
            None
        };
        Self {
            scheme,
            members,
            contacts: Vec::new(),
            make_explicit: loose.make_explicit,
            by_factors: false,
            shares: Vec::new(),
            ahead,
        }
    }

    /// The elements without the scheme.
    pub(super) fn into_loose(self) -> LooseElements<A, K, D> {
        let mut elements = Vec::with_capacity(self.members.len());
        for member in self.members {
            elements.push(member.into_parts());
        }
        LooseElements {
            elements,
            make_explicit: self.make_explicit,
        }
    }

    /// All points.
    pub(super) fn points(&self) -> impl Iterator<Item = &PlacedPoint<A, K, D>> {
        let members = self.members.iter();
        members.flat_map(|member| member.points.as_ref())
    }

    /// The element of the point with this index in the group, and the index of the point in the element.
    pub(super) fn at(&self, place: usize) -> (&Member<A, K, D>, usize) {
        let points = K::PerPoint::<PlacedPoint<A, K, D>>::LEN;
        (&self.members[place / points], place % points)
    }
}

/// The functions of a step, for a family of schemes.
impl<A: Arrays, K: Kinematics<D>, const D: usize> ElementGroup<A, K, D> {
    /// Whether the functions of exact schemes are compiled apart from those of all schemes. Not for arrays with room: it would take a step
    /// 12 % fewer instructions, and the runtime 5 % longer to compile.
    const IS_SEPARATE: bool = A::Drag::LEN == 0;

    /// Whether the loops are those for elements that are evaluated together. For the family of any scheme there are no others
    /// if the material may be evaluated so: one copy is compiled, a little slower.
    #[inline]
    fn is_together<C: Family>(&self) -> bool {
        K::Measures::IS_SPRING && (!C::IS_EXACT || self.ahead.is_some())
    }

    fn begin_as<C: Family>(
        &mut self,
        view: &StepView<'_>,
        old: &mut Old<'_, D>,
    ) -> Result<(), StateError> {
        let is_together = self.is_together::<C>();
        for member in &mut self.members {
            member.begin::<C>(view, old)?;
            if !is_together {
                member.keep(view);
            }
        }
        if const { K::Measures::IS_SPRING } && is_together {
            return self.keep_together(view);
        }
        Ok(())
    }

    fn evaluate_as<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        if const { K::Measures::IS_SPRING } && self.is_together::<C>() {
            return match system {
                Some(system) => self.linearize_together::<C>(view, trial, system),
                None => self.respond_together::<C>(view, trial),
            };
        }
        let Some(system) = system else {
            return self.respond_one_by_one::<C>(view, trial);
        };
        if const { K::PerPoint::<()>::LEN > 1 } {
            self.linearize_in_rounds::<C>(view, trial, system)
        } else {
            self.linearize_one_by_one::<C>(view, trial, system)
        }
    }

    fn correct_as<C: Family>(&mut self, solution: &[[f64; 1]]) -> f64 {
        let mut largest = 0.0;
        if Point::<A, K::Measures>::UNKNOWNS == 0 {
            return largest;
        }
        for member in &mut self.members {
            let motion = member.site.motion_in(solution);
            for point in member.points.as_mut() {
                let contact = point.contact_in(&self.contacts);
                let update = point.correct::<C>(&motion, contact, solution, self.by_factors);
                largest = Scalar::maximum(largest, update);
            }
        }
        largest
    }

    fn add_impulse_as<C: Family>(
        &self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        along: Along,
        impulses: &mut Impulses<'_, D>,
        magnitudes: &mut [f64],
    ) {
        let at = match along {
            Along::Secant => None,
            Along::Scheme => Some(C::placement(self.scheme)),
            Along::Gradient => Some(Placement::End),
            Along::Stage(_) => return,
        };
        for member in &self.members {
            let (nodes, r0) = (&member.site.nodes, &member.r0);
            let r1 = member.new_arms(trial);
            if !magnitudes.is_empty() {
                let change = change_in::<K, D>(nodes, trial);
                member.add_magnitude(view.step, [&r1, &change], magnitudes);
            }
            let (h, force) = if let Some(at) = at {
                let share = view.step * C::implicit(self.scheme);
                (share, member.force(at, [r0, &r1]))
            } else {
                let mut mean = change_in::<K, D>(nodes, trial);
                let old = r0.as_ref().as_flattened();
                for (mean, &old) in mean.as_mut().as_flattened_mut().iter_mut().zip(old) {
                    *mean = old + 0.5 * *mean;
                }
                (view.step, member.pull::<C>([r0, &r1], &mean))
            };
            for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                for (impulse, &force) in impulses.of(node as usize).iter_mut().zip(force) {
                    *impulse -= h * force;
                }
            }
        }
    }

    fn close_as<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        next: &mut State,
        tally: &mut Tally,
    ) -> Result<(), StateError> {
        if const { K::Measures::IS_SPRING } && self.is_together::<C>() {
            return self.close_together::<C>(view, trial, next, tally);
        }
        for member in &mut self.members {
            member.close::<C>(&self.contacts, (view, trial), next, tally, None)?;
        }
        Ok(())
    }
}

impl<A: Arrays, K: QuadraticStrain<D>, const D: usize> Group<D> for ElementGroup<A, K, D> {
    fn elements(&self) -> &dyn Elements<D> {
        self
    }

    fn elements_mut(&mut self) -> &mut dyn Elements<D> {
        self
    }

    fn into_loose(self: Box<Self>) -> Box<dyn Loose<D>> {
        Box::new(Self::into_loose(*self))
    }

    fn connect(&mut self, sites: &Sites<'_, D>) {
        self.contacts.clear();
        for member in &mut self.members {
            let nodes = member.site.nodes;
            member.site = Site::new(nodes, sites);
            for point in member.points.as_mut() {
                let slot = point.slots().thermal;
                point.meets_reservoirs =
                    slot.is_some_and(|slot| sites.conduction.meets_reservoirs(slot));
                point.settling = slot.map_or(0.0, |slot| sites.conduction.settling(slot));
                if let Some(contact) = Contact::new(&nodes, slot, sites) {
                    point.contact = compact(self.contacts.len());
                    self.contacts.push(contact);
                }
            }
        }
    }

    fn begin(&mut self, view: &StepView<'_>, old: &mut Old<'_, D>) -> Result<(), StateError> {
        self.by_factors = old.by_factors;
        if const { Self::IS_SEPARATE } && matches!(self.scheme, OneSet::Exact(_)) {
            self.begin_as::<Exact>(view, old)
        } else {
            self.begin_as::<Any>(view, old)
        }
    }

    fn evaluate(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: Option<&mut LinearSystem<1>>,
    ) -> Result<(), StateError> {
        if const { Self::IS_SEPARATE } && matches!(self.scheme, OneSet::Exact(_)) {
            self.evaluate_as::<Exact>(view, trial, system)
        } else {
            self.evaluate_as::<Any>(view, trial, system)
        }
    }

    fn correct(&mut self, solution: &[[f64; 1]]) -> f64 {
        if const { Self::IS_SEPARATE } && matches!(self.scheme, OneSet::Exact(_) | OneSet::Damped) {
            self.correct_as::<Exact>(solution)
        } else {
            self.correct_as::<Any>(solution)
        }
    }

    fn apply(&mut self, share: f64) {
        for member in &mut self.members {
            for point in member.points.as_mut() {
                point.apply::<Any>(share, self.by_factors);
            }
        }
    }

    fn hold(&mut self) {
        for member in &mut self.members {
            for point in member.points.as_mut() {
                point.hold::<Any>();
            }
        }
    }

    fn add_impulse(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        along: Along,
        impulses: &mut Impulses<'_, D>,
        magnitudes: &mut [f64],
    ) {
        if const { Self::IS_SEPARATE } && matches!(self.scheme, OneSet::Exact(_)) {
            self.add_impulse_as::<Exact>(view, trial, along, impulses, magnitudes);
        } else {
            self.add_impulse_as::<Any>(view, trial, along, impulses, magnitudes);
        }
    }

    fn close(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        next: &mut State,
        tally: &mut Tally,
    ) -> Result<(), StateError> {
        if const { Self::IS_SEPARATE } && matches!(self.scheme, OneSet::Exact(_)) {
            self.close_as::<Exact>(view, trial, next, tally)
        } else {
            self.close_as::<Any>(view, trial, next, tally)
        }
    }

    fn reevaluate(&self, ends: [&State; 2], reevaluation: &mut Reevaluation) {
        for member in &self.members {
            for point in member.points.as_ref() {
                let own = point.balance_between(&member.site.nodes, ends);
                let found = Point::<A, K::Measures>::change_of(&point.response, &own.increments);
                reevaluation.element(point.element, own.by_values, own.by_differences, found);
            }
        }
    }

    fn generic_of_step(&self, ends: [&State; 2], see: &mut dyn FnMut(ElementGeneric)) {
        for member in &self.members {
            let [r0, r1] = [member.arms_in(ends[0]), member.arms_in(ends[1])];
            let at = (self.scheme.placement(), [&r0, &r1]);
            for point in member.points.as_ref() {
                see(point.generic(&member.site.nodes, at));
            }
        }
    }

    #[cfg(feature = "gradients")]
    fn find_interfaces(
        &mut self,
        step: &PastStep<'_>,
        interface: &mut InterfaceTemperatures,
    ) -> Result<(), StateError> {
        Self::find_interfaces(self, step, interface)
    }

    #[cfg(feature = "gradients")]
    fn pull_back(
        &mut self,
        step: &StepBack<'_>,
        interface: &InterfaceTemperatures,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        Self::pull_back(self, step, interface, system)
    }

    #[cfg(feature = "gradients")]
    fn recover(
        &mut self,
        step: &StepBack<'_>,
        interface: &InterfaceTemperatures,
        solution: &[[f64; 1]],
        found: (&mut PerVariable, &mut StepWeights),
        see: &mut SeeParameters<'_>,
    ) {
        Self::recover(self, step, interface, solution, found, see);
    }

    #[cfg(feature = "gradients")]
    fn push_forward(
        &mut self,
        step: &PastStep<'_>,
        temperatures: (&InterfaceTemperatures, &mut [f64]),
        system: &mut LinearSystem<1>,
        directions: &mut [Direction],
    ) -> Result<(), StateError> {
        Self::push_forward(self, step, temperatures, system, directions)
    }

    #[cfg(feature = "gradients")]
    fn follow(&self, directions: &mut [Direction]) {
        Self::follow(self, directions);
    }

    #[cfg(feature = "gradients")]
    fn energy_by_parameters(&self, state: &State, see: &mut SeeParameters<'_>) {
        Self::energy_by_parameters(self, state, see);
    }
}

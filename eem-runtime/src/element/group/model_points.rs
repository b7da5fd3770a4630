//! The points of one model, in a state and in a step.

use core::any::Any;
use core::marker::PhantomData;

use super::ahead::Ahead;
use super::arms::measures_in;
use super::audit::Misfit;
use super::inspect::digest_kind;
use super::point::{Point, variables};
#[cfg(feature = "gradients")]
use super::point_step::SeeParameters;
use super::points::{
    Exchange, HasPoints, Measured, PointEnd, PointGeneric, PointPlace, PointSet, PointsInState,
    TrialView,
};
#[cfg(feature = "gradients")]
use super::push_forward::changes::Linearized;
use super::site::HeatContact;
use super::stiffness::{Stiffness, stiffness_of};
use super::view::{Before, ElementTotals, ElementView, StepView};
use crate::element::conduction::Conduction;
use crate::element::conjugates::{Family, OneSet};
use crate::element::error::StateError;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::state::{Energy, State};
use crate::element::tally::{Reevaluation, Tally};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::digest::Digest;
use eem_material::tabled::Tabled;

/// Points of models in the arrays `A`, with schemes of the family `C`.
pub(super) struct ModelPoints<A: Arrays, Q: MeasureSet, C> {
    scheme: OneSet,
    pub(super) points: Vec<Point<A, Q>>,
    /// See [`Old::by_factors`](super::view::Old::by_factors).
    by_factors: bool,
    /// Workspace for points that are evaluated in one call.
    ahead: Option<Box<Ahead<A>>>,
    /// The equations of the point that was linearized last in a completed step.
    #[cfg(feature = "gradients")]
    pub(super) linearized: Option<Box<Linearized<A>>>,
    /// For derivatives by parameters.
    #[cfg(feature = "gradients")]
    pub(super) workspaces: [Vec<f64>; 2],
    family: PhantomData<C>,
}

impl<A: Arrays, Q: MeasureSet, C: Family> ModelPoints<A, Q, C> {
    /// So many points, of these models at their places.
    pub(super) fn new(
        scheme: OneSet,
        (models, places, count): (
            &mut dyn Iterator<Item = Tabled<A>>,
            &mut dyn Iterator<Item = PointPlace>,
            usize,
        ),
    ) -> Self {
        // A loop: collected, it takes four times the code.
        let mut points = Vec::with_capacity(count);
        for ((element, slots), model) in places.zip(models).take(count) {
            points.push(Point::new(scheme, element, model, slots));
        }
        let ahead = if const { Q::IS_SPRING && !C::IS_EXACT } {
            Ahead::new(&points)
        } else {
            None
        };
        Self {
            scheme,
            points,
            by_factors: false,
            ahead,
            #[cfg(feature = "gradients")]
            linearized: None,
            #[cfg(feature = "gradients")]
            workspaces: [const { Vec::new() }; 2],
            family: PhantomData,
        }
    }

    /// The variables of a point in a state with these measures.
    fn x(&self, index: usize, measures: &Numbers<Q>, state: &State) -> A::Variables {
        self.points[index].variables_in(measures, state)
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Its variables in a state with these measures.
    #[inline]
    pub(super) fn variables_in(&self, measures: &Numbers<Q>, state: &State) -> A::Variables {
        variables(&self.model, measures.as_ref(), self.slots(), state)
    }
}

impl<A: Arrays, Q: MeasureSet, C: Family> HasPoints<Q> for ModelPoints<A, Q, C> {
    fn in_state(&self) -> &dyn PointsInState<Q> {
        self
    }

    fn in_state_mut(&mut self) -> &mut dyn PointsInState<Q> {
        self
    }

    fn into_models(self: Box<Self>) -> Box<dyn Any> {
        let mut models = Vec::with_capacity(self.points.len());
        for point in self.points {
            models.push(point.model);
        }
        Box::new(models)
    }
}

impl<A: Arrays, Q: MeasureSet, C: Family> PointsInState<Q> for ModelPoints<A, Q, C> {
    fn place(&self, index: usize) -> PointPlace {
        (self.points[index].element, self.points[index].slots())
    }

    fn initialize(
        &mut self,
        index: usize,
        [measures, sizes]: [&Numbers<Q>; 2],
        state: &mut State,
    ) -> Result<(), StateError> {
        let x = self.x(index, measures, state);
        let point = &mut self.points[index];
        let mut energy = point.initialize(&x, state)?;
        point.add_bounds(sizes, &x, &mut energy);
        state.energies[point.element.index()] = energy;
        Ok(())
    }

    fn energy(&self, index: usize, at: &Measured<'_, Q>) -> Energy {
        let (x, point) = (self.x(index, at.measures, at.state), &self.points[index]);
        let mut energy = point.energy_in(&x, at.state);
        point.add_bounds(at.sizes, &x, &mut energy);
        energy
    }

    fn add_totals(
        &self,
        index: usize,
        measures: &Numbers<Q>,
        state: &State,
        totals: &mut ElementTotals,
    ) {
        let (x, point) = (self.x(index, measures, state), &self.points[index]);
        totals.energy.add(point.internal_energy(&x, state));
        if let Some(slot) = point.slots().thermal {
            totals.entropy.add_sum(state.entropies.sum(slot));
            totals.entropy_of_state.add(point.model.caloric(&x).entropy);
        }
    }

    fn view(&self, index: usize, measures: &Numbers<Q>, state: &State) -> ElementView {
        let (x, point) = (self.x(index, measures, state), &self.points[index]);
        ElementView {
            measure: x[0],
            force: point.model.gradient(&x)[0],
            internal_energy: point.internal_energy(&x, state),
        }
    }

    fn forces(&self, index: usize, measures: &Numbers<Q>, state: &State) -> Numbers<Q> {
        let x = self.x(index, measures, state);
        measures_in::<Q>(&self.points[index].model.gradient(&x))
    }

    fn dissipation(&self, index: usize, [measures, rates]: [&Numbers<Q>; 2], state: &State) -> f64 {
        let (x, point) = (self.x(index, measures, state), &self.points[index]);
        let mut power = point.power_in_series(&x);
        let (drags, _) = point.model.drag(x[A::Variables::LEN - 1]);
        for (&drag, &rate) in drags.as_ref().iter().zip(rates.as_ref()) {
            power += drag * rate * rate;
        }
        power
    }

    fn stiffness<'a>(
        &self,
        index: usize,
        at: &Measured<'_, Q>,
        (nodes, length, slopes): (&'a [u32], f64, &Numbers<Q>),
    ) -> Stiffness<'a> {
        let (x, point) = (self.x(index, at.measures, at.state), &self.points[index]);
        let of = (&point.model, nodes, point.slots());
        stiffness_of::<A, Q>(of, &x, (length, slopes, at.sizes))
    }

    fn take_derivatives(&mut self, index: usize, measures: &Numbers<Q>, state: &State) {
        let x = self.x(index, measures, state);
        self.points[index].take_derivatives(&x);
    }

    fn generic(&self, index: usize) -> PointGeneric<Q> {
        self.points[index].generic()
    }

    fn entropy_slopes(&self, index: usize) -> (Numbers<Q>, Vec<f64>, f64) {
        self.points[index].entropy_slopes()
    }

    fn digest(&self, index: usize, is_first: bool, digest: &mut Digest) {
        let point = &self.points[index];
        if is_first {
            digest_kind(&point.model, digest);
        }
        point.digest(digest);
    }

    fn audit(&self, index: usize, measures: &Numbers<Q>, state: &State) -> Result<(), Misfit> {
        let (x, point) = (self.x(index, measures, state), &self.points[index]);
        point.audit_response(&x)?;
        point.audit_entropy(&x, state)
    }

    #[cfg(feature = "gradients")]
    fn parameters(&self) -> (&'static [&'static str], &'static [&'static str], bool) {
        // The models of a group are of one kind.
        let Some(first) = self.points.first() else {
            return (&[], &[], false);
        };
        let facts = first.model.facts();
        (
            first.model.parameter_names(),
            facts.parameter_units,
            facts.has_parameter_derivatives,
        )
    }

    #[cfg(feature = "gradients")]
    fn parameter(&self, index: usize, parameter: usize) -> f64 {
        self.points[index].model.parameter(parameter)
    }

    #[cfg(feature = "gradients")]
    fn energy_by_parameters(
        &self,
        index: usize,
        measures: &Numbers<Q>,
        state: &State,
        see: &mut SeeParameters<'_>,
    ) {
        let (x, point) = (self.x(index, measures, state), &self.points[index]);
        let mut found = vec![0.0; point.model.facts().derivatives];
        point.model.energy_by_parameters(&x, &mut found);
        see(point.element, &found);
    }
}

#[expect(
    clippy::inline_always,
    reason = "where the points are not behind a table, a step is compiled as a whole"
)]
impl<A: Arrays, Q: MeasureSet, C: Family> PointSet<Q> for ModelPoints<A, Q, C> {
    #[cfg(feature = "gradients")]
    fn contact(&self, index: usize) -> usize {
        self.points[index].contact as usize
    }

    fn connect(&mut self, index: usize, contact: u32, conduction: &Conduction) {
        let point = &mut self.points[index];
        let slot = point.slots().thermal;
        point.contact = contact;
        point.meets_reservoirs = slot.is_some_and(|slot| conduction.meets_reservoirs(slot));
    }

    #[inline(always)]
    fn begin(
        &mut self,
        index: usize,
        view: &StepView<'_>,
        (before, by_factors): (Option<&Before<'_>>, bool),
        measures: &Numbers<Q>,
    ) {
        self.by_factors = by_factors;
        let point = &mut self.points[index];
        point.begin::<C>(view, before, measures);
        if C::IS_EXACT || self.ahead.is_none() {
            point.keep_old(view);
        }
    }

    fn keep_together(&mut self, view: &StepView<'_>) {
        if let Some(ahead) = &mut self.ahead
            && !ahead.keep(self.scheme, &mut self.points)
        {
            for point in &mut self.points {
                point.keep_old(view);
            }
        }
    }

    fn take_old_share(
        &mut self,
        index: usize,
        view: &StepView<'_>,
        speeds: &Numbers<Q>,
    ) -> Result<Numbers<Q>, StateError> {
        self.points[index].take_old_share(view, speeds)
    }

    fn is_together(&self) -> bool {
        self.ahead.is_some()
    }

    fn evaluate_together(
        &mut self,
        at: &TrialView<'_>,
        measures: &[Numbers<Q>],
        has_tangent: bool,
    ) {
        if let Some(ahead) = &mut self.ahead {
            let (at, points) = ((self.scheme, at.is_start), &self.points);
            ahead.is_known = ahead.respond(at, (points, measures), has_tangent);
        }
    }

    fn close_together(&mut self, at: &TrialView<'_>, measures: &[Numbers<Q>], next: &mut State) {
        if let Some(ahead) = &mut self.ahead {
            let states = (at.view.state, next);
            ahead.is_known = const { A::THERMAL }
                && !self.scheme.is_in_temperature()
                && ahead.close(&self.points, measures, states);
        }
    }

    #[inline(always)]
    fn linearize(
        &mut self,
        index: usize,
        at: &TrialView<'_>,
        exchange: &mut Exchange<Q>,
    ) -> Result<(), StateError> {
        let point = &mut self.points[index];
        let known = known_of::<A, C>(self.ahead.as_deref());
        let form = known.map(|ahead| ahead.give(index, point));
        point.linearize::<C>(at, form, exchange)
    }

    #[inline(always)]
    fn respond(
        &mut self,
        index: usize,
        at: &TrialView<'_>,
        exchange: &Exchange<Q>,
    ) -> Result<(), StateError> {
        let point = &mut self.points[index];
        let known = known_of::<A, C>(self.ahead.as_deref());
        if let Some(ahead) = known {
            ahead.give(index, point);
            point.response = ahead.responses[index];
        }
        point.respond::<C>(at, exchange, known.is_some())
    }

    #[inline(always)]
    fn correct(
        &mut self,
        index: usize,
        changes: (&Numbers<Q>, f64),
        contacts: &[HeatContact],
        solution: &[[f64; 1]],
    ) -> f64 {
        let point = &mut self.points[index];
        let contact = point.contact_in(contacts);
        point.correct::<C>(changes, contact, solution, self.by_factors)
    }

    fn apply(&mut self, share: f64) {
        for point in &mut self.points {
            point.apply::<C>(share, self.by_factors);
        }
    }

    fn hold(&mut self) {
        for point in &mut self.points {
            point.hold::<C>();
        }
    }

    #[inline(always)]
    fn pull(&self, index: usize) -> Numbers<Q> {
        self.points[index].pulls::<C>()
    }

    fn magnitude_of_pull(&self, index: usize, of_nodes: [&Numbers<Q>; 3]) -> f64 {
        self.points[index].magnitude_of_pull(of_nodes)
    }

    #[inline(always)]
    fn close(
        &mut self,
        index: usize,
        at: &TrialView<'_>,
        end: &PointEnd<Q>,
        next_and_tally: (&mut State, &mut Tally),
    ) -> Result<(), StateError> {
        let known = known_of::<A, C>(self.ahead.as_deref());
        let known = known.map(|ahead| &ahead.caloric[index]);
        self.points[index].close::<C>(at, end, next_and_tally, known)
    }

    fn reevaluate(
        &self,
        index: usize,
        of_nodes: ([&Numbers<Q>; 2], &Numbers<Q>),
        ends: [&State; 2],
        reevaluation: &mut Reevaluation,
    ) {
        let point = &self.points[index];
        let own = point.balance_between(of_nodes, ends);
        let found = Point::<A, Q>::change_of(&point.response, &own.increments);
        reevaluation.element(point.element, own.by_values, own.by_differences, found);
    }
}

/// What has been evaluated of all points in one call.
#[inline]
fn known_of<A: Arrays, C: Family>(ahead: Option<&Ahead<A>>) -> Option<&Ahead<A>> {
    if C::IS_EXACT {
        return None;
    }
    ahead.filter(|ahead| ahead.is_known)
}

//! An element in a completed step between two states of a history, for the adjoint and the tangents of the step.
//!
//! When the two states are exchanged, the response `(f*, g*, θ*, Δs)` of a point stays, except Δs, which changes sign. So its
//! derivative with respect to the old state is the tangent of the form from the new state to the old one, with the row of Δs
//! negated. The mean-value gradients of the measures stay, too.

use super::member::Member;
use super::model_points::ModelPoints;
use super::placed::PlacedPoint;
use super::point::{Point, temperature_in};
use super::point_step::{
    Direction, PastStep, PerVariable, Reduced, SeeParameters, StepBack, StepWeights, Surroundings,
    Weighed,
};
use super::points::{Exchange, PastPoints, TrialView};
use super::site::{HeatContact, paths_of};
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Exact, Family, Form, Start, exchanged};
use crate::element::error::StateError;
use crate::element::kinematics::{Arms, Ends, Kinematics, MeasureSet, Measures, Numbers};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// A point in both states of a step: its arms and measures.
pub(super) struct PastEnds<K: Kinematics<D>, const D: usize> {
    pub(super) arms: [Arms<K, D>; 2],
    pub(super) measures: [Measures<K, D>; 2],
}

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// Its arms in both states.
    #[inline]
    pub(super) fn past_arms(&self, step: &PastStep<'_>) -> [Arms<K, D>; 2] {
        [step.view.state, step.new].map(|state| self.arms_in(state))
    }
}

impl<K: Kinematics<D>, const D: usize> PlacedPoint<K, D> {
    #[inline]
    pub(super) fn past_ends(&self, arms: [Arms<K, D>; 2]) -> PastEnds<K, D> {
        PastEnds {
            arms,
            measures: arms.map(|r| self.kinematics.measure(&r)),
        }
    }
}

impl<K: Kinematics<D>, const D: usize> PastEnds<K, D> {
    #[inline]
    pub(super) fn forward(&self, kinematics: &K) -> Ends<K, D> {
        Ends::new(kinematics, self.arms, self.measures)
    }

    /// With the two states exchanged.
    #[inline]
    pub(super) fn back(&self, kinematics: &K) -> Ends<K, D> {
        let ([r0, r1], [old, new]) = (self.arms, self.measures);
        Ends::new(kinematics, [r1, r0], [new, old])
    }
}

impl<A: Arrays, Q: MeasureSet, C: Family> PastPoints<Q> for ModelPoints<A, Q, C> {
    fn find_interface(
        &mut self,
        index: usize,
        step: &PastStep<'_>,
        measures: [&Numbers<Q>; 2],
    ) -> Result<f64, StateError> {
        let point = &mut self.points[index];
        point.return_to(step, measures)?;
        let (start, model) = (&point.start, &point.model);
        let response = start.response::<Exact>(point.scheme, model, &point.x, &point.corners);
        Ok(temperature_in::<A>(&response))
    }

    fn condense_transposed(
        &mut self,
        index: usize,
        step: &StepBack<'_>,
        (interface, contact): (&InterfaceTemperatures, Option<&HeatContact>),
        measures: [&Numbers<Q>; 2],
    ) -> Result<Reduced<Q>, StateError> {
        let point = &mut self.points[index];
        if contact.is_none() {
            point.return_to(&step.past, measures)?;
        }
        let form = point.tangent_in(step.past.view.per_step)?;
        point.condense_transposed(step, interface, &form, paths_of(contact))
    }

    fn weigh(
        &mut self,
        index: usize,
        around: &Surroundings<'_>,
        (along, has_by_new): (&Numbers<Q>, bool),
        found: (&mut PerVariable, &mut StepWeights),
        see: &mut SeeParameters<'_>,
    ) -> Weighed<Q> {
        let workspaces = &mut self.workspaces;
        self.points[index].weighed(around, (along, has_by_new), found, (see, workspaces))
    }

    fn linearize_past(
        &mut self,
        index: usize,
        step: &PastStep<'_>,
        (interface, contact): (&InterfaceTemperatures, Option<&HeatContact>),
        measures: [&Numbers<Q>; 2],
    ) -> Result<(Exchange<Q>, f64), StateError> {
        let point = &mut self.points[index];
        if contact.is_none() {
            point.return_to(step, measures)?;
        }
        let linear = point.linearize_past(step, interface, paths_of(contact))?;
        let at = TrialView {
            view: &step.view,
            interface,
            is_start: false,
            contacts: &[],
        };
        let mut exchange = Exchange::none();
        point.answer::<Exact>(&linear.form, (&at, contact.is_some()), &mut exchange);
        let theta = temperature_in::<A>(&linear.form.0);
        match &mut self.linearized {
            Some(room) => **room = linear,
            none => *none = Some(Box::new(linear)),
        }
        Ok((exchange, theta))
    }

    fn push(
        &self,
        index: usize,
        step: &PastStep<'_>,
        (interface, contact): (&InterfaceTemperatures, Option<&HeatContact>),
        moved: &Numbers<Q>,
        direction: &mut Direction,
    ) -> Result<Numbers<Q>, StateError> {
        let linear = self.linearized.as_deref();
        let linear = linear.unwrap_or_else(|| unreachable!("it has been linearized"));
        let (point, around) = (&self.points[index], (interface, paths_of(contact)));
        let change = point.change(step, around, moved, linear, direction);
        let unknown = contact.map(|contact| contact.unknown as usize);
        point.push(linear, &change, unknown, direction)
    }

    fn follow(
        &self,
        index: usize,
        changes: &Numbers<Q>,
        contact: Option<&HeatContact>,
        direction: &mut Direction,
    ) {
        let point = &self.points[index];
        let heat =
            contact.map(|contact| point.condensed.heat_factor * contact.heat(&direction.right));
        point.follow(changes, heat, direction);
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Sets both states, and what depends on them.
    fn return_to(
        &mut self,
        step: &PastStep<'_>,
        [old, new]: [&Numbers<Q>; 2],
    ) -> Result<(), StateError> {
        let x0 = self.variables_in(old, step.view.state);
        let x1 = self.variables_in(new, step.new);
        self.x = x1;
        let mut theta = 1.0;
        if let Some(slot) = self.slots().thermal {
            theta = x0[Self::TEMPERATURE];
            self.is_prescribed = step.held[slot];
        }
        self.start = self.start_from(&x0);
        self.corners = A::Corners::filled(theta);
        (self.start)
            .prepare(&self.model, &self.x, &mut self.corners)
            .map_err(|infeasible| infeasible.of(self.element))?;
        for k in 0..self.dashpots() {
            self.creep[k] = self.x[A::MEASURES + k] - x0[A::MEASURES + k];
        }
        for a in 0..self.drags() {
            self.drag.extension[a] = self.x[a] - x0[a];
        }
        Ok(())
    }

    /// A step from these variables.
    #[inline]
    fn start_from(&self, x0: &A::Variables) -> Start<A> {
        let mut start = Start {
            x0: *x0,
            ..Start::nothing()
        };
        start.keep(self.scheme, &self.model, 0.0, self.is_prescribed);
        start
    }

    /// Its response with tangent, including Kelvin–Voigt dashpots.
    #[inline]
    pub(super) fn tangent_in(&mut self, per_step: f64) -> Result<Form<A>, StateError> {
        let mut form = self.form::<Exact>(false);
        self.accept::<Exact>(per_step, &form, false)?;
        self.response = form.0;
        self.add_drag::<Exact>(per_step, &mut form);
        Ok(form)
    }

    /// The derivatives of the response with respect to the variables of the old state.
    #[inline]
    pub(super) fn slopes_by_old(&self) -> A::Tangent {
        let start = self.start_from(&self.x);
        let corners = exchanged::<A>(&self.corners);
        let (_, mut tangent) =
            start.form::<Exact>(self.scheme, &self.model, &self.start.x0, &corners);
        if self.is_thermal() {
            for slope in tangent[Self::ENTROPY].as_mut() {
                *slope = -*slope;
            }
        }
        tangent
    }
}

//! An element in a completed step between two states of a history, for the adjoint and the tangents of the step.
//!
//! When the two states are exchanged, the response `(f*, g*, θ*, Δs)` of a point stays, except Δs, which changes sign. So its
//! derivative with respect to the old state is the tangent of the form from the new state to the old one, with the row of Δs
//! negated. The mean-value gradients of the measures stay, too.

use super::arms::measures_in;
use super::member::Member;
use super::placed::PlacedPoint;
use super::point::Point;
use super::point_step::PastStep;
use crate::element::conjugates::{Exact, Form, Start, exchanged};
use crate::element::error::StateError;
use crate::element::kinematics::{Arms, Ends, Kinematics, MeasureSet};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// Its arms in both states.
    #[inline]
    pub(super) fn past_arms(&self, step: &PastStep<'_>) -> [Arms<K, D>; 2] {
        [step.view.state, step.new].map(|state| self.arms_in(state))
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> PlacedPoint<A, K, D> {
    /// Sets both states, and what depends on them, to those of a step.
    #[inline]
    pub(super) fn return_to(
        &mut self,
        step: &PastStep<'_>,
        arms: &[Arms<K, D>; 2],
    ) -> Result<(), StateError> {
        let [r0, r1] = arms;
        let x0 = self.variables_in(r0, step.view.state);
        let x1 = self.variables_in(r1, step.new);
        self.point.return_to(step, [x0, x1])
    }

    /// The arms and measures of both states.
    #[inline]
    pub(super) fn ends(&self, arms: [Arms<K, D>; 2]) -> Ends<K, D> {
        let measures = [&self.start.x0, &self.x].map(measures_in::<K::Measures>);
        Ends::new(&self.kinematics, arms, measures)
    }

    /// The same with the two states exchanged.
    #[inline]
    pub(super) fn ends_back(&self, [r0, r1]: [Arms<K, D>; 2]) -> Ends<K, D> {
        let measures = [&self.x, &self.start.x0].map(measures_in::<K::Measures>);
        Ends::new(&self.kinematics, [r1, r0], measures)
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Sets both states, and what depends on them.
    fn return_to(
        &mut self,
        step: &PastStep<'_>,
        [x0, x1]: [A::Variables; 2],
    ) -> Result<(), StateError> {
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

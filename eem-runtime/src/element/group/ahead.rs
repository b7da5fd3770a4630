//! What a material evaluates of several springs in one call, ahead of the loop over the springs. The values have the bits of those evaluated
//! one by one.

use super::point::{Point, Viscosities, variables};
use crate::element::conjugates::{Form, OneSet, find_corners_together};
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::formulas::TogetherIn;
use eem_material::free_energy::{Array, Caloric, ExactForm, MOST_TOGETHER, Steps};

/// Room for the values of points that are evaluated in one call.
pub(super) struct Ahead<A: Arrays> {
    /// Whether the values are those of the present trial.
    pub(super) is_known: bool,
    pub(super) x: [A::Variables; MOST_TOGETHER],
    pub(super) corners: [A::Corners; MOST_TOGETHER],
    pub(super) forms: [Form<A>; MOST_TOGETHER],
    pub(super) responses: [A::Response; MOST_TOGETHER],
    pub(super) viscosities: [Viscosities<A>; MOST_TOGETHER],
    pub(super) caloric: [(Caloric<f64>, f64); MOST_TOGETHER],
}

/// Places without length.
fn no_places<'a>() -> [&'a mut [f64]; MOST_TOGETHER] {
    core::array::from_fn(|_| Default::default())
}

/// The functions of a block, unless its points are too few for a call.
fn together<A: Arrays, Q: MeasureSet>(points: &[Point<A, Q>]) -> Option<&TogetherIn<A>> {
    let together = points.first()?.model.together();
    together.filter(|together| points.len() >= together.least())
}

/// The form of a scheme and the functions with which a block evaluates it in one call; not if a thermostat prescribes a
/// temperature, with which the form may be another one.
fn form_together<A: Arrays, Q: MeasureSet>(
    scheme: OneSet,
    points: &[Point<A, Q>],
) -> Option<(ExactForm, &TogetherIn<A>)> {
    let form = scheme.form().zip(together(points));
    form.filter(|_| !points.iter().any(|point| point.is_prescribed))
}

impl<A: Arrays> Ahead<A> {
    /// For these points; `None` if they are evaluated one by one.
    pub(super) fn new<Q: MeasureSet>(points: &[Point<A, Q>]) -> Option<Box<Self>> {
        let first = together(points)?;
        let is_same = |point: &Point<A, Q>| {
            let own = point.model.together();
            own.is_some_and(|own| core::ptr::addr_eq(own, first))
        };
        if !points.iter().all(is_same) {
            return None;
        }
        let (x, response) = (A::Variables::filled(0.0), A::Response::filled(0.0));
        let viscosities = A::Viscosities::filled(0.0);
        let caloric = Caloric {
            entropy: 0.0,
            heat_capacity: 0.0,
            magnitude: 0.0,
        };
        Some(Box::new(Self {
            is_known: false,
            x: [x; MOST_TOGETHER],
            corners: [A::Corners::filled(0.0); MOST_TOGETHER],
            forms: [(response, A::Tangent::filled(x)); MOST_TOGETHER],
            responses: [response; MOST_TOGETHER],
            viscosities: [(viscosities, viscosities); MOST_TOGETHER],
            caloric: [(caloric, 0.0); MOST_TOGETHER],
        }))
    }

    /// Stores what the form of a scheme keeps of the old state of a block.
    pub(super) fn keep<Q: MeasureSet>(
        &mut self,
        scheme: OneSet,
        points: &mut [Point<A, Q>],
    ) -> bool {
        let Some((form, _)) = form_together(scheme, points) else {
            return false;
        };
        let mut kept = no_places();
        let (count, mut together) = (points.len(), None);
        for ((x0, kept), point) in self.x.iter_mut().zip(&mut kept).zip(points) {
            let Point { model, start, .. } = point;
            (*x0, *kept) = (start.x0, start.room_for(form));
            together = model.together();
        }
        together.is_some_and(|together| {
            together.keep(form, &self.x[..count], &mut kept[..count]);
            true
        })
    }

    /// Evaluates the forms of a block at a trial, or the responses alone. `false` if the points are to be evaluated one by one;
    /// so they are, too, if there is no solution: then the error is that of the first point that has one.
    pub(super) fn respond<Q: MeasureSet>(
        &mut self,
        (scheme, is_start): (OneSet, bool),
        (points, measures): (&[Point<A, Q>], &[Numbers<Q>]),
        has_tangent: bool,
    ) -> bool {
        let form = form_together(scheme, points);
        let Some((form, together)) = form.filter(|_| !is_start) else {
            return false;
        };
        for (x, (point, measures)) in self.x.iter_mut().zip(points.iter().zip(measures)) {
            *x = point.x;
            for (a, &measure) in measures.as_ref().iter().enumerate() {
                x[a] = measure;
            }
        }
        self.evaluate((form, together), points, has_tangent)
    }

    /// The same at the variables that are stored.
    fn evaluate<Q: MeasureSet>(
        &mut self,
        (form, together): (ExactForm, &TogetherIn<A>),
        points: &[Point<A, Q>],
        has_tangent: bool,
    ) -> bool {
        let count = points.len();
        let mut kept: [&[f64]; MOST_TOGETHER] = [&[]; MOST_TOGETHER];
        for (index, (kept, point)) in kept.iter_mut().zip(points).enumerate() {
            self.corners[index] = point.corners;
            *kept = point.start.kept();
        }
        let (x1, kept) = (&self.x[..count], &kept[..count]);
        let corners = &mut self.corners[..count];
        if points[0].is_thermal() && form == ExactForm::Entropy {
            let ends = |index: usize| {
                let Point { model, start, .. } = &points[index];
                (model, [&start.x0, &x1[index]])
            };
            if find_corners_together(together, ends, (kept, x1), corners).is_err() {
                return false;
            }
        }
        let steps = Steps { kept, x1, corners };
        // Materials without temperature ignore it, so that any entry will do.
        let at = Point::<A, Q>::TEMPERATURE * usize::from(A::THERMAL);
        let mut theta = [0.0; MOST_TOGETHER];
        if has_tangent {
            let forms = &mut self.forms[..count];
            together.form(form, steps, forms);
            for (theta, (response, _)) in theta.iter_mut().zip(forms) {
                *theta = response[at];
            }
        } else {
            let responses = &mut self.responses[..count];
            together.response(form, steps, responses);
            for (theta, response) in theta.iter_mut().zip(responses) {
                *theta = response[at];
            }
        }
        if A::DASHPOTS > 0 {
            together.viscosity(&theta[..count], &mut self.viscosities[..count]);
        }
        true
    }

    /// Stores the temperatures of mixed states and the viscosities of a point of the block; returns its form.
    #[inline]
    pub(super) fn give<Q: MeasureSet>(&self, index: usize, point: &mut Point<A, Q>) -> &Form<A> {
        point.corners = self.corners[index];
        point.viscosities = self.viscosities[index];
        &self.forms[index]
    }

    /// Evaluates the caloric quantities of a block at the temperatures of the trial.
    pub(super) fn close<Q: MeasureSet>(
        &mut self,
        points: &[Point<A, Q>],
        measures: &[Numbers<Q>],
        (old, next): (&State, &mut State),
    ) -> bool {
        let thermal = together(points).filter(|_| points[0].is_thermal());
        let Some(together) = thermal else {
            return false;
        };
        for (x, (point, measures)) in self.x.iter_mut().zip(points.iter().zip(measures)) {
            *x = point.closed_variables(measures, (old, &mut *next));
        }
        let count = points.len();
        together.caloric_at(&self.x[..count], &mut self.caloric[..count]);
        true
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// The new variables at these measures, with the temperature of the trial.
    fn closed_variables(
        &self,
        measures: &Numbers<Q>,
        (old, next): (&State, &mut State),
    ) -> A::Variables {
        let slots = self.slots();
        for k in 0..self.dashpots() {
            let slot = slots.viscous + k;
            next.viscous.advance(slot, &old.viscous, self.creep[k]);
        }
        let mut x = variables(&self.model, measures.as_ref(), slots, next);
        x[A::Variables::LEN - 1] = self.x[A::Variables::LEN - 1];
        x
    }
}

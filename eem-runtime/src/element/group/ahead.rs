//! What a material evaluates of several springs in one call, ahead of the loop over the springs.

use super::member::Member;
use super::point::{Point, Viscosities, variables};
use super::pose::placed_arms;
use crate::element::conjugates::{Family, Form, OneSet, find_corners_together};
use crate::element::group::view::Trial;
use crate::element::kinematics::{Kinematics, MeasureSet};
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::formulas::TogetherIn;
use eem_material::free_energy::{Array, Caloric, ExactForm, MOST_TOGETHER, Steps};
use eem_material::tabled::Tabled;

/// The elements that are evaluated in one call, in blocks, and room for the values of a block.
pub(super) struct Ahead<A: Arrays> {
    /// The numbers of elements that follow one another and are evaluated in one call.
    pub(super) blocks: Vec<usize>,
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

/// The functions of a block, unless its elements are too few for a call.
fn together<A: Arrays, K: Kinematics<D>, const D: usize>(
    members: &[Member<A, K, D>],
) -> Option<&TogetherIn<A>> {
    let together = members[0].only().model.together();
    together.filter(|together| members.len() >= together.least())
}

/// The form of a scheme and the functions with which a block evaluates it in one call; not if a thermostat prescribes a
/// temperature, with which the form may be another one.
fn form_together<A: Arrays, K: Kinematics<D>, const D: usize>(
    scheme: OneSet,
    members: &[Member<A, K, D>],
) -> Option<(ExactForm, &TogetherIn<A>)> {
    let form = scheme.form().zip(together(members));
    form.filter(|_| !members.iter().any(|member| member.only().is_prescribed))
}

impl<A: Arrays> Ahead<A> {
    /// For elements of these materials; `None` if all are evaluated one by one.
    pub(super) fn new(models: &mut dyn Iterator<Item = &Tabled<A>>) -> Option<Box<Self>> {
        let mut blocks = Vec::new();
        let mut is_worthwhile = false;
        let mut last: Option<&TogetherIn<A>> = None;
        for model in models {
            let together = model.together()?;
            let is_same = last.is_some_and(|last| core::ptr::addr_eq(last, together));
            match blocks.last_mut() {
                Some(count) if is_same && *count < MOST_TOGETHER => *count += 1,
                _ => blocks.push(1),
            }
            is_worthwhile |= blocks
                .last()
                .is_some_and(|&count| count >= together.least());
            last = Some(together);
        }
        let (x, response) = (A::Variables::filled(0.0), A::Response::filled(0.0));
        let viscosities = A::Viscosities::filled(0.0);
        let caloric = Caloric {
            entropy: 0.0,
            heat_capacity: 0.0,
            magnitude: 0.0,
        };
        is_worthwhile.then(|| {
            Box::new(Self {
                blocks,
                x: [x; MOST_TOGETHER],
                corners: [A::Corners::filled(0.0); MOST_TOGETHER],
                forms: [(response, A::Tangent::filled(x)); MOST_TOGETHER],
                responses: [response; MOST_TOGETHER],
                viscosities: [(viscosities, viscosities); MOST_TOGETHER],
                caloric: [(caloric, 0.0); MOST_TOGETHER],
            })
        })
    }

    /// Stores what the form of a scheme keeps of the old state of a block.
    pub(super) fn keep<K: Kinematics<D>, const D: usize>(
        &mut self,
        scheme: OneSet,
        members: &mut [Member<A, K, D>],
    ) -> bool {
        let Some((form, _)) = form_together(scheme, members) else {
            return false;
        };
        let mut kept = no_places();
        let (count, mut together) = (members.len(), None);
        for ((x0, kept), member) in self.x.iter_mut().zip(&mut kept).zip(members) {
            let Point { model, start, .. } = &mut member.points.as_mut()[0].point;
            (*x0, *kept) = (start.x0, start.room_for(form));
            together = model.together();
        }
        together.is_some_and(|together| {
            together.keep(form, &self.x[..count], &mut kept[..count]);
            true
        })
    }

    /// Evaluates the forms of a block at a trial, or the responses alone. `false` if the elements are to be evaluated one by one;
    /// so they are, too, if there is no solution: then the error is that of the first element that has one.
    pub(super) fn respond<C: Family, K: Kinematics<D>, const D: usize>(
        &mut self,
        (scheme, trial): (OneSet, &Trial<D>),
        members: &[Member<A, K, D>],
        has_tangent: bool,
    ) -> bool {
        let form = form_together(scheme, members);
        let Some((form, together)) = form.filter(|_| !trial.is_start) else {
            return false;
        };
        for (x, member) in self.x.iter_mut().zip(members) {
            *x = member.placed_variables::<C>(trial);
        }
        let point = |index: usize| &members[index].only().point;
        self.evaluate((form, together), (members.len(), &point), has_tangent)
    }

    /// The same of so many points, at the variables that are stored.
    fn evaluate<'a, Q: MeasureSet>(
        &mut self,
        (form, together): (ExactForm, &TogetherIn<A>),
        (count, point): (usize, &dyn Fn(usize) -> &'a Point<A, Q>),
        has_tangent: bool,
    ) -> bool {
        let mut kept: [&[f64]; MOST_TOGETHER] = [&[]; MOST_TOGETHER];
        for (index, kept) in kept.iter_mut().enumerate().take(count) {
            self.corners[index] = point(index).corners;
            *kept = point(index).start.kept();
        }
        let (x1, kept) = (&self.x[..count], &kept[..count]);
        let corners = &mut self.corners[..count];
        if point(0).is_thermal() && form == ExactForm::Entropy {
            let ends = |index: usize| {
                let Point { model, start, .. } = point(index);
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

    /// Stores the temperatures of mixed states and the viscosities of an element of the block; returns its form.
    #[inline]
    pub(super) fn give<K: Kinematics<D>, const D: usize>(
        &self,
        index: usize,
        member: &mut Member<A, K, D>,
    ) -> &Form<A> {
        let point = &mut member.points.as_mut()[0].point;
        point.corners = self.corners[index];
        point.viscosities = self.viscosities[index];
        &self.forms[index]
    }

    /// Evaluates the caloric quantities of a block at the temperatures of the trial.
    pub(super) fn close<K: Kinematics<D>, const D: usize>(
        &mut self,
        members: &[Member<A, K, D>],
        (old, next): (&State, &mut State),
    ) -> bool {
        let thermal = together(members).filter(|_| members[0].only().is_thermal());
        let Some(together) = thermal else {
            return false;
        };
        let count = members.len();
        for (x, member) in self.x.iter_mut().zip(members) {
            *x = member.closed_variables(old, next);
        }
        together.caloric_at(&self.x[..count], &mut self.caloric[..count]);
        true
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// The variables of a spring at a trial, at which the form of its scheme is evaluated.
    #[inline]
    fn placed_variables<C: Family>(&self, trial: &Trial<D>) -> A::Variables {
        let point = self.only();
        let at = C::placement(point.scheme);
        let r1 = placed_arms::<K, D>(at, &self.r0, self.new_arms(trial));
        let mut x = point.x;
        for (a, &measure) in point.placed::<C>(&r1)[1].as_ref().iter().enumerate() {
            x[a] = measure;
        }
        x
    }

    /// The new variables of a spring, with the temperature of the trial.
    fn closed_variables(&self, old: &State, next: &mut State) -> A::Variables {
        let point = self.only();
        let slots = point.slots();
        for k in 0..point.dashpots() {
            let slot = slots.viscous + k;
            next.viscous.advance(slot, &old.viscous, point.creep[k]);
        }
        let measures = point.kinematics.measure(&self.arms_in(next));
        let mut x = variables(&point.model, measures.as_ref(), slots, next);
        x[A::Variables::LEN - 1] = point.x[A::Variables::LEN - 1];
        x
    }
}

//! Springs whose material evaluates several of them in one call, ahead of the loop over the springs.
//!
//! The loops are those of all materials. They take the values evaluated ahead, which have the same bits.

use super::element_group::ElementGroup;
use super::member::Member;
use super::point::{Point, Viscosities, variables};
use super::pose::placed_arms;
use super::share::Share;
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::{Family, Form, OneSet, find_corners_together};
use crate::element::error::StateError;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::Kinematics;
use crate::element::state::State;
use crate::element::tally::Tally;
use eem_material::free_energy::{
    Array, Caloric, ExactForm, MOST_TOGETHER, Material, Steps, TogetherOf,
};

/// Values of the elements of a block.
pub(super) struct Ahead<M: Material> {
    /// The numbers of elements that follow one another and are evaluated in one call.
    blocks: Vec<usize>,
    x: [M::Variables; MOST_TOGETHER],
    corners: [M::Corners; MOST_TOGETHER],
    forms: [Form<f64, M>; MOST_TOGETHER],
    responses: [M::Response; MOST_TOGETHER],
    viscosities: [Viscosities<M>; MOST_TOGETHER],
    caloric: [(Caloric<f64>, f64); MOST_TOGETHER],
}

impl<M: Material, K: Kinematics<D>, const D: usize> ElementGroup<M, K, D> {
    /// Stores what the scheme keeps of the old state.
    pub(super) fn keep_together(&mut self, view: &StepView<'_>) -> Result<(), StateError> {
        let scheme = self.scheme;
        for_each_block(
            self.ahead.as_deref_mut(),
            &mut self.members,
            &mut |ahead, members| {
                if !ahead.is_some_and(|ahead| ahead.keep(scheme, members)) {
                    for member in members {
                        member.keep(view);
                    }
                }
                Ok(())
            },
        )
    }

    /// Evaluates responses and tangents, and adds their contributions to the system of the next iteration.
    #[inline(never)]
    pub(super) fn linearize_together<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        let (values, right) = system.parts();
        let (at, contacts) = ((self.scheme, trial), &self.contacts);
        for_each_block(
            self.ahead.as_deref_mut(),
            &mut self.members,
            &mut |ahead, members| {
                let known = ahead.and_then(|ahead| {
                    let is_known = ahead.respond::<C, K, D>(at, members, true);
                    is_known.then_some(&*ahead)
                });
                for (index, member) in members.iter_mut().enumerate() {
                    let form = known.map(|ahead| &ahead.forms[index]);
                    let mut share = Share::none();
                    member.linearize::<C>(contacts, view, trial, form, &mut share)?;
                    member.add_share(&share, contacts, (&mut *values, &mut *right));
                }
                Ok(())
            },
        )
    }

    /// Evaluates responses without tangents.
    #[inline(never)]
    pub(super) fn respond_together<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
    ) -> Result<(), StateError> {
        let at = (self.scheme, trial);
        for_each_block(
            self.ahead.as_deref_mut(),
            &mut self.members,
            &mut |ahead, members| {
                let is_known =
                    ahead.is_some_and(|ahead| ahead.respond::<C, K, D>(at, members, false));
                for member in members {
                    member.respond::<C>(view, trial, is_known)?;
                }
                Ok(())
            },
        )
    }

    /// Closes the step in all springs, with caloric quantities evaluated ahead at the temperatures of the trial.
    #[inline(never)]
    pub(super) fn close_together<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        next: &mut State,
        tally: &mut Tally,
    ) -> Result<(), StateError> {
        let contacts = &self.contacts;
        let is_needed = M::THERMAL && !C::is_in_temperature(self.scheme);
        for_each_block(
            self.ahead.as_deref_mut(),
            &mut self.members,
            &mut |ahead, members| {
                let known = ahead.filter(|_| is_needed).and_then(|ahead| {
                    let is_known = ahead.close(members, (view.state, next));
                    is_known.then_some(&*ahead)
                });
                for (index, member) in members.iter_mut().enumerate() {
                    let known = known.map(|ahead| &ahead.caloric[index]);
                    member.close::<C>(contacts, (view, trial), next, tally, known)?;
                }
                Ok(())
            },
        )
    }
}

/// A function of a block of elements, and of room for values evaluated ahead unless all are evaluated one by one.
type OfBlock<'a, M, T> = dyn FnMut(Option<&mut Ahead<M>>, &mut [T]) -> Result<(), StateError> + 'a;

/// Calls a function for each block, until there is an error.
fn for_each_block<M: Material, T>(
    ahead: Option<&mut Ahead<M>>,
    mut members: &mut [T],
    of_block: &mut OfBlock<'_, M, T>,
) -> Result<(), StateError> {
    let Some(ahead) = ahead else {
        return of_block(None, members);
    };
    for block in 0..ahead.blocks.len() {
        let (now, later) = members.split_at_mut(ahead.blocks[block]);
        of_block(Some(&mut *ahead), now)?;
        members = later;
    }
    Ok(())
}

/// Whether the forms of a block are evaluated in one call: its elements are not few, and no thermostat prescribes a
/// temperature, with which the form may be another one.
fn may_be_together<M: Material, K: Kinematics<D>, const D: usize>(
    members: &[Member<M, K, D>],
) -> bool {
    let together = members[0].only().model.together();
    together.is_some_and(|together| members.len() >= together.least())
        && !members.iter().any(|member| member.only().is_prescribed)
}

impl<M: Material> Ahead<M> {
    /// For these elements; `None` if all are evaluated one by one.
    pub(super) fn new<K: Kinematics<D>, const D: usize>(
        members: &[Member<M, K, D>],
    ) -> Option<Box<Self>> {
        let mut blocks = Vec::new();
        let mut is_worthwhile = false;
        let mut last: Option<&TogetherOf<M>> = None;
        for member in members {
            let together = member.only().model.together()?;
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
        let (x, response) = (M::Variables::filled(0.0), M::Response::filled(0.0));
        let viscosities = M::Viscosities::filled(0.0);
        let caloric = Caloric {
            entropy: 0.0,
            heat_capacity: 0.0,
            magnitude: 0.0,
        };
        is_worthwhile.then(|| {
            Box::new(Self {
                blocks,
                x: [x; MOST_TOGETHER],
                corners: [M::Corners::filled(0.0); MOST_TOGETHER],
                forms: [(response, M::Tangent::filled(x)); MOST_TOGETHER],
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
        members: &mut [Member<M, K, D>],
    ) -> bool {
        let Some(form) = scheme.form().filter(|_| may_be_together(members)) else {
            return false;
        };
        let mut kept: [&mut [f64]; MOST_TOGETHER] = core::array::from_fn(|_| Default::default());
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

    /// Evaluates the forms of a block at a trial, or the responses alone, which the points store with temperatures of mixed states
    /// and viscosities. If there is no solution, its elements are evaluated one
    /// by one, so that the error is that of the first element that has one.
    pub(super) fn respond<C: Family, K: Kinematics<D>, const D: usize>(
        &mut self,
        (scheme, trial): (OneSet, &Trial<D>),
        members: &mut [Member<M, K, D>],
        has_tangent: bool,
    ) -> bool {
        let together = members[0].only().model.together();
        let Some((form, together)) = scheme.form().zip(together) else {
            return false;
        };
        if trial.is_start || !may_be_together(members) {
            return false;
        }
        let count = members.len();
        let mut kept: [&[f64]; MOST_TOGETHER] = [&[]; MOST_TOGETHER];
        for (index, member) in members.iter().enumerate() {
            self.x[index] = member.placed_variables::<C>(trial);
            self.corners[index] = member.only().corners;
            kept[index] = member.only().start.kept();
        }
        let (x1, kept) = (&self.x[..count], &kept[..count]);
        let corners = &mut self.corners[..count];
        if M::THERMAL && form == ExactForm::Entropy {
            let ends = |index: usize| {
                let point = members[index].only();
                (&point.model, [&point.start.x0, &x1[index]])
            };
            if find_corners_together(together, ends, (kept, x1), corners).is_err() {
                return false;
            }
        }
        let steps = Steps { kept, x1, corners };
        let (forms, responses) = (&mut self.forms[..count], &mut self.responses[..count]);
        if has_tangent {
            together.form(form, steps, forms);
            for (response, form) in responses.iter_mut().zip(forms) {
                *response = form.0;
            }
        } else {
            together.response(form, steps, responses);
        }
        if M::DASHPOTS > 0 {
            // Materials without temperature ignore it, so that any entry will do.
            let at = Point::<M, K::Measures>::TEMPERATURE * usize::from(M::THERMAL);
            let mut theta = [0.0; MOST_TOGETHER];
            for (theta, response) in theta.iter_mut().zip(&self.responses) {
                *theta = response[at];
            }
            together.viscosity(&theta[..count], &mut self.viscosities[..count]);
        }
        for (index, member) in members.iter_mut().enumerate() {
            let point = &mut member.points.as_mut()[0].point;
            point.corners = self.corners[index];
            point.viscosities = self.viscosities[index];
            if !has_tangent {
                point.response = self.responses[index];
            }
        }
        true
    }

    /// Evaluates the caloric quantities of a block at the temperatures of the trial, where they are needed.
    pub(super) fn close<K: Kinematics<D>, const D: usize>(
        &mut self,
        members: &[Member<M, K, D>],
        (old, next): (&State, &mut State),
    ) -> bool {
        let count = members.len();
        let together = members[0].only().model.together();
        let together = together.filter(|together| count >= together.least());
        let Some(together) = together else {
            return false;
        };
        for (x, member) in self.x.iter_mut().zip(members) {
            *x = member.closed_variables(old, next);
        }
        together.caloric_at(&self.x[..count], &mut self.caloric[..count]);
        true
    }
}

impl<M: Material, K: Kinematics<D>, const D: usize> Member<M, K, D> {
    /// The variables of a spring at a trial, at which the form of its scheme is evaluated.
    #[inline]
    fn placed_variables<C: Family>(&self, trial: &Trial<D>) -> M::Variables {
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
    fn closed_variables(&self, old: &State, next: &mut State) -> M::Variables {
        let point = self.only();
        let slots = point.slots();
        for k in 0..point.dashpots() {
            let slot = slots.viscous + k;
            next.viscous.advance(slot, &old.viscous, point.creep[k]);
        }
        let measures = point.kinematics.measure(&self.arms_in(next));
        let mut x = variables(&point.model, measures.as_ref(), slots, next);
        x[M::Variables::LEN - 1] = point.x[M::Variables::LEN - 1];
        x
    }
}

//! Springs whose model evaluates several of them in one call, ahead of the loop over the springs.
//!
//! The loops over elements are those of all models. They take the values evaluated ahead, which have the same bits.

use super::ahead::Ahead;
use super::member::Member;
use super::point::{Point, Viscosities, variables};
use super::pose::placed_arms;
use super::share::Share;
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::{ElementScheme, Infeasible};
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::view::{Old, StepView, Trial};
use crate::element::kinematics::Kinematics;
use crate::element::state::State;
use crate::element::tally::Tally;
use eem_material::free_energy::{Array, Caloric, Material, Rows};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    ElementGroup<S, M, K, C, D>
{
    /// Takes the old state in all springs.
    pub(super) fn begin_by_rows(
        &mut self,
        view: &StepView<'_, S>,
        old: &mut Old<'_, S, D>,
    ) -> Result<(), StateError> {
        let Some((model, form)) = M::ROWS.zip(C::ROWS) else {
            return self.begin_one_by_one(view, old);
        };
        let ahead = &mut self.ahead;
        for members in self.members.chunks_mut(model.most) {
            let count = ahead.take(members.iter().map(|member| {
                let point = member.only();
                let measures = point.kinematics.measure(&member.arms_in(view.state));
                variables::<S, M>(measures.as_ref(), point.slots(), view.state)
            }));
            let first = members[0].only().start.old;
            ahead.old.resize(count, first);
            let each = |index: usize| (&members[index].only().model, &ahead.x[index]);
            (form.old)(&each, &mut ahead.old);
            for (member, &known) in members.iter_mut().zip(&ahead.old) {
                member.begin(view, old, Some(known))?;
            }
        }
        Ok(())
    }

    /// Evaluates responses and tangents, and adds their contributions to the system of the next iteration.
    pub(super) fn linearize_by_rows(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: &mut LinearSystem<S, 1>,
    ) -> Result<(), StateError> {
        let Some((model, form)) = M::ROWS.zip(C::ROWS).filter(|_| !trial.is_start) else {
            return self.linearize_one_by_one(view, trial, system);
        };
        let (values, right) = system.parts();
        let ahead = &mut self.ahead;
        for members in self.members.chunks_mut(model.most) {
            let is_known = prepare(members, trial, ahead).is_ok();
            if is_known {
                let zeros = M::Variables::filled(S::zero());
                let none = (M::Response::filled(S::zero()), M::Tangent::filled(zeros));
                ahead.forms.resize(members.len(), none);
                (form.form)(&each(members, &ahead.x, &ahead.memories), &mut ahead.forms);
                let response = |index: usize| &ahead.forms[index].0;
                find_viscosities(&model, members, response, &mut ahead.viscosities);
            }
            for (index, member) in members.iter_mut().enumerate() {
                let known = is_known.then(|| {
                    let prepared = ahead.memories[index];
                    (prepared, &ahead.forms[index], ahead.viscosities[index])
                });
                let mut share = Share::none();
                member.linearize(&self.contacts, view, trial, known, &mut share)?;
                member.add_share(&share, &self.contacts, (&mut *values, &mut *right));
            }
        }
        Ok(())
    }

    /// Evaluates responses without tangents.
    pub(super) fn respond_by_rows(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
    ) -> Result<(), StateError> {
        let Some((model, form)) = M::ROWS.zip(C::ROWS).filter(|_| !trial.is_start) else {
            return self.respond_one_by_one(view, trial);
        };
        let ahead = &mut self.ahead;
        for members in self.members.chunks_mut(model.most) {
            let is_known = prepare(members, trial, ahead).is_ok();
            if is_known {
                let none = M::Response::filled(S::zero());
                ahead.responses.resize(members.len(), none);
                let each = each(members, &ahead.x, &ahead.memories);
                (form.response)(&each, &mut ahead.responses);
                let response = |index: usize| &ahead.responses[index];
                find_viscosities(&model, members, response, &mut ahead.viscosities);
            }
            for (index, member) in members.iter_mut().enumerate() {
                let known = is_known.then(|| {
                    let prepared = ahead.memories[index];
                    (prepared, ahead.responses[index], ahead.viscosities[index])
                });
                member.respond(view, trial, known)?;
            }
        }
        Ok(())
    }

    /// Closes the step in all springs, with caloric quantities evaluated ahead at the temperatures of the trial.
    pub(super) fn close_by_rows(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError> {
        let Some(model) = M::ROWS.filter(|_| M::THERMAL && !self.scheme.is_in_temperature()) else {
            return self.close_one_by_one(view, trial, next, tally);
        };
        let ahead = &mut self.ahead;
        for members in self.members.chunks_mut(model.most) {
            let count = ahead.take(members.iter().map(|member| {
                let point = member.only();
                let slots = point.slots();
                for k in 0..M::DASHPOTS {
                    let old = &view.state.viscous;
                    next.viscous.advance(slots.viscous + k, old, point.creep[k]);
                }
                let measures = point.kinematics.measure(&member.arms_in(next));
                let mut x = variables::<S, M>(measures.as_ref(), slots, next);
                x[M::Variables::LEN - 1] = point.x[M::Variables::LEN - 1];
                x
            }));
            let zero = S::zero();
            let none = Caloric {
                entropy: zero,
                heat_capacity: zero,
                magnitude: zero,
            };
            ahead.caloric.resize(count, (none, zero));
            let each = |index: usize| (&members[index].only().model, &ahead.x[index]);
            (model.caloric_at)(&each, &mut ahead.caloric);
            for (member, known) in members.iter_mut().zip(&ahead.caloric) {
                member.close(&self.contacts, (view, trial), next, tally, Some(known))?;
            }
        }
        Ok(())
    }
}

/// Finds the variables at a trial and the memories of the scheme. On an error, the caller evaluates the springs one by one,
/// so that the error returned is that of the first spring that has one.
fn prepare<S, M, K, C, const D: usize>(
    members: &[Member<S, M, K, C, D>],
    trial: &Trial<S, D>,
    ahead: &mut Ahead<S, M, C::Old, C::Memory>,
) -> Result<(), Infeasible>
where
    S: Real,
    M: Material<S>,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    ahead.take(members.iter().map(|member| member.placed_variables(trial)));
    ahead.memories.clear();
    let memories = members.iter().map(|member| member.only().memory);
    ahead.memories.extend(memories);
    let each = |index: usize| {
        let point = members[index].only();
        (&point.model, &point.start, &ahead.x[index])
    };
    C::prepare_rows(each, &mut ahead.memories)
}

/// Of a spring: its model, the data of its old state, its new variables and the memory of its scheme.
fn each<'a, S, M, K, C, const D: usize>(
    members: &'a [Member<S, M, K, C, D>],
    x: &'a [M::Variables],
    memories: &'a [C::Memory],
) -> impl Fn(usize) -> (&'a M, &'a C::Old, &'a M::Variables, &'a C::Memory)
where
    S: Real,
    M: Material<S>,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    |index| {
        let point = members[index].only();
        (&point.model, &point.start.old, &x[index], &memories[index])
    }
}

/// Finds the viscosities at the temperatures of responses.
fn find_viscosities<'a, S, M, K, C, const D: usize>(
    model: &Rows<S, M>,
    members: &'a [Member<S, M, K, C, D>],
    response: impl Fn(usize) -> &'a M::Response,
    viscosities: &mut Vec<Viscosities<S, M>>,
) where
    S: Real,
    M: Material<S>,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    let zeros = M::Viscosities::filled(S::zero());
    viscosities.resize(members.len(), (zeros, zeros));
    if M::DASHPOTS == 0 {
        return;
    }
    // Models without temperature ignore it, so that any entry will do.
    let theta = Point::<S, M, K, C, D>::TEMPERATURE * usize::from(M::THERMAL);
    let each = |index: usize| (&members[index].only().model, &response(index)[theta]);
    (model.viscosity)(&each, viscosities);
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, C: ElementScheme<S, M>, const D: usize>
    Member<S, M, K, C, D>
{
    /// The variables of a spring at a trial, at which the form of its scheme is evaluated.
    #[inline]
    fn placed_variables(&self, trial: &Trial<S, D>) -> M::Variables {
        let point = self.only();
        let at = point.scheme.placement();
        let r1 = placed_arms::<K, S, D>(at, &self.r0, self.new_arms(trial));
        let mut x = point.x;
        for (a, &measure) in point.placed(&r1)[1].as_ref().iter().enumerate() {
            x[a] = measure;
        }
        x
    }
}

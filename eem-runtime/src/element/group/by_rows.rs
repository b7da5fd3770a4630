//! Springs whose model evaluates several of them in one call, ahead of the loop over the springs.
//!
//! The loops over elements are those of all models. They take the values evaluated ahead, which have the same bits.

use super::ahead::Ahead;
use super::member::Member;
use super::point::{Point, Viscosities, variables};
use super::pose::placed_arms;
use super::share::Share;
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::{Family, Infeasible, KeptOf, prepare_rows, rows};
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::view::{Old, StepView, Trial};
use crate::element::kinematics::Kinematics;
use crate::element::state::State;
use crate::element::tally::Tally;
use eem_material::free_energy::{Array, Caloric, Material, Rows};

impl<M: Material, K: Kinematics<D>, const D: usize> ElementGroup<M, K, D> {
    /// Takes the old state in all springs.
    pub(super) fn begin_by_rows<C: Family>(
        &mut self,
        view: &StepView<'_>,
        old: &mut Old<'_, D>,
    ) -> Result<(), StateError> {
        let Some((model, form)) = M::ROWS.zip(rows(self.scheme)) else {
            return self.begin_one_by_one::<C>(view, old);
        };
        let ahead = &mut self.ahead;
        for members in self.members.chunks_mut(model.most) {
            let count = ahead.take(members.iter().map(|member| {
                let point = member.only();
                let measures = point.kinematics.measure(&member.arms_in(view.state));
                variables(&point.model, measures.as_ref(), point.slots(), view.state)
            }));
            let first = members[0].only().start.old;
            ahead.old.resize(count, first);
            let each = |index: usize| (&members[index].only().model, &ahead.x[index]);
            (form.old)(&each, &mut ahead.old);
            for (member, known) in members.iter_mut().zip(&ahead.old) {
                member.begin::<C>(view, old, Some(known))?;
            }
        }
        Ok(())
    }

    /// Evaluates responses and tangents, and adds their contributions to the system of the next iteration.
    pub(super) fn linearize_by_rows<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        let rows = M::ROWS.zip(rows(self.scheme));
        let Some((model, form)) = rows.filter(|_| !trial.is_start) else {
            return self.linearize_one_by_one::<C>(view, trial, system);
        };
        let (values, right) = system.parts();
        let ahead = &mut self.ahead;
        for members in self.members.chunks_mut(model.most) {
            let is_known =
                are_free(members) && prepare::<M, K, C, D>(members, trial, ahead).is_ok();
            if is_known {
                let zeros = M::Variables::filled(0.0);
                let none = (M::Response::filled(0.0), M::Tangent::filled(zeros));
                ahead.forms.resize(members.len(), none);
                (form.form)(&each(members, &ahead.x, &ahead.corners), &mut ahead.forms);
                let response = |index: usize| &ahead.forms[index].0;
                find_viscosities(&model, members, response, &mut ahead.viscosities);
            }
            for (index, member) in members.iter_mut().enumerate() {
                let known = is_known.then(|| {
                    let corners = ahead.corners[index];
                    (corners, &ahead.forms[index], ahead.viscosities[index])
                });
                let mut share = Share::none();
                member.linearize::<C>(&self.contacts, view, trial, known, &mut share)?;
                member.add_share(&share, &self.contacts, (&mut *values, &mut *right));
            }
        }
        Ok(())
    }

    /// Evaluates responses without tangents.
    pub(super) fn respond_by_rows<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
    ) -> Result<(), StateError> {
        let rows = M::ROWS.zip(rows(self.scheme));
        let Some((model, form)) = rows.filter(|_| !trial.is_start) else {
            return self.respond_one_by_one::<C>(view, trial);
        };
        let ahead = &mut self.ahead;
        for members in self.members.chunks_mut(model.most) {
            let is_known =
                are_free(members) && prepare::<M, K, C, D>(members, trial, ahead).is_ok();
            if is_known {
                let none = M::Response::filled(0.0);
                ahead.responses.resize(members.len(), none);
                let each = each(members, &ahead.x, &ahead.corners);
                (form.response)(&each, &mut ahead.responses);
                let response = |index: usize| &ahead.responses[index];
                find_viscosities(&model, members, response, &mut ahead.viscosities);
            }
            for (index, member) in members.iter_mut().enumerate() {
                let known = is_known.then(|| {
                    let corners = ahead.corners[index];
                    (corners, ahead.responses[index], ahead.viscosities[index])
                });
                member.respond::<C>(view, trial, known)?;
            }
        }
        Ok(())
    }

    /// Closes the step in all springs, with caloric quantities evaluated ahead at the temperatures of the trial.
    pub(super) fn close_by_rows<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        next: &mut State,
        tally: &mut Tally,
    ) -> Result<(), StateError> {
        let Some(model) = M::ROWS.filter(|_| M::THERMAL && !C::is_in_temperature(self.scheme))
        else {
            return self.close_one_by_one::<C>(view, trial, next, tally);
        };
        let ahead = &mut self.ahead;
        for members in self.members.chunks_mut(model.most) {
            let count = ahead.take(members.iter().map(|member| {
                let point = member.only();
                let slots = point.slots();
                for k in 0..point.dashpots() {
                    let old = &view.state.viscous;
                    next.viscous.advance(slots.viscous + k, old, point.creep[k]);
                }
                let measures = point.kinematics.measure(&member.arms_in(next));
                let mut x = variables(&point.model, measures.as_ref(), slots, next);
                x[M::Variables::LEN - 1] = point.x[M::Variables::LEN - 1];
                x
            }));
            let none = Caloric {
                entropy: 0.0,
                heat_capacity: 0.0,
                magnitude: 0.0,
            };
            ahead.caloric.resize(count, (none, 0.0));
            let each = |index: usize| (&members[index].only().model, &ahead.x[index]);
            (model.caloric_at)(&each, &mut ahead.caloric);
            for (member, known) in members.iter_mut().zip(&ahead.caloric) {
                member.close::<C>(&self.contacts, (view, trial), next, tally, Some(known))?;
            }
        }
        Ok(())
    }
}

/// Whether no thermostat prescribes the temperature of a spring, with which its form may be another one.
fn are_free<M, K, const D: usize>(members: &[Member<M, K, D>]) -> bool
where
    M: Material,
    K: Kinematics<D>,
{
    members.iter().all(|member| !member.only().is_prescribed)
}

/// Finds the variables at a trial and the corners of the scheme. On an error, the caller evaluates the springs one by one,
/// so that the error returned is that of the first spring that has one.
fn prepare<M, K, C, const D: usize>(
    members: &[Member<M, K, D>],
    trial: &Trial<D>,
    ahead: &mut Ahead<M>,
) -> Result<(), Infeasible>
where
    M: Material,
    K: Kinematics<D>,
    C: Family,
{
    ahead.take(
        members
            .iter()
            .map(|member| member.placed_variables::<C>(trial)),
    );
    ahead.corners.clear();
    let corners = members.iter().map(|member| member.only().corners);
    ahead.corners.extend(corners);
    let each = |index: usize| {
        let point = members[index].only();
        (&point.model, &point.start, &ahead.x[index])
    };
    prepare_rows(each, &mut ahead.corners)
}

/// Of a spring: its model, the data of its old state, its new variables and its temperatures of mixed states.
fn each<'a, M, K, const D: usize>(
    members: &'a [Member<M, K, D>],
    x: &'a [M::Variables],
    corners: &'a [M::Corners],
) -> impl Fn(usize) -> (&'a M, &'a KeptOf<M>, &'a M::Variables, &'a M::Corners)
where
    M: Material,
    K: Kinematics<D>,
{
    |index| {
        let point = members[index].only();
        (&point.model, &point.start.old, &x[index], &corners[index])
    }
}

/// Finds the viscosities at the temperatures of responses.
fn find_viscosities<'a, M, K, const D: usize>(
    model: &Rows<f64, M>,
    members: &'a [Member<M, K, D>],
    response: impl Fn(usize) -> &'a M::Response,
    viscosities: &mut Vec<Viscosities<M>>,
) where
    M: Material,
    K: Kinematics<D>,
{
    let zeros = M::Viscosities::filled(0.0);
    viscosities.resize(members.len(), (zeros, zeros));
    if M::DASHPOTS == 0 {
        return;
    }
    // Models without temperature ignore it, so that any entry will do.
    let theta = Point::<M, K::Measures>::TEMPERATURE * usize::from(M::THERMAL);
    let each = |index: usize| (&members[index].only().model, &response(index)[theta]);
    (model.viscosity)(&each, viscosities);
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
}

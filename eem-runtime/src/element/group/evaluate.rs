//! Evaluation of a trial state: responses, condensed local systems, contributions.

use super::member::Member;
use super::share::Share;
use super::site::{Contact, paths_of};
use crate::algebra::system::LinearSystem;
use crate::algebra::threads;
use crate::element::conjugates::{Family, Form};
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::Kinematics;
use eem_material::arrays::Arrays;

impl<A: Arrays, K: Kinematics<D>, const D: usize> ElementGroup<A, K, D> {
    /// Evaluates responses and tangents, and adds their contributions to the system of the next iteration.
    #[inline]
    pub(super) fn linearize_one_by_one<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        let (values, right) = system.parts();
        for member in &mut self.members {
            let mut share = Share::none();
            member.linearize::<C>(&self.contacts, view, trial, None, &mut share)?;
            member.add_share(&share, &self.contacts, (&mut *values, &mut *right));
        }
        Ok(())
    }

    /// Evaluates responses without tangents.
    #[inline]
    pub(super) fn respond_one_by_one<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
    ) -> Result<(), StateError> {
        for member in &mut self.members {
            member.respond::<C>(view, trial, false)?;
        }
        Ok(())
    }

    /// Linearizes elements with many points, in rounds.
    #[inline(never)]
    pub(super) fn linearize_in_rounds<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        let (values, right) = system.parts();
        let contacts = &self.contacts;
        let linearize = |member: &mut Member<A, K, D>, share: &mut Share<K, D>| {
            member.linearize::<C>(contacts, view, trial, None, share)
        };
        let mut add = |member: &Member<A, K, D>, share: &Share<K, D>| {
            member.add_share(share, contacts, (&mut *values, &mut *right));
        };
        in_rounds(&mut self.members, &mut self.shares, &linearize, &mut add)
    }
}

/// Computes contributions of elements with many points in parallel, and adds them in the order of the elements, so that
/// every sum has the same bits for any number of threads.
pub(super) fn in_rounds<A: Send, K: Kinematics<D>, const D: usize>(
    members: &mut [A],
    shares: &mut Vec<Share<K, D>>,
    of_one: &(impl Fn(&mut A, &mut Share<K, D>) -> Result<(), StateError> + Sync),
    add: &mut (impl FnMut(&A, &Share<K, D>) + Send),
) -> Result<(), StateError> {
    shares.resize_with(ROUND.min(members.len()), Share::none);
    let is_shared = members.len() > PIECE;
    let mut outcome = Ok(());
    let mut all = || {
        outcome = members.chunks_mut(ROUND).try_for_each(|members| {
            let shares = &mut shares[..members.len()];
            in_pieces(members, shares, of_one)?;
            for (member, share) in members.iter().zip(shares) {
                add(member, share);
            }
            Ok(())
        });
    };
    if is_shared {
        threads::enter(&mut all);
    } else {
        all();
    }
    outcome
}

/// Elements whose contributions are stored at a time.
const ROUND: usize = 64;

/// The most elements that one thread takes at a time.
const PIECE: usize = 8;

/// Calls a function for each element with its contribution, in pieces that do not depend on the number of threads;
/// returns the first error in the order of the elements.
fn in_pieces<A: Send, B: Send>(
    members: &mut [A],
    shares: &mut [B],
    of_one: &(impl Fn(&mut A, &mut B) -> Result<(), StateError> + Sync),
) -> Result<(), StateError> {
    if members.len() <= PIECE {
        for (member, share) in members.iter_mut().zip(shares) {
            of_one(member, share)?;
        }
        return Ok(());
    }
    let middle = members.len() / 2;
    let (members, more_members) = members.split_at_mut(middle);
    let (shares, more_shares) = shares.split_at_mut(middle);
    let (mut first, mut second) = (Ok(()), Ok(()));
    threads::join(
        &mut || first = in_pieces(members, shares, of_one),
        &mut || second = in_pieces(more_members, more_shares, of_one),
    );
    first.and(second)
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// Evaluates the responses without tangents, unless those stored are known to be right.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 0.8 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn respond<C: Family>(
        &mut self,
        view: &StepView<'_>,
        trial: &Trial<D>,
        is_known: bool,
    ) -> Result<(), StateError> {
        let arms = self.trial_arms::<C>(view, trial);
        for point in self.points.as_mut() {
            point.respond_alone::<C>(view, trial, &arms, is_known)?;
        }
        Ok(())
    }

    /// Evaluates responses and tangents, and the contribution of the element to the system of the next iteration. With a known
    /// form, mixed states and viscosities are those that the point stores.
    #[expect(
        clippy::inline_always,
        reason = "a call of its own costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn linearize<C: Family>(
        &mut self,
        contacts: &[Contact<K, D>],
        view: &StepView<'_>,
        trial: &Trial<D>,
        known: Option<&Form<A>>,
        share: &mut Share<K, D>,
    ) -> Result<(), StateError> {
        let arms = self.trial_arms::<C>(view, trial);
        share.momentum = None;
        for (point, heat) in self.points.as_mut().iter_mut().zip(share.heat.as_mut()) {
            let measures =
                point.locate_trial::<C>(&arms.placed, trial.is_start, known.is_some())?;
            let pose = point.pose::<C>(&arms, &measures);
            point.sensitivity = pose.sensitivity;
            let by_rate = point.extend::<C>(&pose, &arms.motion);
            // Used in place: copies would cost a good part of the time.
            let mut form = known.map_or_else(|| point.form::<C>(trial.is_start), |form| *form);
            if point.is_thermal() && C::is_in_temperature(point.scheme) {
                point.change_entropy_at_rates(view.step, &pose, &arms.motion, &mut form);
            }
            point.accept::<C>(view.per_step, &form, known.is_some())?;
            let elastic = point.add_drag::<C>(view.per_step, &mut form);
            let undamped = point.add_damping::<C>(&mut form);
            let contact = point.contact_in(contacts);
            point.condense::<C>(view, &trial.interface, &form, paths_of(contact))?;
            if let Some(by_rate) = &by_rate {
                point.warm_by_rates::<C>(view, by_rate);
            }
            *heat = contact.map(|_| point.heat::<C>(&trial.interface, &form));
            if view.phase.moves() {
                let form = (&form, by_rate.as_ref());
                point.add_momentum::<C>(view.step, &pose, form, heat, &mut share.momentum);
            }
            point.keep::<C>(&form);
            point.drop_damping(undamped.as_ref());
            point.drop_drag(&elastic);
        }
        Ok(())
    }
}

//! Evaluation of a trial state: measures, responses, condensed local systems, contributions.

use core::slice;

use super::member::{Block, Member};
use super::placed::{OfGroup, TrialArms};
use super::points::{Exchange, PointSet, TrialView};
use super::share::{Contacts, Share};
use crate::algebra::system::LinearSystem;
use crate::algebra::threads;
use crate::element::conjugates::Family;
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Kinematics, QuadraticStrain};

/// The trial of a step, as elements see it.
pub(super) type At<'a, const D: usize> = (&'a StepView<'a>, &'a Trial<D>);

/// The trial of a step, as points see it.
pub(super) fn for_points<'a, K: Kinematics<D>, const D: usize>(
    (view, trial): At<'a, D>,
    contacts: &'a Contacts<K, D>,
) -> TrialView<'a> {
    TrialView {
        view,
        interface: &trial.interface,
        is_start: trial.is_start,
        contacts: &contacts.heat,
    }
}

impl<K: QuadraticStrain<D>, const D: usize> ElementGroup<K, D> {
    /// Evaluates responses and tangents, and adds their contributions to the system of the next iteration.
    pub(super) fn linearize<C: Family>(
        &mut self,
        at: At<'_, D>,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        let (of, contacts) = (&self.of, &self.contacts);
        let (values, right) = system.parts();
        if const { Member::<K, D>::POINTS == 1 } {
            for block in &mut self.elements.blocks {
                let exchange = &mut self.room.exchange;
                block.linearize::<C>(of, at, contacts, exchange)?;
                for (member, exchange) in block.members.iter_mut().zip(exchange) {
                    let mut share = Share::none();
                    let arms = member.trial_arms::<C>(of, at);
                    member.take::<C>(0, of, at, contacts, (&arms, exchange), &mut share);
                    member.add_share(&share, contacts, (&mut *values, &mut *right));
                }
            }
            return Ok(());
        }
        let linearize = |block: &mut OneBlock<K, D>, share: &mut Share<K, D>| {
            block.linearize_one_by_one::<C>(of, at, contacts, share)
        };
        let mut add = |block: &OneBlock<K, D>, share: &Share<K, D>| {
            for member in &block.members {
                member.add_share(share, contacts, (&mut *values, &mut *right));
            }
        };
        in_rounds(
            &mut self.elements.blocks,
            &mut self.shares,
            &linearize,
            &mut add,
        )
    }

    /// Evaluates responses without tangents.
    pub(super) fn respond<C: Family>(&mut self, at: At<'_, D>) -> Result<(), StateError> {
        for block in &mut self.elements.blocks {
            block.respond::<C>(&self.of, at, &self.contacts, &mut self.room.exchange)?;
        }
        Ok(())
    }
}

type OneBlock<K, const D: usize> = Block<K, dyn PointSet<<K as Kinematics<D>>::Measures>, D>;

impl<K: Kinematics<D>, const D: usize> Block<K, dyn PointSet<K::Measures>, D> {
    /// Finds the measures of all points at a trial; an error at the first that is inadmissible, whose index is the number returned.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    fn place<C: Family>(
        &mut self,
        of: &OfGroup,
        at: At<'_, D>,
        exchange: &mut [Exchange<K::Measures>],
    ) -> (usize, Result<(), StateError>) {
        let mut index = 0;
        for member in &mut self.members {
            let arms = member.trial_arms::<C>(of, at);
            for point in member.points.as_mut() {
                if !point.place::<C>(of, &arms, &mut exchange[index]) {
                    let (element, _) = self.points.place(index);
                    let refusal = point.kinematics.refusal(element, &arms.placed);
                    return (index, Err(refusal));
                }
                index += 1;
            }
        }
        (index, Ok(()))
    }

    #[inline]
    fn linearize<C: Family>(
        &mut self,
        of: &OfGroup,
        at: At<'_, D>,
        contacts: &Contacts<K, D>,
        exchange: &mut [Exchange<K::Measures>],
    ) -> Result<(), StateError> {
        let (count, placed) = self.place::<C>(of, at, exchange);
        let at = for_points(at, contacts);
        (self.points).linearize(0, &at, &mut exchange[..count])?;
        placed
    }

    #[inline]
    fn respond<C: Family>(
        &mut self,
        of: &OfGroup,
        at: At<'_, D>,
        contacts: &Contacts<K, D>,
        exchange: &mut [Exchange<K::Measures>],
    ) -> Result<(), StateError> {
        let (count, placed) = self.place::<C>(of, at, exchange);
        (self.points).respond(&for_points(at, contacts), &exchange[..count])?;
        placed
    }

    /// Evaluates elements with many points, an element after the other, point by point.
    fn linearize_one_by_one<C: Family>(
        &mut self,
        of: &OfGroup,
        at: At<'_, D>,
        contacts: &Contacts<K, D>,
        share: &mut Share<K, D>,
    ) -> Result<(), StateError> {
        let for_points = for_points(at, contacts);
        let mut exchange = Exchange::none();
        share.momentum = None;
        for member in &mut self.members {
            let arms = member.trial_arms::<C>(of, at);
            for index in 0..Member::<K, D>::POINTS {
                let point = &mut member.points.as_mut()[index];
                if !point.place::<C>(of, &arms, &mut exchange) {
                    let (element, _) = self.points.place(index);
                    return Err(point.kinematics.refusal(element, &arms.placed));
                }
                let own = slice::from_mut(&mut exchange);
                (self.points).linearize(index, &for_points, own)?;
                member.take::<C>(index, of, at, contacts, (&arms, &exchange), share);
            }
        }
        Ok(())
    }
}

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// Takes the answer of a point into the contribution of the element.
    #[expect(
        clippy::inline_always,
        reason = "a call of its own costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    fn take<C: Family>(
        &mut self,
        index: usize,
        of: &OfGroup,
        (view, _): At<'_, D>,
        contacts: &Contacts<K, D>,
        (arms, exchange): (&TrialArms<K, D>, &Exchange<K::Measures>),
        share: &mut Share<K, D>,
    ) {
        let point = &mut self.points.as_mut()[index];
        let pose = point.pose::<C>(of, arms);
        let by_arm = point.take_sensitivity::<C>(of, &pose, arms, exchange);
        let heat = &mut share.heat.as_mut()[index];
        let contact = point.contact_in(&contacts.heat);
        *heat = contact.map(|_| point.heat::<C>(exchange));
        if view.phase.moves() {
            let of = (of, view.step);
            let pose = (&pose, by_arm.as_ref());
            point.add_momentum::<C>(of, pose, exchange, heat, &mut share.momentum);
        }
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

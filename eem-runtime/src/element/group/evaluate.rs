//! Evaluation of a trial state: measures, responses, condensed local systems, contributions.

use super::member::{Block, Member};
use super::placed::{OfGroup, TrialArms};
use super::points::{Exchange, PointSet};
use super::share::{Contacts, Share};
use crate::algebra::system::LinearSystem;
use crate::algebra::threads;
use crate::element::conjugates::Family;
use crate::element::error::StateError;
use crate::element::group::element_group::ElementGroup;
use crate::element::group::view::At;
use crate::element::kinematics::{Kinematics, Measures, QuadraticStrain};
use eem_material::free_energy::{Array, MOST_TOGETHER};

impl<K, P, C, const D: usize> ElementGroup<K, P, C, D>
where
    K: QuadraticStrain<D>,
    P: ?Sized + PointSet<K::Measures>,
    C: Family,
{
    /// Evaluates responses and tangents, and adds their contributions to the system of the next iteration.
    pub(super) fn linearize(
        &mut self,
        at: At<'_, D>,
        system: &mut LinearSystem<1>,
    ) -> Result<(), StateError> {
        let (of, contacts) = (self.of, &self.contacts);
        let (values, right) = system.parts();
        if const { Member::<K, D>::POINTS == 1 } {
            for block in &mut self.elements.blocks {
                if !C::IS_EXACT && block.points.is_together() {
                    block.evaluate_together::<C>(of, at, contacts, true);
                }
                let Block { members, points } = block;
                for (index, member) in members.iter_mut().enumerate() {
                    let mut share = Share::none();
                    member.linearize::<C, P>((index, points), of, at, contacts, &mut share)?;
                    member.add_share(&share, contacts, (&mut *values, &mut *right));
                }
            }
            return Ok(());
        }
        let linearize = |block: &mut Block<K, P, D>, share: &mut Share<K, D>| {
            let points = &mut *block.points;
            let mut members = block.members.iter_mut().enumerate();
            members.try_for_each(|(index, member)| {
                member.linearize::<C, P>((index, points), of, at, contacts, share)
            })
        };
        let mut add = |block: &Block<K, P, D>, share: &Share<K, D>| {
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
    pub(super) fn respond(&mut self, at: At<'_, D>) -> Result<(), StateError> {
        for block in &mut self.elements.blocks {
            if !C::IS_EXACT && block.points.is_together() {
                block.evaluate_together::<C>(self.of, at, &self.contacts, false);
            }
            block.respond::<C>(self.of, at, &self.contacts)?;
        }
        Ok(())
    }
}

impl<K: Kinematics<D>, P: ?Sized + PointSet<K::Measures>, const D: usize> Block<K, P, D> {
    /// Evaluates all its points in one call, before they are asked one by one. Those of inadmissible elements have the measures of the
    /// old state: they are not asked.
    #[inline(never)]
    fn evaluate_together<C: Family>(
        &mut self,
        of: OfGroup,
        at: At<'_, D>,
        contacts: &Contacts<K, D>,
        has_tangent: bool,
    ) {
        let mut measures = [Measures::<K, D>::filled(0.0); MOST_TOGETHER];
        let mut count = 0;
        for member in &mut self.members {
            let arms = member.trial_arms::<C>(of, at);
            for point in member.points.as_mut() {
                let is_placed = point.measure::<C>(of, &arms);
                measures[count] = if is_placed {
                    point.measures
                } else {
                    point.measures0
                };
                count += 1;
            }
        }
        let at = contacts.for_points(at);
        (self.points).evaluate_together(&at, &measures[..count], has_tangent);
    }

    #[inline]
    fn respond<C: Family>(
        &mut self,
        of: OfGroup,
        at: At<'_, D>,
        contacts: &Contacts<K, D>,
    ) -> Result<(), StateError> {
        let for_points = contacts.for_points(at);
        let mut exchange = Exchange::none();
        let mut index = 0;
        for member in &mut self.members {
            let arms = member.trial_arms::<C>(of, at);
            for point in member.points.as_mut() {
                if !point.place::<C>(of, &arms, &mut exchange) {
                    let (element, _) = self.points.place(index);
                    return Err(point.kinematics.refusal(element, &arms.placed));
                }
                self.points.respond(index, &for_points, &exchange)?;
                index += 1;
            }
        }
        Ok(())
    }
}

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// Evaluates the points of an element, and its contribution to the system of an iteration.
    #[expect(
        clippy::inline_always,
        reason = "a call of its own costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    fn linearize<C: Family, P: ?Sized + PointSet<K::Measures>>(
        &mut self,
        (index, points): (usize, &mut P),
        of: OfGroup,
        at: At<'_, D>,
        contacts: &Contacts<K, D>,
        share: &mut Share<K, D>,
    ) -> Result<(), StateError> {
        let for_points = contacts.for_points(at);
        let arms = self.trial_arms::<C>(of, at);
        let mut exchange = Exchange::none();
        share.momentum = None;
        for point in 0..Member::<K, D>::POINTS {
            let place = index * Member::<K, D>::POINTS + point;
            let own = &mut self.points.as_mut()[point];
            if !own.place::<C>(of, &arms, &mut exchange) {
                let (element, _) = points.place(place);
                return Err(own.kinematics.refusal(element, &arms.placed));
            }
            points.linearize(place, &for_points, &mut exchange)?;
            self.take::<C>(point, of, at, (&arms, &exchange), share);
        }
        Ok(())
    }

    /// Takes the answer of a point into the contribution of the element.
    #[expect(
        clippy::inline_always,
        reason = "a call of its own costs 1 % of a step of a spring"
    )]
    #[inline(always)]
    fn take<C: Family>(
        &mut self,
        index: usize,
        of: OfGroup,
        (view, _): At<'_, D>,
        (arms, exchange): (&TrialArms<K, D>, &Exchange<K::Measures>),
        share: &mut Share<K, D>,
    ) {
        let point = &mut self.points.as_mut()[index];
        let pose = point.pose::<C>(of, arms);
        let by_arm = point.take_sensitivity::<C>(of, &pose, arms, exchange);
        let heat = &mut share.heat.as_mut()[index];
        let is_coupled = exchange.contact != u32::MAX;
        *heat = is_coupled.then(|| point.heat::<C>(exchange));
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

//! The loops over springs of a material that evaluates several of them in one call.
//!
//! A block of springs is evaluated ahead; then each takes its values, which have the bits of those evaluated one by one.

use super::ahead::Ahead;
use super::element_group::ElementGroup;
use super::share::Share;
use crate::algebra::system::LinearSystem;
use crate::element::conjugates::Family;
use crate::element::error::StateError;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::Kinematics;
use crate::element::state::State;
use crate::element::tally::Tally;
use eem_material::arrays::Arrays;

impl<A: Arrays, K: Kinematics<D>, const D: usize> ElementGroup<A, K, D> {
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
                    let form = known.map(|ahead| ahead.give(index, member));
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
                let known = ahead.and_then(|ahead| {
                    let is_known = ahead.respond::<C, K, D>(at, members, false);
                    is_known.then_some(&*ahead)
                });
                for (index, member) in members.iter_mut().enumerate() {
                    if let Some(ahead) = known {
                        ahead.give(index, member);
                        member.points.as_mut()[0].point.response = ahead.responses[index];
                    }
                    member.respond::<C>(view, trial, known.is_some())?;
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
        let is_needed = A::THERMAL && !C::is_in_temperature(self.scheme);
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
type OfBlock<'a, A, T> = dyn FnMut(Option<&mut Ahead<A>>, &mut [T]) -> Result<(), StateError> + 'a;

/// Calls a function for each block, until there is an error.
fn for_each_block<A: Arrays, T>(
    ahead: Option<&mut Ahead<A>>,
    mut members: &mut [T],
    of_block: &mut OfBlock<'_, A, T>,
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

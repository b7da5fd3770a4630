//! An explicit scheme is saved and goes on from what was saved.

use super::Explicit;
use super::memory::{START, Target};
use super::past::SavedExplicit;
use crate::element::state::State;
use eem_material::number::compensated::Sum;
use eem_material::number::scalar::Real;

impl<S: Real, const D: usize> Explicit<S, D> {
    /// What the step from this state depends on besides.
    pub(crate) fn save(&self, state: &State<S>) -> SavedExplicit<S> {
        let (books, start) = (&self.books, &self.start);
        let mut saved = SavedExplicit {
            is_new: !self.is_ready,
            state: state.digest(),
            is_motion_first: self.is_motion_first,
            targets: saved_targets(&books.targets),
            shares: books.shares.clone(),
            held_energies: books.held_energies.clone(),
            largest_momentum: books.largest_momentum,
            residue: books.residue,
            rates: self.rows[START][..self.offsets.size].to_vec(),
            powers: start.powers.clone(),
            supply: start.supply.clone(),
            reactions: start.reactions.as_flattened().to_vec(),
            loads: start.loads.clone(),
            forces: start.forces.clone(),
        };
        if saved.is_new {
            saved.clear();
        }
        saved
    }

    /// Goes on from what was saved of the same scene.
    pub(crate) fn restore(&mut self, saved: &SavedExplicit<S>) {
        self.is_ready = !saved.is_new;
        self.is_motion_first = saved.is_motion_first;
        let (books, start) = (&mut self.books, &mut self.start);
        let mut sums = saved.targets.iter();
        for target in &mut books.targets {
            target.each_mut(|own| {
                if let Some(sum) = sums.next() {
                    *own = *sum;
                }
            });
        }
        books.shares.copy_from(&saved.shares);
        books.held_energies.copy_from_slice(&saved.held_energies);
        books.largest_momentum = saved.largest_momentum;
        books.residue = saved.residue;
        books.terms = None;
        self.rows[START][..self.offsets.size].copy_from_slice(&saved.rates);
        start.powers.copy_from_slice(&saved.powers);
        start.supply.copy_from_slice(&saved.supply);
        start.loads.copy_from_slice(&saved.loads);
        start.forces.copy_from_slice(&saved.forces);
        let reactions = start.reactions.as_flattened_mut();
        reactions.copy_from_slice(&saved.reactions);
    }
}

fn saved_targets<S: Real, const D: usize>(targets: &[Target<S, D>]) -> Vec<Sum<S>> {
    let mut sums = Vec::new();
    for target in targets {
        { *target }.each_mut(|sum| sums.push(*sum));
    }
    sums
}

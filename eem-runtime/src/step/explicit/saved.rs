//! Checkpoints of an explicit scheme.

use super::Explicit;
use super::accounts::Accounts;
use super::memory::SavedExplicit;
use crate::element::state::State;
use eem_material::number::compensated::Sum;

impl<const D: usize> Explicit<D> {
    /// Everything besides the state that the next step depends on.
    pub(crate) fn save(&self, state: &State) -> SavedExplicit {
        // After an attempt that was not accepted, what was before it; targets are kept only where steps change them.
        let (sums, own) = if self.has_left {
            (&self.old_books, &self.start_loads)
        } else {
            (&self.books, &self.loads)
        };
        let (books, momenta) = if self.has_left && self.is_driven {
            (&self.old_books, &self.old_momenta)
        } else {
            (&self.books, &self.momenta)
        };
        let mut targets = Vec::new();
        for (target, momenta) in books.targets.iter().zip(momenta) {
            targets.extend([target.energy, target.lost]);
            momenta.clone().each_mut(&mut |sum| targets.push(*sum));
        }
        let mut rates = Vec::new();
        let mut keep = |[start, now]: [&mut f64; 2]| {
            rates.push(if self.has_left { *start } else { *now });
        };
        for place in &self.places[..self.kept_places] {
            place.clone().each_rate(&mut keep);
        }
        self.stage.clone().each_rate(&mut keep);
        let mut saved = SavedExplicit {
            is_new: !self.is_ready,
            state: state.digest(),
            is_motion_first: self.is_motion_first,
            targets,
            shares: sums.shares.clone(),
            largest_momentum: sums.largest_momentum,
            residue: sums.residue,
            rates,
            loads: own.total_force.iter().chain(&own.force).copied().collect(),
        };
        if saved.is_new {
            saved.clear();
        }
        saved
    }

    /// Continues from a checkpoint of the same scene.
    pub(crate) fn restore(&mut self, saved: &SavedExplicit) {
        self.is_ready = !saved.is_new;
        self.has_left = true;
        self.is_motion_first = saved.is_motion_first;
        let Accounts {
            books, old_books, ..
        } = &mut self.accounts;
        let mut sums = saved.targets.iter();
        let mut take = |own: &mut Sum| {
            if let Some(sum) = sums.next() {
                *own = *sum;
            }
        };
        for (target, momenta) in books.targets.iter_mut().zip(&mut self.momenta) {
            take(&mut target.energy);
            take(&mut target.lost);
            momenta.each_mut(&mut take);
        }
        self.old_momenta.copy_from_slice(&self.momenta);
        books.shares.copy_from_slice(&saved.shares);
        books.largest_momentum = saved.largest_momentum;
        books.residue = saved.residue;
        books.terms = None;
        old_books.copy_from(books, true);
        let mut rates = saved.rates.iter();
        self.each_rate(&mut |[start, _]| {
            if let Some(rate) = rates.next() {
                *start = *rate;
            }
        });
        let loads = &mut self.start_loads;
        let loads = loads.total_force.iter_mut().chain(&mut loads.force);
        for (own, load) in loads.zip(&saved.loads) {
            *own = *load;
        }
    }
}

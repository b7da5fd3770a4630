//! Checkpoints of an explicit scheme.

use super::Explicit;
use super::accounts::Accounts;
use super::memory::{SavedExplicit, momenta_of};
use crate::element::state::State;
use eem_material::number::compensated::Sum;

impl Accounts {
    /// Everything besides the state that the next step depends on, given the rates of places.
    fn save(&self, state: &State, mut rates: Vec<f64>) -> SavedExplicit {
        // After an attempt that was not accepted, what was before it; targets are kept only where steps change them.
        let (sums, own) = if self.has_left {
            (&self.old_books, &self.start_loads)
        } else {
            (&self.books, &self.loads)
        };
        let books = if self.has_left && self.is_driven {
            &self.old_books
        } else {
            &self.books
        };
        let mut targets = Vec::new();
        for (index, target) in books.targets.iter().enumerate() {
            targets.extend_from_slice(&[target.energy, target.lost]);
            targets.extend_from_slice(&books.momenta[momenta_of(index, self.dimension)]);
        }
        let mut keep = |[start, now]: [&mut f64; 2]| {
            rates.push(if self.has_left { *start } else { *now });
        };
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
            loads: [&own.total_force[..], &own.force].concat(),
        };
        if saved.is_new {
            saved.clear();
        }
        saved
    }

    /// Takes all but the rates of a checkpoint of the same scene.
    fn restore(&mut self, saved: &SavedExplicit) {
        self.is_ready = !saved.is_new;
        self.has_left = true;
        self.is_motion_first = saved.is_motion_first;
        let books = &mut self.books;
        let mut sums = saved.targets.iter();
        let mut take = |own: &mut Sum| {
            if let Some(sum) = sums.next() {
                *own = *sum;
            }
        };
        for (index, target) in books.targets.iter_mut().enumerate() {
            take(&mut target.energy);
            take(&mut target.lost);
            let momenta = &mut books.momenta[momenta_of(index, self.dimension)];
            momenta.iter_mut().for_each(&mut take);
        }
        books.shares.copy_from_slice(&saved.shares);
        books.largest_momentum = saved.largest_momentum;
        books.residue = saved.residue;
        books.terms = None;
        self.old_books.copy_from(books, true);
        let loads = &mut self.start_loads;
        let loads = loads.total_force.iter_mut().chain(&mut loads.force);
        for (own, load) in loads.zip(&saved.loads) {
            *own = *load;
        }
    }
}

impl<const D: usize> Explicit<D> {
    /// Everything besides the state that the next step depends on.
    pub(crate) fn save(&self, state: &State) -> SavedExplicit {
        let mut rates = Vec::new();
        for place in &self.places[..self.kept_places] {
            let [start, now] = [&place.past.rates[0], &place.rates];
            let own = if self.has_left { start } else { now };
            rates.extend_from_slice(own.as_flattened());
        }
        self.accounts.save(state, rates)
    }

    /// Continues from a checkpoint of the same scene.
    pub(crate) fn restore(&mut self, saved: &SavedExplicit) {
        self.accounts.restore(saved);
        let mut rates = saved.rates.iter();
        self.each_rate(&mut |[start, _]| {
            if let Some(rate) = rates.next() {
                *start = *rate;
            }
        });
    }
}

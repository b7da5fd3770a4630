//! Checkpoints of an explicit scheme.

use super::Explicit;
use super::memory::SavedExplicit;
use crate::element::state::State;

impl<const D: usize> Explicit<D> {
    /// Everything besides the state that the next step depends on.
    pub(crate) fn save(&self, state: &State) -> SavedExplicit {
        let mut books = self.books.clone();
        let (mut rates, mut loads) = (Vec::new(), Vec::new());
        for [start, now] in self.stage.rates(self.kept_places) {
            rates.push(if self.has_left { start } else { now });
        }
        let own = if self.has_left {
            // After an attempt that was not accepted.
            books.copy_from(&self.old_books, self.is_driven);
            &self.start_loads
        } else {
            &self.loads
        };
        loads.extend(own.total_force.iter().chain(&own.force));
        if !self.is_ready {
            books.clear();
            rates.fill(0.0);
            loads.fill(0.0);
        }
        let mut targets = Vec::new();
        for target in &mut books.targets {
            target.each_mut(&mut |sum| targets.push(*sum));
        }
        SavedExplicit {
            is_new: !self.is_ready,
            state: state.digest(),
            is_motion_first: self.is_motion_first,
            targets,
            shares: books.shares,
            largest_momentum: books.largest_momentum,
            residue: books.residue,
            rates,
            loads,
        }
    }

    /// Continues from a checkpoint of the same scene.
    pub(crate) fn restore(&mut self, saved: &SavedExplicit) {
        self.is_ready = !saved.is_new;
        self.has_left = true;
        self.is_motion_first = saved.is_motion_first;
        let books = &mut self.books;
        let mut sums = saved.targets.iter();
        for target in &mut books.targets {
            target.each_mut(&mut |own| {
                if let Some(sum) = sums.next() {
                    *own = *sum;
                }
            });
        }
        books.shares.copy_from_slice(&saved.shares);
        books.largest_momentum = saved.largest_momentum;
        books.residue = saved.residue;
        books.terms = None;
        self.old_books.copy_from(books, true);
        let mut rates = saved.rates.iter();
        self.stage.each_rate(self.kept_places, &mut |[start, _]| {
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

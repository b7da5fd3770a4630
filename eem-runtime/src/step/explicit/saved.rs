//! An explicit scheme is saved and goes on from what was saved.

use super::Explicit;
use super::memory::Target;
use super::past::SavedExplicit;
use crate::element::group::Integral;
use crate::element::state::State;
use eem_material::number::compensated::Sum;
use eem_material::number::scalar::Real;

impl<S: Real, const D: usize> Explicit<S, D> {
    /// What the step from this state depends on besides.
    pub(crate) fn save(&self, state: &State<S>) -> SavedExplicit<S> {
        // After an attempt that was not accepted the stage is elsewhere.
        let has_left = self.has_left;
        let books = &self.books;
        let booked = if has_left { &self.old_books } else { books };
        let changed = if self.is_driven { booked } else { books };
        let outside = match has_left {
            true => &self.start_outside,
            false => &self.outside,
        };
        let rates = |integrals: &[Integral<S>]| {
            let rates = integrals.iter();
            rates.map(|of| if has_left { of.start } else { of.rate }).collect()
        };
        let mut saved = SavedExplicit {
            is_new: !self.is_ready,
            state: state.digest(),
            is_motion_first: self.is_motion_first,
            targets: saved_targets(&changed.targets),
            shares: booked.shares.clone(),
            held_energies: changed.held_energies.clone(),
            largest_momentum: booked.largest_momentum,
            residue: booked.residue,
            rates: self.saved_rates(),
            productions: rates(&self.stage.productions),
            supply: rates(&self.stage.supply),
            loads: outside.loads.clone(),
            forces: outside.forces.clone(),
        };
        if saved.is_new {
            saved.clear();
        }
        saved
    }

    /// Goes on from what was saved of the same scene.
    pub(crate) fn restore(&mut self, saved: &SavedExplicit<S>) {
        self.is_ready = !saved.is_new;
        self.has_left = true;
        self.is_motion_first = saved.is_motion_first;
        let (books, outside) = (&mut self.books, &mut self.start_outside);
        let mut sums = saved.targets.iter();
        for target in &mut books.targets {
            target.each_mut(|own| {
                if let Some(sum) = sums.next() {
                    *own = *sum;
                }
            });
        }
        books.shares.copy_from_slice(&saved.shares);
        books.held_energies.copy_from_slice(&saved.held_energies);
        books.largest_momentum = saved.largest_momentum;
        books.residue = saved.residue;
        books.terms = None;
        self.old_books.copy_from(books, true);
        outside.loads.copy_from_slice(&saved.loads);
        outside.forces.copy_from_slice(&saved.forces);
        let stage = &mut self.stage;
        let integrals = stage.productions.iter_mut().chain(&mut stage.supply);
        for (own, &rate) in integrals.zip(saved.productions.iter().chain(&saved.supply)) {
            own.start = rate;
        }
        let (places, inner) = saved.rates.split_at(2 * D * self.kept_places);
        let places = places.as_chunks::<D>().0.as_chunks::<2>().0.iter();
        for (place, rates) in self.stage.places.iter_mut().zip(places) {
            place.past.rates[0] = *rates;
        }
        let pairs = inner.as_chunks::<2>().0.iter();
        for (past, rates) in self.stage.inner_past.iter_mut().zip(pairs) {
            past.rates[0] = [*rates];
        }
    }

    /// The rates at the start of the next step.
    fn saved_rates(&self) -> Vec<S> {
        let stage = &self.stage;
        let places = stage.places[..self.kept_places].iter();
        let mut rates = Vec::new();
        for place in places {
            let own = if self.has_left { &place.past.rates[0] } else { &place.rates };
            rates.extend_from_slice(own.as_flattened());
        }
        for (now, past) in stage.inner_rates.as_chunks::<2>().0.iter().zip(&stage.inner_past) {
            let own = if self.has_left { &past.rates[0][0] } else { now };
            rates.extend(own);
        }
        rates
    }
}

fn saved_targets<S: Real, const D: usize>(targets: &[Target<S, D>]) -> Vec<Sum<S>> {
    let mut sums = Vec::new();
    for target in targets {
        { *target }.each_mut(|sum| sums.push(*sum));
    }
    sums
}

//! What the integrals of a step make of entropies and targets.

use super::guard::{PathRates, Weights, guarded};
use super::scratch::Progress;
use super::{Explicit, ExplicitView};
use crate::algebra::bivector::planes;
use crate::element::state::State;
use eem_material::number::scalar::{Mask, Real};

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Entropies, books and targets at the end of the step, before it is closed.
    pub(super) fn book(&mut self, view: &ExplicitView<'_, S, D>, next: &mut State<S>) {
        next.copy_books(view.state);
        next.time.add(view.step);
        next.entropies.copy_from(&view.state.entropies);
        self.new_books.copy_from(&self.books);
        self.scratch.progress.fill(Progress::none());
        self.scratch.waits.fill(S::Mask::none());
        self.scratch.produced.fill(S::zero());
        self.scratch.unkept = None;
        self.scratch.least = S::MAX;
        let weights = Weights::new(view.step);
        self.book_paths(&weights, next);
        self.book_dashpots(&weights, next);
        self.book_loads(next);
        if !self.held.is_empty() {
            for (slot, received) in self.scratch.received.iter_mut().enumerate() {
                *received = next.entropies.change(slot, &view.state.entropies);
            }
        }
    }

    /// Entropy flows to one end, and from the other with what is produced.
    fn book_paths(&mut self, weights: &Weights<S>, next: &mut State<S>) {
        let slots = self.scratch.produced.len();
        let temperatures = &self.quadrature.temperatures;
        let is_fixed = |end: usize| end >= slots || self.held.get(end) == Some(&true);
        for (path, kept) in self.components.paths.iter().zip(&mut self.scratch.paths) {
            let [a, b] = path.ends.map(|end| end as usize);
            let element = self.components.elements[a] as usize;
            let component = self.components.of_element[element] as usize;
            let progress = &mut self.scratch.progress[component];
            let rates = PathRates::new(path.conductance, [&temperatures[a], &temperatures[b]]);
            let ([flow, production], _) = rates.guarded(weights);
            *kept = production;
            progress.production.add(production);
            // What no end takes up the closing does not change.
            let closes = !(is_fixed(a) && is_fixed(b));
            let least = if closes {
                &mut progress.least
            } else {
                &mut self.scratch.least
            };
            *least = least.minimum(production);
            next.entropies.add(a, flow);
            // One by one: the production is far below the rounding of the flow where θ_b is near θ_a.
            for change in [-flow, production] {
                match path.share {
                    None => next.entropies.add(b, change),
                    Some(share) => {
                        self.new_books.shares.add(share as usize, change);
                        next.reservoir_entropies.add(b - slots, change);
                    }
                }
            }
        }
    }

    fn book_dashpots(&mut self, weights: &Weights<S>, next: &mut State<S>) {
        let slots = self.scratch.produced.len();
        let quadrature = &self.quadrature;
        for (dashpot, &slot) in self.dashpot_slots.iter().enumerate() {
            let slot = slot as usize;
            if slot < slots {
                let sum = quadrature.of_dashpot(dashpot, slot, &weights.usual);
                let (production, _) = guarded(sum);
                next.entropies.add(slot, production);
                self.scratch.produced[slot] += production;
                let component = self.components.of_dashpot[dashpot] as usize;
                let progress = &mut self.scratch.progress[component];
                progress.production.add(production);
                // What a thermostat takes up the closing does not change.
                let least = if self.held.get(slot) == Some(&true) {
                    &mut self.scratch.least
                } else {
                    &mut progress.least
                };
                *least = least.minimum(production);
            }
        }
        for (component, dashpots) in &self.components.losing {
            let progress = &mut self.scratch.progress[*component as usize];
            for dashpot in dashpots.clone() {
                let slot = self.dashpot_slots[dashpot] as usize;
                let sum = quadrature.of_dashpot(dashpot, slot, &weights.usual);
                let (heat, _) = guarded(sum);
                progress.lost += heat;
                next.dissipated.add(heat);
                self.new_books.targets[*component as usize].lost.add(heat);
            }
        }
    }

    fn book_loads(&mut self, next: &mut State<S>) {
        for (target, sums) in self
            .new_books
            .targets
            .iter_mut()
            .zip(&self.quadrature.loads)
        {
            target.energy.add(sums.work);
            next.work.add(sums.work);
            for (linear, &impulse) in target.linear.iter_mut().zip(&sums.impulse) {
                linear.add(impulse);
            }
            for plane in planes::<D>() {
                target.angular.at_mut(plane).add(sums.torque.at(plane));
            }
        }
    }

    /// Shares the productions of paths between their ends, by the heat capacities that the closing has
    /// found; a reservoir and an element with a thermostat leave all of it to the other end.
    pub(super) fn share_productions(&mut self) {
        let slots = self.scratch.produced.len();
        let is_held = |slot: usize| self.held.get(slot).copied().unwrap_or(false);
        for (path, &production) in self.components.paths.iter().zip(&self.scratch.paths) {
            let ends = path.ends.map(|end| end as usize);
            let capacities = ends.map(|end| {
                let takes = end < slots && !is_held(end);
                if takes {
                    self.scratch.capacities[end]
                } else {
                    S::zero()
                }
            });
            let all = capacities[0] + capacities[1];
            if all.at_most(S::zero()).all() {
                continue;
            }
            for (end, capacity) in ends.into_iter().zip(capacities) {
                if S::zero().less(capacity).all() {
                    self.scratch.produced[end] += production * (capacity / all);
                }
            }
        }
        for slot in 0..self.held.len() {
            if self.held[slot] {
                self.scratch.produced[slot] = S::zero();
            }
        }
    }

    /// The heat of thermostats, `Δe − ∫ (f λ̇ + heat that flows in)`: what is left of the first law of an
    /// element.
    pub(super) fn book_thermostats(&mut self, next: &mut State<S>) {
        for (slot, &is_held) in self.held.iter().enumerate() {
            if is_held {
                let element = self.components.elements[slot] as usize;
                let change = next.energies[element].value - self.books.held_energies[slot];
                let heat = change - self.quadrature.supply[slot];
                let component = self.components.of_element[element] as usize;
                self.new_books.targets[component].energy.add(heat);
                next.heat.add(heat);
            }
        }
    }

    /// The entropy that thermostats have given, once the state is closed.
    pub(super) fn conclude_thermostats(&mut self, old: &State<S>, next: &mut State<S>) {
        for (slot, &is_held) in self.held.iter().enumerate() {
            if is_held {
                let element = self.components.elements[slot] as usize;
                self.new_books.held_energies[slot] = next.energies[element].value;
                let change = next.entropies.change(slot, &old.entropies);
                let given = change - self.scratch.received[slot];
                next.thermostat_entropy.add(-given);
            }
        }
    }
}

//! Entropies and targets at the end of a step, from its integrals.

use super::guard::{PathRates, guarded, mean_drop};
use super::{Explicit, ExplicitView};
use crate::algebra::bivector::planes;
use crate::element::state::State;
use eem_material::number::scalar::Scalar;

impl<const D: usize> Explicit<D> {
    /// Entropies, books and targets at the end of the step, before it is closed.
    pub(super) fn book(&mut self, view: &ExplicitView<'_, D>, next: &mut State) {
        next.copy_books(view.state);
        next.time.add(view.step);
        next.entropies.copy_from(&view.state.entropies);
        self.scratch.clear();
        self.book_paths(view.step, next);
        self.book_dashpots(view.step, next);
        if self.is_driven {
            self.book_loads(view.step, next);
            for (slot, received) in self.scratch.received.iter_mut().enumerate() {
                *received = next.entropies.change(slot, &view.state.entropies);
            }
        }
    }

    /// Moves the exchanged entropy of each path from its second end to its first one, and adds its production to the
    /// second.
    fn book_paths(&mut self, h: f64, next: &mut State) {
        let (stage, scratch) = (&self.stage, &mut self.scratch);
        let slots = scratch.produced.len();
        let is_fixed = |end: usize| end >= slots || stage.is_held(end);
        for (path, kept) in self.components.paths.iter().zip(&mut scratch.paths) {
            let [a, b] = path.ends.map(|end| end as usize);
            let progress = &mut scratch.progress[path.component as usize];
            let rates = PathRates::new(
                path.conductance,
                [&path.temperatures[0], &path.temperatures[1]],
            );
            let [flow, production] = rates.guarded(h);
            *kept = production;
            progress.production.add(production);
            // The closing does not change production that neither end stores.
            let closes = !(is_fixed(a) && is_fixed(b));
            let least = if closes {
                &mut progress.least
            } else {
                &mut scratch.least
            };
            *least = Scalar::minimum(*least, production);
            next.entropies.add(a, flow);
            // One by one: the production is far below the rounding of the flow where θ_b is near θ_a.
            for change in [-flow, production] {
                match path.share {
                    None => next.entropies.add(b, change),
                    Some(share) => {
                        self.books.shares[share as usize].add(change);
                        next.reservoir_entropies.add(b - slots, change);
                    }
                }
            }
        }
    }

    fn book_dashpots(&mut self, h: f64, next: &mut State) {
        let scratch = &mut self.scratch;
        let integrals = self.stage.productions.iter();
        for (integral, dashpot) in integrals.zip(&self.components.dashpots) {
            let component = dashpot.component as usize;
            let progress = &mut scratch.progress[component];
            let production = guarded(h * integral.sum);
            let Some(slot) = dashpot.slot else {
                progress.lost += production;
                next.dissipated.add(production);
                self.books.targets[component].lost.add(production);
                continue;
            };
            let slot = slot as usize;
            next.entropies.add(slot, production);
            scratch.produced[slot] += production;
            progress.production.add(production);
            // The closing does not change production that a thermostat absorbs.
            let least = if self.stage.is_held(slot) {
                &mut scratch.least
            } else {
                &mut progress.least
            };
            *least = Scalar::minimum(*least, production);
        }
    }

    /// Adds the heat and the entropy production of dashpots and paths of heat in the step to the meters, with the factor by
    /// which the closing has scaled all productions of a component.
    pub(super) fn meter(&self, h: f64, next: &mut State) {
        let (stage, components) = (&self.stage, &self.components);
        let slots = self.scratch.produced.len();
        let progress = |component: u32| &self.scratch.progress[component as usize];
        for (index, dashpot) in components.dashpots.iter().enumerate() {
            let slot = dashpot.slot.map(|slot| slot as usize);
            let scale = if slot.is_some_and(|slot| stage.is_held(slot)) {
                1.0
            } else {
                progress(dashpot.component).factor
            };
            let [heat, production] = [stage.heats[index], stage.productions[index].sum];
            next.meters.dissipate(index, scale * guarded(h * heat));
            if let Some(slot) = slot {
                next.meters.produce(slot, scale * guarded(h * production));
            }
        }
        for (path, &production) in components.paths.iter().zip(&self.scratch.paths) {
            let [a, b] = path.ends.map(|end| end as usize);
            let progress = progress(path.component);
            let is_fixed = |end: usize| end >= slots || stage.is_held(end);
            let scale = if is_fixed(a) && is_fixed(b) {
                1.0
            } else {
                progress.factor
            };
            match path.share {
                Some(_) => next.meters.produce(a, scale * production),
                None => next.meters.produce_between([a, b], scale * production),
            }
            if !progress.is_rigid {
                let heat = h
                    * path.conductance
                    * mean_drop([&path.temperatures[0], &path.temperatures[1]]);
                next.meters.conduct(path.link as usize, heat);
            }
        }
    }

    fn book_loads(&mut self, h: f64, next: &mut State) {
        for (target, sums) in self.books.targets.iter_mut().zip(&self.load_sums) {
            target.energy.add(h * sums.work);
            next.work.add(h * sums.work);
            for (linear, &impulse) in target.linear.iter_mut().zip(&sums.impulse) {
                linear.add(h * impulse);
            }
            for plane in planes::<D>() {
                target.angular.at_mut(plane).add(h * sums.torque.at(plane));
            }
        }
    }

    /// Splits the productions of paths between their ends, by the heat capacities of the closing; if one end is a
    /// reservoir or has a thermostat, the other end receives all of it.
    pub(super) fn share_productions(&mut self) {
        let (stage, scratch) = (&self.stage, &mut self.scratch);
        let slots = scratch.produced.len();
        for (path, &production) in self.components.paths.iter().zip(&scratch.paths) {
            let ends = path.ends.map(|end| end as usize);
            let capacities = ends.map(|end| {
                let takes = end < slots && !stage.is_held(end);
                if takes {
                    scratch.capacities[end][0]
                } else {
                    0.0
                }
            });
            let all = capacities[0] + capacities[1];
            if all <= 0.0 {
                continue;
            }
            for (end, capacity) in ends.into_iter().zip(capacities) {
                if capacity > 0.0 {
                    scratch.produced[end] += production * (capacity / all);
                }
            }
        }
        for (produced, &is_held) in scratch.produced.iter_mut().zip(&stage.held) {
            if is_held {
                *produced = 0.0;
            }
        }
    }

    /// The heat of thermostats, `Δe − ∫ (f λ̇ + heat that flows in)`, by the first law of an element.
    pub(super) fn book_thermostats(&mut self, h: f64, next: &mut State) {
        for (slot, _) in self.stage.held.iter().enumerate().filter(|&(_, &is)| is) {
            let element = self.components.elements[slot] as usize;
            let change = next.energies[element].value - self.books.held_energies[slot];
            let heat = change - h * self.stage.supply[slot].sum;
            let component = self.components.of_element[element] as usize;
            self.books.targets[component].energy.add(heat);
            next.heat.add(heat);
        }
    }

    /// The entropy that thermostats have given, once the state is closed.
    pub(super) fn conclude_thermostats(&mut self, old: &State, next: &mut State) {
        for (slot, _) in self.stage.held.iter().enumerate().filter(|&(_, &is)| is) {
            let element = self.components.elements[slot] as usize;
            self.books.held_energies[slot] = next.energies[element].value;
            let change = next.entropies.change(slot, &old.entropies);
            let given = change - self.scratch.received[slot];
            next.thermostat_entropy.add(-given);
        }
    }
}

//! Entropies and targets at the end of a step, from its integrals.

use super::accounts::Accounts;
use super::bodies::Bodies;
use super::components::Support;
use super::guard::{PathRates, guarded, mean_drop};
use super::memory::momenta_of;
use super::thermostats::shift_weights;
use super::{Explicit, View};
use crate::algebra::{add, difference, dot, scaled};
use crate::element::state::State;
use eem_material::number::scalar::Scalar;

impl Accounts {
    /// Moves the exchanged entropy of each path from its second end to its first one, and adds its production to the
    /// second.
    #[inline]
    fn book_paths(&mut self, h: f64, next: &mut State) {
        let (stage, scratch) = (&mut self.stage, &mut self.scratch);
        let first = self.components.first_reservoir;
        for (component, progress) in self.components.all.iter().zip(&mut scratch.progress) {
            let (mut all, mut least) = (progress.production, progress.least);
            for path in &mut self.components.paths[component.paths.clone()] {
                let [a, b] = path.ends;
                let [near, far] = &path.temperatures;
                let ([flow, production], shift) =
                    PathRates::new(path.conductance, [near, far]).guarded(h);
                if shift != 0.0 {
                    for (end, temperatures) in [(a, [near, far]), (b, [far, near])] {
                        if stage.is_held(end) {
                            let thermostat = &mut stage.thermostats[end];
                            shift_weights(thermostat, shift, path.conductance, temperatures);
                        }
                    }
                }
                path.production = production;
                all.add(production);
                // The closing does not change production that neither end stores.
                if path.stores == [false; 2] {
                    scratch.least = Scalar::minimum(scratch.least, production);
                } else {
                    least = Scalar::minimum(least, production);
                }
                next.entropies.add(a, flow);
                // One by one: the production is far below the rounding of the flow where θ_b is near θ_a.
                let changes = [-flow, production];
                if let Some(share) = path.share {
                    for change in changes {
                        self.books.shares[share].add(change);
                        next.reservoir_entropies.add(b - first, change);
                    }
                } else {
                    for change in changes {
                        next.entropies.add(b, change);
                    }
                }
            }
            (progress.production, progress.least) = (all, least);
        }
    }

    #[inline]
    fn book_dashpots(&mut self, h: f64, next: &mut State) {
        let scratch = &mut self.scratch;
        let integrals = self.stage.productions.iter();
        for (integral, dashpot) in integrals.zip(&self.components.dashpots) {
            let component = dashpot.component;
            let progress = &mut scratch.progress[component];
            let production = guarded(h * integral.sum);
            let Some(slot) = dashpot.slot else {
                progress.lost += production;
                next.dissipated.add(production);
                self.books.targets[component].lost.add(production);
                continue;
            };
            next.entropies.add(slot, production);
            scratch.slots[slot].produced += production;
            progress.production.add(production);
            progress.least = Scalar::minimum(progress.least, production);
        }
    }

    /// Adds the heat and the entropy production of dashpots and paths of heat in the step to the meters, with the factor by
    /// which the closing has scaled all productions of a component.
    pub(super) fn meter(&self, h: f64, next: &mut State) {
        let (stage, components) = (&self.stage, &self.components);
        let progress = |component: usize| &self.scratch.progress[component];
        for (index, dashpot) in components.dashpots.iter().enumerate() {
            let scale = progress(dashpot.component).factor;
            let [heat, production] = [stage.heats[index], stage.productions[index].sum];
            next.meters.dissipate(index, scale * guarded(h * heat));
            if let Some(slot) = dashpot.slot {
                next.meters.produce(slot, scale * guarded(h * production));
            }
        }
        for path in &components.paths {
            let progress = progress(path.component);
            let scale = match path.stores {
                [false, false] => 1.0,
                _ => progress.factor,
            };
            let production = scale * path.production;
            match path.share {
                Some(_) => next.meters.produce(path.ends[0], production),
                None => next.meters.produce_between(path.ends, production),
            }
            if !progress.is_rigid {
                let heat = h
                    * path.conductance
                    * mean_drop([&path.temperatures[0], &path.temperatures[1]]);
                next.meters.conduct(path.link, heat);
            }
        }
    }

    /// Splits the productions of paths between their ends, by the heat capacities of the closing; if one end is a
    /// reservoir or has a thermostat, the other end receives all of it.
    #[inline]
    pub(super) fn share_productions(&mut self) {
        let scratch = &mut self.scratch;
        for path in &self.components.paths {
            let capacity = |at: usize| {
                let slot = path.stores[at].then_some(path.ends[at]);
                slot.map_or(0.0, |slot| scratch.slots[slot].capacity)
            };
            let [a, b] = [capacity(0), capacity(1)];
            for (end, capacity) in path.ends.into_iter().zip([a, b]) {
                if a + b > 0.0 && capacity > 0.0 {
                    scratch.slots[end].produced += path.production * (capacity / (a + b));
                }
            }
        }
    }

    /// Adds the work `F·Δq` of constant loads, of which the closing has taken the potential: all of a constant force but the weight.
    pub(super) fn book_constant_loads(&self, bodies: &dyn Bodies, next: &mut State) {
        for at in 0..self.components.masses {
            let place = bodies.at(at);
            for (axis, gravity) in bodies.gravity().iter().enumerate() {
                let load = place.force[axis] - place.mass * gravity;
                if load != 0.0 {
                    next.work.add(load * (place.q[axis] - place.start[0][axis]));
                }
            }
        }
    }
}

impl<const D: usize> Explicit<D> {
    /// Entropies, books and targets at the end of the step, before it is closed.
    #[inline]
    pub(super) fn book(&mut self, view: &View<'_>, next: &mut State) {
        next.copy_books(view.state);
        next.time.add(view.step);
        next.entropies.copy_from(&view.state.entropies);
        self.scratch.clear(view.step);
        self.book_paths(view.step, next);
        self.book_dashpots(view.step, next);
        if self.is_driven {
            self.book_loads(view.step, next);
            self.book_course(view.step, view.state, next);
        }
    }

    fn book_loads(&mut self, h: f64, next: &mut State) {
        let accounts = &mut self.accounts;
        let components = &accounts.components;
        for anchor in components.masses..accounts.kept_places {
            let place = &self.places[anchor];
            let way = difference(place.q(), &place.past.start[0]);
            let sums = &mut accounts.load_sums[components.of_place[anchor]];
            sums.work -= dot(&place.past.rates[0][1], &way) / h;
        }
        for index in 0..self.impulses.len() {
            let impulses = &self.impulses[index];
            let component = &components.all[index];
            let masses = &self.places[component.masses.clone()];
            let (sums, progress) = (
                &accounts.load_sums[index],
                &mut accounts.scratch.progress[index],
            );
            if masses.is_empty() {
                progress.carried = h * sums.effort;
            }
            progress.moment = h * sums.moment;
            let mut work = h * sums.work;
            let is_pushed = impulses.linear.iter().any(|&sum| sum != 0.0);
            if let (Support::Free, [mass], true) = (component.support, masses, is_pushed) {
                // The change of its kinetic energy, `I·(p + I/2)/m`, follows from the impulse I alone: a quadrature of the power
                // would have an error that nothing can close.
                let mut impulse = mass.force;
                add(&mut impulse, 1.0, &impulses.linear);
                let impulse = scaled(h, &impulse);
                let mut mean = mass.past.start[1];
                add(&mut mean, 0.5, &impulse);
                let way = difference(mass.q(), &mass.past.start[0]);
                work = dot(&impulse, &mean) * mass.per_mass() - dot(&mass.force, &way);
            }
            accounts.books.targets[index].energy.add(work);
            next.work.add(work);
            let targets = &mut accounts.books.momenta[momenta_of(index, D)];
            for place in masses {
                for (target, force) in targets.iter_mut().zip(&place.force) {
                    target.add(h * force);
                }
            }
            impulses.each(&mut |at, impulse| targets[at].add(h * impulse));
        }
    }
}

//! The start of a step: from the end of the last one, or from a new state.

use super::accounts::Accounts;
use super::components::Support;
use super::memory::momenta_of;
use super::outside::copy_loads;
use super::tableau::WEIGHTS;
use super::{Explicit, View};
use crate::element::group::{ComponentEnergy, points};
use crate::element::state::State;
use crate::step::error::StepFailure;
use eem_material::number::compensated::Sum;

impl Accounts {
    /// Takes the internal variables of a state.
    fn load(&mut self, state: &State, reservoir_temperatures: &[f64]) {
        let stage = &mut self.stage;
        stage.inner_rates.fill(0.0);
        let (stretches, temperatures) = stage.inner.split_at_mut(stage.temperatures);
        let (slots, reservoirs) = temperatures.split_at_mut(self.components.first_reservoir);
        stretches.copy_from_slice(state.viscous.values());
        slots[..state.temperatures.len()].copy_from_slice(&state.temperatures);
        reservoirs.copy_from_slice(reservoir_temperatures);
        for path in &mut self.components.paths {
            for (temperatures, end) in path.temperatures.iter_mut().zip(path.ends) {
                temperatures[0] = stage.theta(end);
            }
        }
    }

    /// Keeps the books before the step, and begins the sums of internal variables.
    #[inline]
    fn begin(&mut self, has_meters: bool) {
        self.old_books.copy_from(&self.books, self.is_driven);
        for production in &mut self.stage.productions {
            production.begin(WEIGHTS[0]);
        }
        if has_meters {
            self.begin_heats();
        }
        self.has_left = true;
    }

    /// Restores loads and books at the start of the last attempt.
    fn rewind(&mut self) {
        copy_loads(&mut self.loads, &self.start_loads);
        self.books.copy_from(&self.old_books, self.is_driven);
    }

    /// Takes the energy of this state, and the momenta found before, as the conserved targets.
    fn set_targets(&mut self, state: &State) {
        self.scratch.energies.fill(ComponentEnergy::default());
        for (&component, energy) in self.components.of_element.iter().zip(&state.energies) {
            self.scratch.energies[component as usize].add(energy);
        }
        for index in 0..self.components.all.len() {
            let [energy, _] = self.energy_of(index);
            self.books.targets[index].energy = Sum::new(energy);
        }
        self.is_ready = true;
    }

    /// Begins the sums of the heat of each dashpot, with the contribution of the start.
    fn begin_heats(&mut self) {
        let stage = &mut self.stage;
        stage.heats.resize(stage.productions.len(), 0.0);
        stage.has_heats = true;
        let dashpots = self.components.dashpots.iter().enumerate();
        for (index, dashpot) in dashpots {
            let theta = dashpot.slot.map_or(1.0, |slot| stage.theta(slot));
            let power = stage.productions[index].start * theta;
            stage.heats[index] = WEIGHTS[0] * power;
        }
    }
}

impl<const D: usize> Explicit<D> {
    /// Sets the stage and the sums to the start of a step, and begins its integrals.
    #[inline]
    pub(super) fn begin(&mut self, view: &View<'_>, next: &mut State) -> Result<(), StepFailure> {
        if self.has_left || !self.is_ready {
            self.return_to(view, next)?;
        }
        self.accounts.begin(view.state.meters.are_on);
        if self.is_driven {
            self.begin_outside();
        }
        Ok(())
    }

    /// Takes the variables of a state, the constant forces of its loads, and its rates and targets.
    #[cold]
    fn return_to(&mut self, view: &View<'_>, next: &mut State) -> Result<(), StepFailure> {
        let (state, start) = (view.state, view.state.time.value);
        // Steps write only variables that change; all others are equal in both states from now on.
        next.copy_from(state);
        if self.loads.has_total_force() {
            self.loads
                .evaluate_constant_forces(view.loads, view.masses, start)?;
        }
        let positions = points::<D>(state.positions.values());
        let momenta = points::<D>(state.momenta.values());
        for at in 0..self.places.len() {
            let (place, node) = (&mut self.places[at], self.accounts.components.nodes[at]);
            place.now = [positions[node], momenta[node]];
            place.force = self.accounts.loads.total_force(node);
            place.begin_rates();
        }
        self.load(state, &view.conduction.reservoirs);
        if self.is_ready {
            self.each_rate(&mut |[start, now]| *now = *start);
            self.rewind();
            return Ok(());
        }
        for moved in &self.accounts.prescribed.moved {
            let velocities = points::<D>(&moved.velocities);
            for &place in &moved.places {
                self.places[place].rates[0] = velocities[0];
            }
        }
        self.evaluate_loads(view, start)?;
        self.find_rates(None)?;
        self.books.clear();
        for index in 0..self.components.all.len() {
            self.look_at_motion(index);
            if self.components.all[index].support != Support::Several {
                let targets = &mut self.accounts.books.momenta[momenta_of(index, D)];
                self.momenta[index].each(&mut |at, momentum| targets[at] = Sum::new(momentum));
            }
        }
        self.set_targets(state);
        Ok(())
    }

    /// Calls a function for all rates that are kept, at the start of the step and now.
    pub(super) fn each_rate(&mut self, visit: &mut dyn FnMut([&mut f64; 2])) {
        for place in &mut self.places[..self.accounts.kept_places] {
            place.each_rate(visit);
        }
        self.accounts.stage.each_rate(visit);
    }
}

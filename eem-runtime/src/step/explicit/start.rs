//! The start of a step: from the end of the last one, or from a new state.

use super::accounts::Accounts;
use super::components::Support;
use super::memory::Momenta;
use super::outside::copy_loads;
use super::tableau::WEIGHTS;
use super::{Explicit, ExplicitView};
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
    pub(super) fn begin(
        &mut self,
        view: &ExplicitView<'_, D>,
        next: &mut State,
    ) -> Result<(), StepFailure> {
        if self.has_left || !self.is_ready {
            // Steps write only variables that change; all others are equal in both states from now on.
            next.copy_from(view.state);
            self.load(view)?;
            if self.is_ready {
                self.rewind();
            } else {
                self.prepare(view)?;
            }
        }
        let accounts = &mut self.accounts;
        accounts
            .old_books
            .copy_from(&accounts.books, accounts.is_driven);
        if accounts.is_driven {
            self.old_momenta.copy_from_slice(&self.momenta);
        }
        for production in &mut self.stage.productions {
            production.begin(WEIGHTS[0]);
        }
        if view.state.meters.are_on {
            self.begin_heats();
        }
        if self.is_driven {
            self.begin_outside();
        }
        self.has_left = true;
        Ok(())
    }

    /// Takes the variables of a state, and the constant forces of its loads.
    #[cold]
    fn load(&mut self, view: &ExplicitView<'_, D>) -> Result<(), StepFailure> {
        if self.loads.has_total_force() {
            let time = view.state.time.value;
            self.loads
                .evaluate_constant_forces(view.loads, view.masses, time)?;
        }
        let state = view.state;
        let positions = points::<D>(state.positions.values());
        let momenta = points::<D>(state.momenta.values());
        for (place, &node) in self.places.iter_mut().zip(&self.accounts.components.nodes) {
            place.now = [positions[node], momenta[node]];
            place.force = self.loads.total_force(node);
            place.begin_rates();
        }
        self.accounts.load(state, &view.conduction.reservoirs);
        Ok(())
    }

    /// Finds rates and targets.
    #[cold]
    fn prepare(&mut self, view: &ExplicitView<'_, D>) -> Result<(), StepFailure> {
        for moved in &self.prescribed.moved {
            for &place in &moved.places {
                self.places[place].rates[0] = moved.velocities[0];
            }
        }
        self.evaluate_loads(view, view.state.time.value)?;
        self.find_rates(None)?;
        self.set_targets(view.state);
        self.is_ready = true;
        Ok(())
    }

    /// Calls a function for all rates that are kept, at the start of the step and now.
    pub(super) fn each_rate(&mut self, visit: &mut dyn FnMut([&mut f64; 2])) {
        for place in &mut self.places[..self.kept_places] {
            place.each_rate(visit);
        }
        self.accounts.stage.each_rate(visit);
    }

    /// Restores rates and sums at the start of the last attempt.
    #[cold]
    fn rewind(&mut self) {
        self.each_rate(&mut |[start, now]| *now = *start);
        copy_loads(&mut self.loads, &self.start_loads);
        let accounts = &mut self.accounts;
        accounts
            .books
            .copy_from(&accounts.old_books, accounts.is_driven);
        if accounts.is_driven {
            self.momenta.copy_from_slice(&self.old_momenta);
        }
    }

    /// Takes energy and momenta of this state as the conserved targets.
    fn set_targets(&mut self, state: &State) {
        self.books.clear();
        self.scratch.energies.fill(ComponentEnergy::default());
        let Accounts {
            components,
            scratch,
            ..
        } = &mut self.accounts;
        let elements = components.of_element.iter().zip(&state.energies);
        for (&component, energy) in elements {
            scratch.energies[component as usize].add(energy);
        }
        for index in 0..self.components.all.len() {
            self.look_at_motion(index);
            let motion = &self.motions[index];
            let mut momenta = Momenta::none();
            if self.components.all[index].support != Support::Several {
                for (target, &linear) in momenta.linear.iter_mut().zip(&motion.linear) {
                    *target = Sum::new(linear);
                }
                momenta.angular = motion.angular.map(Sum::new(0.0), Sum::new);
            }
            let [energy, _] = self.energy_of(index, &motion.energy);
            self.books.targets[index].energy = Sum::new(energy);
            self.momenta[index] = momenta;
        }
    }
}

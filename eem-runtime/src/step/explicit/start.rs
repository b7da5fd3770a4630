//! The start of a step: from the end of the last one, or from a new state.

use super::components::Support;
use super::memory::Target;
use super::outside::copy_loads;
use super::tableau::WEIGHTS;
use super::{Explicit, ExplicitView};
use crate::element::group::{ComponentEnergy, points};
use crate::element::state::State;
use crate::step::error::StepFailure;
use eem_material::number::compensated::Sum;

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
        self.old_books.copy_from(&self.books, self.is_driven);
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

    /// Takes the variables of a state, and the constant forces of its loads.
    #[cold]
    fn load(&mut self, view: &ExplicitView<'_, D>) -> Result<(), StepFailure> {
        if self.loads.has_total_force() {
            let time = view.state.time.value;
            self.loads
                .evaluate_constant_forces(view.loads, view.masses, time)?;
        }
        let (state, stage) = (view.state, &mut self.stage);
        let positions = points::<D>(state.positions.values());
        let momenta = points::<D>(state.momenta.values());
        for (place, &node) in stage.places.iter_mut().zip(&self.components.nodes) {
            place.now = [positions[node], momenta[node]];
            place.force = self.loads.total_force(node);
            place.begin_rates();
        }
        stage.inner_rates.fill(0.0);
        let (stretches, temperatures) = stage.inner.split_at_mut(stage.temperatures);
        let (slots, reservoirs) = temperatures.split_at_mut(self.components.first_reservoir);
        stretches.copy_from_slice(state.viscous.values());
        slots[..state.temperatures.len()].copy_from_slice(&state.temperatures);
        reservoirs.copy_from_slice(&view.conduction.reservoirs);
        for path in &mut self.components.paths {
            for (temperatures, end) in path.temperatures.iter_mut().zip(path.ends) {
                temperatures[0] = stage.theta(end);
            }
        }
        Ok(())
    }

    /// Finds rates and targets.
    #[cold]
    fn prepare(&mut self, view: &ExplicitView<'_, D>) -> Result<(), StepFailure> {
        for moved in &self.prescribed.moved {
            for &place in &moved.places {
                self.stage.places[place].rates[0] = moved.velocities[0];
            }
        }
        self.evaluate_loads(view, view.state.time.value)?;
        self.find_rates(None)?;
        self.set_targets(view.state);
        self.is_ready = true;
        Ok(())
    }

    /// Restores rates and sums at the start of the last attempt.
    #[cold]
    fn rewind(&mut self) {
        let places = self.kept_places;
        self.stage
            .each_rate(places, &mut |[start, now]| *now = *start);
        copy_loads(&mut self.loads, &self.start_loads);
        self.books.copy_from(&self.old_books, self.is_driven);
    }

    /// Takes energy and momenta of this state as the conserved targets.
    fn set_targets(&mut self, state: &State) {
        self.books.clear();
        self.scratch.energies.fill(ComponentEnergy::none());
        let elements = self.components.of_element.iter().zip(&state.energies);
        for (&component, energy) in elements {
            self.scratch.energies[component as usize].add(energy);
        }
        for index in 0..self.components.all.len() {
            self.look_at_motion(index);
            let motion = &self.scratch.motions[index];
            let mut target = Target::none();
            if self.components.all[index].support != Support::Several {
                for (target, &linear) in target.linear.iter_mut().zip(&motion.linear) {
                    *target = Sum::new(linear);
                }
                target.angular = motion.angular.map(Sum::new(0.0), Sum::new);
            }
            let [energy, _] = self.energy_of(index);
            target.energy = Sum::new(energy);
            self.books.targets[index] = target;
        }
    }
}

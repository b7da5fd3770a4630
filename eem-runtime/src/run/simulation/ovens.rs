//! Ovens: reservoirs whose temperature is a function of time.

use super::Simulation;
use crate::step::error::StepFailure;
use eem_material::number::scalar::is_positive;

impl<const D: usize> Simulation<D> {
    /// Sets the temperatures of ovens to those in the middle of a step of this size.
    #[cold]
    pub(super) fn heat_ovens(&mut self, size: f64) -> Result<(), StepFailure> {
        for (index, temperature) in &self.loads.ovens {
            let time = self.state.time.value + 0.5 * size;
            let theta = temperature(time);
            if !is_positive(theta) {
                return Err(StepFailure::Oven {
                    reservoir: *index,
                    value: theta,
                    time,
                });
            }
            self.conduction.reservoirs[*index] = theta;
        }
        Ok(())
    }

    /// Books what ovens have given in the last step: the heat `−θ Δσ` and the entropy `−Δσ`.
    #[cold]
    pub(super) fn book_ovens(&mut self) {
        let state = &mut self.state;
        for &(index, _) in &self.loads.ovens {
            let received = state.reservoir_entropies.sum(index);
            state.reservoir_entropies.set(index, 0.0);
            let theta = self.conduction.reservoirs[index];
            state.heat.add(-theta * received.value);
            state.heat.add(-theta * received.carry);
            state.thermostat_entropy.add(received.value);
            state.thermostat_entropy.add(received.carry);
        }
        // The explicit scheme has stored energies of reservoirs, and rates at their old temperatures.
        self.forget_loads();
    }

    /// The temperature of a reservoir now, K.
    pub(super) fn reservoir_now(&self, index: usize) -> f64 {
        let mut ovens = self.loads.ovens.iter();
        let oven = ovens.find(|(own, _)| *own == index);
        oven.map_or(self.conduction.reservoirs[index], |(_, temperature)| {
            temperature(self.state.time.value)
        })
    }

    /// The temperatures of all reservoirs at the start, K.
    pub(super) fn reservoirs_at_start(&self) -> Vec<f64> {
        let mut temperatures = self.conduction.reservoirs.clone();
        for (index, temperature) in &self.loads.ovens {
            temperatures[*index] = temperature(self.start);
        }
        temperatures
    }
}

//! What is remembered of the steps so far, to go on as if some had never been tried.

use super::Simulation;
use super::control_memory::Memory;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// What control and choice of a scheme remember.
    pub(super) fn memory(&self) -> Memory<S> {
        Memory {
            step: self.step,
            control: self.control.as_ref().map(|control| control.memory),
            choice: self.saved_choice(),
        }
    }

    /// Goes on as if nothing had been learnt since.
    pub(super) fn remember(&mut self, memory: Memory<S>) {
        self.step = memory.step;
        let choice = memory.choice;
        let mut too_large = None;
        if let Some(saved) = choice.filter(|saved| saved.scheme != self.in_use) {
            // Where the memory of that scheme is gone, the present one is gone on with.
            too_large = self.use_scheme(saved.scheme).err();
            self.go_on_with(memory.control);
        }
        if let (Some(own), Some(before)) = (&mut self.control, memory.control) {
            own.memory = before;
            own.memory.statistics.too_large = too_large.or(before.statistics.too_large);
        }
        self.restore_choice(choice);
    }

    /// The same, but for what has been counted.
    pub(super) fn remember_uncounted(&mut self, memory: Memory<S>) {
        let counted = self.step_statistics();
        self.remember(memory);
        if let (Some(own), Some(counted)) = (&mut self.control, counted) {
            own.memory.statistics = counted;
        }
    }
}

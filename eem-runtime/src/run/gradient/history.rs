//! The states of a run, kept for its gradient.

use crate::element::state::State;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::{Mask, Real};

/// How much memory the history of a run may take, see [`Simulation::keep_history`](crate::Simulation::keep_history).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct History {
    bytes: usize,
}

/// The default, 1 GiB.
const BYTES: usize = 1 << 30;

impl Default for History {
    fn default() -> Self {
        Self { bytes: BYTES }
    }
}

impl History {
    /// So many bytes; 2³⁰ by default.
    #[must_use]
    pub const fn bytes(bytes: usize) -> Self {
        Self { bytes }
    }
}

/// A step that was made.
#[derive(Clone, Debug)]
pub(crate) struct KeptStep<S> {
    pub(crate) step: S,
    pub(crate) scheme: Scheme,
    /// The state at its end.
    pub(crate) state: State<S>,
}

/// The states since the history began.
#[derive(Clone, Debug)]
pub(crate) struct Kept<S> {
    pub(crate) first: State<S>,
    pub(crate) steps: Vec<KeptStep<S>>,
    /// The bytes that all steps may take, and those of one.
    pub(crate) allowed: usize,
    pub(crate) needed: usize,
}

impl<S: Real> Kept<S> {
    pub(crate) fn new(state: &State<S>, history: History) -> Self {
        let sums = [
            &state.positions,
            &state.momenta,
            &state.velocities,
            &state.viscous,
            &state.entropies,
            &state.reservoir_entropies,
        ];
        let numbers = sums.map(|sums| 2 * sums.values().len());
        let numbers = numbers.iter().sum::<usize>() + state.temperatures.len();
        let energies = size_of_val(state.energies.as_slice());
        Self {
            first: state.clone(),
            steps: Vec::new(),
            allowed: history.bytes,
            needed: size_of::<KeptStep<S>>() + energies + numbers * size_of::<S>(),
        }
    }

    /// Whether there is no memory for another step.
    pub(crate) fn is_full(&self) -> bool {
        (self.steps.len() + 1).saturating_mul(self.needed) > self.allowed
    }

    /// The time of the last state, s.
    pub(crate) fn time(&self) -> S {
        let last = self.steps.last();
        last.map_or(self.first.time.value, |last| last.state.time.value)
    }

    /// Forgets steps that were undone: those that end after a time.
    pub(crate) fn return_to(&mut self, time: S) {
        while !self.steps.is_empty() && time.less(self.time()).all() {
            self.steps.pop();
        }
    }

    /// Keeps a step of this size between two states. Nothing if the first one is not the last that was kept, as after a step that
    /// did not fit in memory.
    pub(crate) fn keep(&mut self, step: S, scheme: Scheme, [old, state]: [&State<S>; 2]) {
        self.return_to(old.time.value);
        if self.is_full() || !self.ends_in(old) {
            return;
        }
        self.steps.push(KeptStep {
            step,
            scheme,
            state: state.clone(),
        });
    }

    /// Whether the last state is this one.
    pub(crate) fn ends_in(&self, state: &State<S>) -> bool {
        let last = self.state(self.steps.len());
        last.positions == state.positions
            && last.momenta == state.momenta
            && last.viscous == state.viscous
            && last.temperatures == state.temperatures
    }

    /// The state after so many steps.
    pub(crate) fn state(&self, steps: usize) -> &State<S> {
        match steps.checked_sub(1) {
            None => &self.first,
            Some(last) => &self.steps[last].state,
        }
    }
}

//! The states of a run, kept for its gradient.

use core::ops::ControlFlow;

use crate::element::masses::Masses;
use crate::element::state::State;
use eem_material::number::compensated::Sum;

/// How much memory the history of a run may take, see [`Simulation::keep_history`](crate::Simulation::keep_history).
///
/// All states are kept while they fit. Of longer histories some are kept, and the steps between them are made again, with the same
/// bits, when a gradient is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct History(pub(crate) Limit);

/// A user's function that may stop the computation of derivatives.
pub(crate) type Watch = dyn FnMut() -> ControlFlow<()> + Send + Sync;

/// The limit of a history.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limit {
    Bytes(usize),
    Snapshots(usize),
}

/// The default, 1 GiB.
const BYTES: usize = 1 << 30;

impl Default for History {
    fn default() -> Self {
        Self::bytes(BYTES)
    }
}

impl History {
    /// At most this many bytes; 2³⁰ by default. Half of them are for states, with time, positions, velocities, viscous
    /// stretches, temperatures and entropies of reservoirs, and for the sizes of steps, 8 bytes each.
    #[must_use]
    pub const fn bytes(bytes: usize) -> Self {
        Self(Limit::Bytes(bytes))
    }

    /// This many states c besides the first one, for `(c + 3)!/(c! 3!)` steps at most: 176 851 with 100. Each step is made again
    /// up to four times. The sizes of steps take 8 bytes each.
    #[must_use]
    pub const fn snapshots(snapshots: usize) -> Self {
        Self(Limit::Snapshots(snapshots))
    }
}

/// The states at the ends of consecutive steps: of each only the numbers on which derivatives depend.
#[derive(Clone, Debug)]
pub(crate) struct Kept {
    /// The times of the states, s.
    times: Vec<f64>,
    /// The numbers of one state after the other, in pieces of `states_per_piece` states.
    pieces: Vec<Vec<f64>>,
    states_per_piece: usize,
    /// The number of numbers of a state.
    numbers: usize,
}

/// Bytes of a piece, unless a state takes more.
const PIECE: usize = 1 << 16;

impl Kept {
    /// States from this one on; at most `most` of them will be kept.
    pub(crate) fn new(state: &State, most: usize) -> Self {
        let numbers = numbers_of(state);
        let per_piece = PIECE / (numbers * size_of::<f64>()).max(1);
        let mut kept = Self {
            times: Vec::new(),
            pieces: Vec::new(),
            states_per_piece: per_piece.min(most).max(1),
            numbers,
        };
        kept.keep(state);
        kept
    }

    /// The bytes of one of these states.
    pub(crate) fn bytes_of(state: &State) -> usize {
        (numbers_of(state) + 1) * size_of::<f64>()
    }

    /// The number of steps.
    pub(crate) const fn len(&self) -> usize {
        self.times.len() - 1
    }

    /// Forgets all but the first `steps` steps.
    pub(crate) fn return_to(&mut self, steps: usize) {
        let states = steps + 1;
        self.times.truncate(states);
        self.pieces.truncate(states.div_ceil(self.states_per_piece));
        let before = self.pieces.len().saturating_sub(1) * self.states_per_piece;
        if let Some(piece) = self.pieces.last_mut() {
            piece.truncate((states - before) * self.numbers);
        }
    }

    /// Keeps the state after a step.
    pub(crate) fn keep(&mut self, state: &State) {
        if self.times.len().is_multiple_of(self.states_per_piece) {
            let numbers = self.states_per_piece * self.numbers;
            self.pieces.push(Vec::with_capacity(numbers));
        }
        if let Some(piece) = self.pieces.last_mut() {
            for part in parts(state) {
                piece.extend_from_slice(part);
            }
        }
        self.times.push(state.time.value);
    }

    /// Sets the time of the last state, s.
    pub(crate) fn arrive(&mut self, time: f64) {
        if let Some(last) = self.times.last_mut() {
            *last = time;
        }
    }

    /// Whether the last state is this one.
    pub(crate) fn ends_in(&self, state: &State) -> bool {
        let mut rest = self.numbers_after(self.len());
        parts(state).into_iter().all(|part| {
            let (own, others) = rest.split_at(part.len());
            rest = others;
            own == part
        })
    }

    /// The numbers of the state after `steps` steps.
    fn numbers_after(&self, steps: usize) -> &[f64] {
        let piece = &self.pieces[steps / self.states_per_piece];
        let first = steps % self.states_per_piece * self.numbers;
        &piece[first..first + self.numbers]
    }

    /// Writes what is kept of the state after `steps` steps to `state`, which has the same scene: no entropies, energies and sums.
    pub(crate) fn load<const D: usize>(&self, steps: usize, masses: &Masses, state: &mut State) {
        state.time = Sum::new(self.times[steps]);
        let mut rest = self.numbers_after(steps);
        let mut next = |values: &mut [f64]| {
            let (own, others) = rest.split_at(values.len());
            rest = others;
            values.copy_from_slice(own);
        };
        state.positions.write(&mut next);
        let moves = if masses.are_coupled() {
            &mut state.velocities
        } else {
            &mut state.momenta
        };
        moves.write(&mut next);
        state.viscous.write(&mut next);
        next(&mut state.temperatures);
        state.reservoir_entropies.write(&mut next);
        state.follow_velocities(D, masses);
    }
}

/// The numbers that are kept of a state. All others follow from them, or have no derivatives.
fn parts(state: &State) -> [&[f64]; 5] {
    let velocities = state.velocities.values();
    let moves = if velocities.is_empty() {
        state.momenta.values()
    } else {
        velocities
    };
    [
        state.positions.values(),
        moves,
        state.viscous.values(),
        &state.temperatures,
        state.reservoir_entropies.values(),
    ]
}

fn numbers_of(state: &State) -> usize {
    parts(state).iter().map(|part| part.len()).sum()
}

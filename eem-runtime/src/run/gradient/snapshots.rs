//! The steps of a run in limited memory: all states while they fit, then snapshots from which steps are made again.
//!
//! Of n steps every 2ᵏ-th state is kept with what the next step is predicted from, so that steps made again have the same bits.
//! Backwards, the steps after the last snapshot are made again and their states kept. If these are too many, snapshots are kept
//! among them: with f free ones and r passes over each step before the one that keeps states,
//!
//! ```text
//! reach(f, r) = (f + r)!/(f! r!)      times the states that fit,      reach(f, r) = reach(f − 1, r) + reach(f, r − 1)
//! ```
//!
//! (Griewank & Walther 2000, Algorithm 799; Stumm & Walther 2010).

use super::error::GradientError;
use super::history::{History, Kept, Limit};
use crate::element::state::State;
use crate::step::scheme::Scheme;
use crate::step::solver::SavedPast;
use eem_material::number::compensated::Sum;

/// How often a step is made again, at most, before the pass that keeps states.
const MOST_PASSES: usize = 3;

/// Snapshots take one of this many equal parts of the memory. With c snapshots and n states, c n steps are made again only once;
/// the product is largest if both take the same memory.
const SHARE_OF_SNAPSHOTS: usize = 2;

/// The distance of the first snapshots where there is memory for many states: copying them costs little there.
const FIRST_STRIDE: usize = 64;

/// A state with what its next step depends on.
#[derive(Clone, Debug)]
pub(crate) struct Snapshot {
    /// The number of steps before it.
    pub(crate) index: usize,
    pub(crate) state: State,
    pub(crate) past: SavedPast,
}

/// The steps since the history began.
#[derive(Clone, Debug)]
pub(crate) struct Record {
    sizes: Vec<f64>,
    /// The first step of each scheme.
    schemes: Vec<(usize, Scheme)>,
    /// The times of states that were set to the end of a run, which the step missed by rounding.
    arrivals: Vec<(usize, f64)>,
    /// The time after the last step.
    time: Sum,
    /// Every `stride`-th state, in their order.
    snapshots: Vec<Snapshot>,
    stride: usize,
    /// Snapshots that are kept only on the way back.
    passing: Vec<Snapshot>,
    /// All states, while they fit.
    all: Option<Kept>,
    /// Whether a step was not kept because it did not fit.
    is_full: bool,
    limits: Limits,
}

/// How much may be kept.
#[derive(Clone, Copy, Debug)]
struct Limits {
    /// Bytes for states and sizes of steps, and those of one state; `None` for a single state.
    states: Option<[usize; 2]>,
    /// Snapshots besides the first one.
    snapshots: usize,
}

impl Limits {
    /// The number of states that fit besides the sizes of this many steps.
    fn fit(&self, steps: usize) -> usize {
        self.states.map_or(1, |[bytes, state]| {
            bytes.saturating_sub(steps.saturating_mul(size_of::<f64>())) / state
        })
    }
}

/// `(f + r)!/(f! r!)`.
fn reach(free: usize, passes: usize) -> usize {
    (1..=passes).fold(1, |reach: usize, pass| {
        // The product is a multiple of `pass`; one that saturates is beyond any history.
        reach.saturating_mul(free.saturating_add(pass)) / pass
    })
}

fn bytes_of_snapshot(state: &State, past: &SavedPast) -> usize {
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
    let of_past = past.forces.iter().map(Vec::len).sum::<usize>() + past.internal.len();
    let energies = size_of_val(state.energies.as_slice());
    size_of::<Snapshot>() + energies + (numbers + of_past) * size_of::<f64>()
}

impl Record {
    /// A history from this state on; `past` is what its next step is predicted from.
    pub(crate) fn new(state: &State, past: SavedPast, limit: History) -> Self {
        let own = Kept::bytes_of(state);
        let snapshot = bytes_of_snapshot(state, &past);
        let limits = match limit.0 {
            Limit::Bytes(bytes) => Limits {
                states: Some([bytes - bytes / SHARE_OF_SNAPSHOTS, own]),
                snapshots: bytes / SHARE_OF_SNAPSHOTS / snapshot,
            },
            Limit::Snapshots(snapshots) => Limits {
                states: None,
                snapshots,
            },
        };
        let most = limits.fit(0).clamp(1, FIRST_STRIDE);
        Self {
            sizes: Vec::new(),
            schemes: Vec::new(),
            arrivals: Vec::new(),
            time: state.time,
            snapshots: vec![Snapshot {
                index: 0,
                state: state.clone(),
                past,
            }],
            stride: (most / 2 + 1).next_power_of_two(),
            passing: Vec::new(),
            all: limits.states.map(|_| Kept::new(state, limits.fit(0))),
            is_full: false,
            limits,
        }
    }

    /// The number of steps.
    pub(crate) const fn len(&self) -> usize {
        self.sizes.len()
    }

    /// All states, if they are kept.
    pub(crate) const fn all(&self) -> Option<&Kept> {
        self.all.as_ref()
    }

    /// How many states to keep at a time when steps are made again from the first one on.
    pub(crate) fn block(&self) -> usize {
        self.limits.fit(self.len()).clamp(1, FIRST_STRIDE)
    }

    /// The size of a step, s.
    pub(crate) fn size(&self, step: usize) -> f64 {
        self.sizes[step]
    }

    /// The time to which the state after `steps` steps was set, s; `None` if it was not.
    pub(crate) fn arrival(&self, steps: usize) -> Option<f64> {
        let found = self.arrivals.binary_search_by_key(&steps, |&(at, _)| at);
        found.ok().map(|place| self.arrivals[place].1)
    }

    /// The times of all states, s.
    pub(crate) fn times(&self) -> impl Iterator<Item = f64> + '_ {
        let mut time = self.snapshots[0].state.time;
        let later = self.sizes.iter().zip(1..).map(move |(&size, at)| {
            time = self.next_time(time, size, at);
            time.value
        });
        [self.snapshots[0].state.time.value]
            .into_iter()
            .chain(later)
    }

    /// The time after a step of this size, s, which is the last of `steps` steps.
    fn next_time(&self, mut time: Sum, size: f64, steps: usize) -> Sum {
        time.add(size);
        self.arrival(steps).map_or(time, Sum::new)
    }

    /// The schemes of the steps, with the time after the first step of each.
    pub(crate) fn schemes(&self) -> impl Iterator<Item = (Scheme, f64)> + '_ {
        let of = |&(first, scheme): &(usize, Scheme)| (scheme, self.time_of(first + 1).value);
        self.schemes.iter().map(of)
    }

    /// The time at which the last sequence of steps of this scheme began, s; the end if the last step is of another scheme.
    pub(crate) fn end_before(&self, scheme: Scheme) -> f64 {
        let last = self.schemes.last().filter(|&&(_, own)| own == scheme);
        self.time_of(last.map_or(self.len(), |&(first, _)| first))
            .value
    }

    fn time_of(&self, steps: usize) -> Sum {
        let mut before = self.snapshots.iter().rev();
        let from = before.find(|snapshot| snapshot.index <= steps);
        let from = from.map_or((0, self.time), |snapshot| {
            (snapshot.index, snapshot.state.time)
        });
        let sizes = self.sizes[from.0..steps].iter().zip(from.0 + 1..);
        sizes.fold(from.1, |time, (&size, at)| self.next_time(time, size, at))
    }

    /// Whether the last state is this one, judged by its time alone once not all states are kept.
    pub(crate) fn ends_in(&self, state: &State) -> bool {
        self.time == state.time && self.all.as_ref().is_none_or(|all| all.ends_in(state))
    }

    /// The time of the last state, s.
    pub(crate) const fn time(&self) -> f64 {
        self.time.value
    }

    /// Forgets steps that were undone: those that end after a time.
    pub(crate) fn return_to(&mut self, time: f64) {
        let before = self.len();
        while !self.sizes.is_empty() && time < self.time.value {
            self.sizes.pop();
            self.time = self.time_of(self.len());
        }
        let len = self.len();
        if len < before {
            self.is_full = false;
            self.arrivals.retain(|&(at, _)| at <= len);
            self.schemes.retain(|&(first, _)| first < len);
            self.snapshots.retain(|snapshot| snapshot.index <= len);
            if let Some(all) = &mut self.all {
                all.return_to(len);
            }
        }
    }

    /// Keeps a step from `old` to `state`, unless the history does not end in `old`, or memory does not suffice. True if a
    /// snapshot is due.
    pub(crate) fn keep(&mut self, size: f64, scheme: Scheme, [old, state]: [&State; 2]) -> bool {
        self.return_to(old.time.value);
        let steps = self.len() + 1;
        if self.is_full || !self.ends_in(old) {
            return false;
        }
        let most = reach(self.limits.snapshots, MOST_PASSES);
        if steps > most.saturating_mul(self.limits.fit(steps)) {
            self.is_full = true;
            return false;
        }
        if self.schemes.last().is_none_or(|&(_, last)| last != scheme) {
            self.schemes.push((self.len(), scheme));
        }
        self.sizes.push(size);
        self.time = state.time;
        if let Some(all) = &mut self.all {
            if steps < self.limits.fit(steps) {
                all.keep(state);
            } else {
                self.all = None;
            }
        }
        steps.is_multiple_of(self.stride)
    }

    /// Keeps the present state as a snapshot if there is room, possibly after dropping every second snapshot.
    pub(crate) fn snapshot(&mut self, state: &State, past: impl FnOnce() -> SavedPast) {
        let index = self.len();
        if self.snapshots.len() > self.limits.snapshots {
            self.stride *= 2;
            let stride = self.stride;
            self.snapshots
                .retain(|snapshot| snapshot.index.is_multiple_of(stride));
        }
        if index.is_multiple_of(self.stride) && self.snapshots.len() <= self.limits.snapshots {
            self.snapshots.push(Snapshot {
                index,
                state: state.clone(),
                past: past(),
            });
        }
    }

    /// Records that the last state, if its time is `before`, is set to another time, s.
    pub(crate) fn arrive(&mut self, before: Sum, time: f64) {
        let len = self.len();
        // The last step was not kept.
        if len == 0 || self.time != before {
            return;
        }
        self.time = Sum::new(time);
        self.arrivals.push((len, time));
        if let Some(all) = &mut self.all {
            all.arrive(time);
        }
        if let Some(last) = self.snapshots.last_mut().filter(|last| last.index == len) {
            last.state.time = self.time;
        }
    }

    /// An error if a step did not fit.
    pub(crate) fn check(&self) -> Result<(), GradientError> {
        let most = self.len();
        if self.is_full {
            Err(GradientError::HistoryTooLarge { most })
        } else {
            Ok(())
        }
    }

    /// The snapshot with this index.
    pub(crate) fn at(&self, index: usize) -> Option<&Snapshot> {
        let mut all = self.snapshots.iter().chain(&self.passing);
        all.find(|snapshot| snapshot.index == index)
    }

    /// Keeps a snapshot on the way back.
    pub(crate) fn pass(&mut self, snapshot: Snapshot) {
        self.passing.push(snapshot);
    }

    /// The steps that are made again next, from a snapshot up to a state, on the way back from the state after `end` steps, which is
    /// not the first one; and whether all their states are kept, or the last one as a snapshot.
    pub(crate) fn next_pass(&mut self, end: usize) -> ([usize; 2], bool) {
        self.passing.retain(|snapshot| snapshot.index < end);
        let states = self.limits.fit(self.len()).max(1);
        loop {
            let all = self.snapshots.iter().chain(&self.passing);
            let before = all.map(|own| own.index).filter(|&index| index < end);
            let start = before.max().unwrap_or(0);
            let kept = self.snapshots.len() - 1 + self.passing.len();
            let free = self.limits.snapshots.saturating_sub(kept);
            let steps = end - start;
            if steps <= states {
                return ([start, end], true);
            }
            let mut passes = 1..=MOST_PASSES;
            let within = |passes: usize| reach(free, passes).saturating_mul(states);
            if let Some(passes) = passes.find(|&passes| steps <= within(passes)) {
                // The steps up to the new snapshot are made again once more, so they are as few as possible: the remainder
                // after whole parts, or the steps that the snapshots after them do not reach.
                let part = within(passes - 1);
                let least = steps.saturating_sub(reach(free - 1, passes).saturating_mul(states));
                let first = ((steps - 1) % part + 1).max(least);
                return ([start, start + first], false);
            }
            // Drops snapshots for room: first those behind `end`, no longer needed, then the one at which these steps begin.
            let behind = self.snapshots.last().is_some_and(|last| last.index >= end);
            if !behind && self.snapshots.len() == 1 {
                // Unreachable: all steps that were kept are within reach.
                return ([start, end], true);
            }
            self.snapshots.pop();
        }
    }

    /// Drops the snapshots of the way back, which is over.
    pub(crate) fn forget_passing(&mut self) {
        self.passing.clear();
    }
}

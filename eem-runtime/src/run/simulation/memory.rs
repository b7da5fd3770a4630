//! Histories and work arrays of step control and of the choice of a scheme, and guards that restore a value after a failure.

use super::start::{Needs, SHORTEST};
use crate::algebra::memory::MemoryLimit;
use crate::element::state::State;
use crate::run::checkpoint::{SavedChoice, SavedControl};
use crate::step::automatic::SchemeSelection;
use crate::step::control::{Accuracy, Kinds, LoadRounding};
use crate::step::explicit::SavedExplicit;
use crate::step::newton::StepReport;
use crate::step::outcome::Corrections;
use crate::step::samples::Component;
use crate::step::scheme::Scheme;
use crate::step::solver::SavedPast;
use eem_material::number::scalar::Scalar;

/// The smallest step that is tried, in units in the last place of the time, and of the usual step.
pub(super) const SMALLEST: f64 = 16.0;

/// The history of steps that decides the size and the scheme of the next one.
#[derive(Clone, Copy)]
pub(super) struct History {
    pub(super) step: f64,
    pub(super) control: Option<SavedControl>,
    pub(super) choice: Option<SavedChoice>,
}

/// Everything that further steps change, restored after trial steps.
pub(super) struct Snapshot {
    pub(super) state: State,
    pub(super) past: (SavedPast, Option<SavedExplicit>),
    pub(super) history: History,
    pub(super) worst: Option<StepReport>,
    pub(super) corrections: Corrections,
}

/// Step control: its history, and work arrays for its estimate of the error.
pub(super) struct Control {
    pub(super) memory: SavedControl,
    pub(super) accuracy: Accuracy,
    /// The end of the run, s, for which steps look at loads before they are made; `None` if they need not.
    pub(super) horizon: Option<f64>,
    pub(super) seen: Seen,
    /// For schemes without an estimate of their own.
    pub(super) halves: Option<Halves>,
}

/// Work arrays for the value of a load, and for what is seen of each component.
pub(super) struct Seen {
    pub(super) value: Vec<f64>,
    pub(super) seen: Vec<Component>,
}

impl Control {
    /// The smallest step at a time after one of the usual size, s.
    pub(super) fn smallest(&self, time: f64, usual: f64) -> f64 {
        let rounding = SMALLEST * f64::EPSILON;
        let least = rounding * Scalar::maximum(time.abs(), usual);
        Scalar::maximum(Scalar::maximum(self.memory.smallest, least), SHORTEST)
    }
}

/// Work arrays for a step that is made whole and in two halves.
pub(super) struct Halves {
    /// The state at its beginning, and the history of Newton's method.
    pub(super) before: State,
    pub(super) past: SavedPast,
    /// The state after the whole step.
    pub(super) whole: State,
    pub(super) kinds: Kinds,
    /// Of the last step where it was needed.
    pub(super) rounding: LoadRounding,
}

/// The history of `Scheme::Auto`, and what a change of the scheme needs.
pub(super) struct Automatic {
    pub(super) selection: SchemeSelection,
    pub(super) needs: Needs,
    /// The scheme before a trial.
    pub(super) previous: Scheme,
    /// How often all elements have been evaluated by earlier schemes.
    pub(super) evaluations: u64,
    /// A setting of the explicit scheme.
    pub(super) is_motion_first: bool,
    /// The limit for the linear systems of the next scheme.
    pub(super) memory_limit: MemoryLimit,
}

impl Automatic {
    pub(super) fn new(needs: Needs, memory_limit: MemoryLimit) -> Self {
        Self {
            selection: SchemeSelection::new(),
            needs,
            previous: Scheme::EemTemperature,
            evaluations: 0,
            is_motion_first: false,
            memory_limit,
        }
    }
}

/// The steps so far that did not resolve a relaxation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unresolved {
    pub(super) steps: u64,
    /// The sum of their points, and the points of the last step.
    pub(super) points: u64,
    pub(super) last: usize,
    /// The largest of them, s, and the scheme of the last one.
    pub(super) largest: f64,
    pub(super) scheme: Scheme,
}

impl Unresolved {
    pub(super) fn none() -> Self {
        Self {
            steps: 0,
            points: 0,
            last: 0,
            largest: 0.0,
            scheme: Scheme::Auto,
        }
    }

    /// Takes back the last step.
    pub(super) fn undo(&mut self) {
        if self.last > 0 {
            self.steps -= 1;
            self.points -= self.last as u64;
            self.last = 0;
        }
    }
}

/// A value on which a function is called when the guard is dropped, also after a panic, unless it is [kept](Self::keep).
pub(super) struct Guard<T, F: FnOnce(&mut T)> {
    pub(super) value: T,
    restore: Option<F>,
}

impl<T, F: FnOnce(&mut T)> Guard<T, F> {
    pub(super) const fn new(value: T, restore: F) -> Self {
        let restore = Some(restore);
        Self { value, restore }
    }

    /// Leaves the value as it is.
    pub(super) fn keep(&mut self) {
        self.restore = None;
    }
}

impl<T, F: FnOnce(&mut T)> Drop for Guard<T, F> {
    fn drop(&mut self) {
        if let Some(restore) = self.restore.take() {
            restore(&mut self.value);
        }
    }
}

/// Calls `act`, and `restore` if `act` fails or panics.
pub(super) fn or_restore<T: ?Sized, R, E>(
    value: &mut T,
    restore: impl FnOnce(&mut T),
    act: impl FnOnce(&mut T) -> Result<R, E>,
) -> Result<R, E> {
    let mut guard = Guard::new(value, |value| restore(value));
    let result = act(&mut *guard.value)?;
    guard.keep();
    Ok(result)
}

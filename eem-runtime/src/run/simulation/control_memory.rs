//! What step control keeps of the steps so far.

use crate::element::state::State;
use crate::run::checkpoint::{SavedChoice, SavedControl};
use crate::step::control::{Accuracy, Kinds};
use crate::step::solver::SavedPast;
use eem_material::number::scalar::Real;

/// The smallest step that is tried, in units in the last place of the time, and of the first size.
pub(super) const SMALLEST: f64 = 16.0;

/// What is remembered of the steps so far.
#[derive(Clone, Copy)]
pub(super) struct Memory<S> {
    pub(super) step: S,
    pub(super) control: Option<SavedControl<S>>,
    pub(super) choice: Option<SavedChoice>,
}

/// What step control remembers, and room for what it compares.
pub(super) struct Control<S> {
    pub(super) memory: SavedControl<S>,
    pub(super) accuracy: Accuracy,
    /// For schemes that have no estimate of their own.
    pub(super) halves: Option<Halves<S>>,
}

/// What is kept of a step that is made at once and in two halves.
pub(super) struct Halves<S> {
    /// Where it began.
    pub(super) before: State<S>,
    pub(super) past: SavedPast<S>,
    /// Where it led at once.
    pub(super) whole: State<S>,
    pub(super) kinds: Kinds,
    /// The state is somewhere between the ends of the step.
    pub(super) is_under_way: bool,
}

impl<S: Real> Control<S> {
    /// The smallest step at a time, s.
    pub(super) fn smallest(&self, time: S) -> S {
        let by_time = S::from_f64(SMALLEST) * S::EPSILON * time.abs();
        self.memory.smallest.maximum(by_time)
    }
}

//! What a run keeps that chooses its scheme.

use crate::algebra::memory::MemoryLimit;
use crate::scene::entry::ElementEntry;
use crate::step::automatic::Choice;
use crate::step::scheme::Scheme;

/// What a run with `Scheme::Auto` keeps besides.
pub(super) struct Automatic<S> {
    pub(super) choice: Choice,
    /// Whether only schemes of second order can step the scene.
    pub(super) is_second: bool,
    /// The scheme before a trial.
    pub(super) previous: Scheme,
    /// Where the elements are, for the next scheme.
    pub(super) elements: Vec<ElementEntry<S>>,
    /// How often all elements have been evaluated by earlier schemes.
    pub(super) evaluations: u64,
    /// For when the scheme is the explicit one.
    pub(super) is_motion_first: bool,
    /// What the systems of the next scheme may take.
    pub(super) memory_limit: MemoryLimit,
}

impl<S> Automatic<S> {
    pub(super) const fn new(
        elements: Vec<ElementEntry<S>>,
        is_second: bool,
        memory_limit: MemoryLimit,
    ) -> Self {
        Self {
            choice: Choice::new(),
            is_second,
            previous: Scheme::EemTemperature,
            elements,
            evaluations: 0,
            is_motion_first: false,
            memory_limit,
        }
    }
}

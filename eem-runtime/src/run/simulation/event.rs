//! Events: conditions that end a run.

mod bracket;
mod search;

use core::error::Error;
use core::fmt;

use super::Simulation;

/// Which changes of sign count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sense {
    Rising,
    Falling,
    Either,
}

/// The result of the function of an event: a number whose sign counts, or an error that ends the run.
type Value = Result<f64, Box<dyn Error>>;

/// The function of an event.
type Function<'f, const D: usize> = dyn FnMut(&Simulation<D>) -> Value + 'f;

/// An event of a run: a function of the simulation changes its sign.
///
/// The function may use `?`; an error ends the run with
/// [`StepFailure::EventError`](crate::StepFailure::EventError). The event is located as precisely as times can be
/// distinguished, or [`within`](Self::within) a tolerance. See [`Simulation::run_until_event`].
///
/// ```
/// use eem::prelude::*;
///
/// let mut scene = Scene::<1>::new();
/// let mass = scene.mass(1.0, [-1.0], [2.0]);
/// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.3)?;
///
/// let passes = Event::rising(|run: &Simulation<1>| Ok(run.position(mass)?[0]));
/// let is_late = Event::crossing(|run: &Simulation<1>| Ok(run.time() - 9.0)).within(1e-3);
/// let mut events = [passes, is_late];
/// assert_eq!(run.run_until_event(10.0, &mut events)?, RunEnd::Event(0));
/// assert!((run.time() - 0.5).abs() < 1e-15);
/// assert_eq!(run.run_until_event(10.0, &mut events)?, RunEnd::Event(1));
/// assert!((0.0..1e-3).contains(&(run.time() - 9.0)));
/// assert_eq!(run.run_until_event(10.0, &mut events)?, RunEnd::Reached);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Event<'f, const D: usize> {
    function: Box<Function<'f, D>>,
    sense: Sense,
    tolerance: f64,
    /// The function at the beginning and at the end of the step.
    before: f64,
    after: f64,
    has_happened: bool,
}

impl<'f, const D: usize> Event<'f, D> {
    /// An event where the function changes its sign.
    #[must_use]
    pub fn crossing(function: impl FnMut(&Simulation<D>) -> Value + 'f) -> Self {
        Self::new(Sense::Either, function)
    }

    /// An event where the function becomes positive or zero.
    #[must_use]
    pub fn rising(function: impl FnMut(&Simulation<D>) -> Value + 'f) -> Self {
        Self::new(Sense::Rising, function)
    }

    /// An event where the function becomes negative or zero.
    #[must_use]
    pub fn falling(function: impl FnMut(&Simulation<D>) -> Value + 'f) -> Self {
        Self::new(Sense::Falling, function)
    }

    fn new(sense: Sense, function: impl FnMut(&Simulation<D>) -> Value + 'f) -> Self {
        Self {
            function: Box::new(function),
            sense,
            tolerance: 0.0,
            before: 0.0,
            after: 0.0,
            has_happened: false,
        }
    }

    /// Accepts a time up to `tolerance`, s, after the change of sign; zero by default.
    #[must_use]
    pub fn within(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Whether this event happened at the end of the last run that searched for it. Several events can happen at
    /// the same time.
    #[must_use]
    pub const fn has_happened(&self) -> bool {
        self.has_happened
    }
}

impl<const D: usize> fmt::Debug for Event<'_, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Event")
            .field("sense", &self.sense)
            .field("tolerance", &self.tolerance)
            .field("has_happened", &self.has_happened)
            .finish_non_exhaustive()
    }
}

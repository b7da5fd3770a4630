//! The steps of a study that are made and planned, and the function that watches them.

use core::ops::ControlFlow;
use std::time::{Duration, Instant};

/// The function that watches a study: its arguments are the numbers of steps made and planned.
pub(crate) type Watch<'a> = dyn FnMut(u64, u64) -> ControlFlow<()> + 'a;

/// The time between two calls in a run, about.
const PATIENCE: Duration = Duration::from_millis(100);

/// The most steps between two looks at the clock, which takes as long as a small part of a step.
const LONGEST: u32 = 1 << 10;

pub(crate) struct Progress<'a> {
    watch: Option<Box<Watch<'a>>>,
    done: u64,
    planned: u64,
    /// The steps of the present run: made, and planned at most.
    run: [u64; 2],
    last: Instant,
    /// Steps until the next look at the clock, and between two of them.
    left: u32,
    stride: u32,
}

impl<'a> Progress<'a> {
    pub(crate) fn new(watch: Option<Box<Watch<'a>>>) -> Self {
        Self {
            watch,
            done: 0,
            planned: 0,
            run: [0; 2],
            last: Instant::now(),
            left: 1,
            stride: 1,
        }
    }

    /// Adds planned steps.
    pub(crate) fn plan(&mut self, steps: u64) {
        self.planned = self.planned.saturating_add(steps);
    }

    /// Takes planned steps back.
    pub(crate) fn drop_planned(&mut self, steps: u64) {
        self.planned = self.planned.saturating_sub(steps);
    }

    /// Begins a run of which this number of steps is planned.
    pub(crate) fn begin(&mut self, steps: u64) {
        self.run = [0, steps];
    }

    /// A step of the run has been made.
    #[inline]
    pub(crate) fn step(&mut self) -> ControlFlow<()> {
        self.run[0] += 1;
        self.left -= 1;
        match self.left {
            0 => self.look(),
            _ => ControlFlow::Continue(()),
        }
    }

    #[cold]
    fn look(&mut self) -> ControlFlow<()> {
        let passed = self.last.elapsed();
        if passed < PATIENCE / 4 {
            self.stride = (2 * self.stride).min(LONGEST);
        } else if passed >= PATIENCE {
            self.stride = (self.stride / 2).max(1);
        }
        self.left = self.stride;
        if passed < PATIENCE {
            return ControlFlow::Continue(());
        }
        // A run may make more steps than planned, but adds only these to the count at its end.
        let [made, most] = self.run;
        self.call(made.min(most))
    }

    /// The run has ended.
    pub(crate) fn end(&mut self) -> ControlFlow<()> {
        let [_, planned] = self.run;
        self.run = [0; 2];
        self.done = self.done.saturating_add(planned);
        self.call(0)
    }

    fn call(&mut self, made: u64) -> ControlFlow<()> {
        self.last = Instant::now();
        match &mut self.watch {
            Some(watch) => watch(self.done + made, self.planned),
            None => ControlFlow::Continue(()),
        }
    }
}

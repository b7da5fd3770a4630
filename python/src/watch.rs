//! Signals while a run goes on without the interpreter.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use pyo3::prelude::*;

/// How long a run may go on before it looks for signals.
pub(crate) const PATIENCE: Duration = Duration::from_millis(50);

/// Looks for signals now and then: the clock is not read in every step of a small scene.
pub(crate) struct Watch {
    last: Instant,
    /// Steps until the next look at the clock.
    left: usize,
    stride: usize,
    /// What the handler of a signal raised.
    pub(crate) signal: Option<PyErr>,
}

impl Watch {
    pub(crate) fn new() -> Self {
        Self {
            last: Instant::now(),
            left: 1,
            stride: 1,
            signal: None,
        }
    }

    pub(crate) fn look(&mut self) -> ControlFlow<()> {
        self.left -= 1;
        if self.left > 0 {
            return ControlFlow::Continue(());
        }
        let passed = self.last.elapsed();
        if passed < PATIENCE / 2 {
            self.stride = (2 * self.stride).min(1 << 16);
        } else if passed > PATIENCE {
            self.stride = (self.stride / 2).max(1);
        }
        self.left = self.stride;
        if passed < PATIENCE / 4 {
            return ControlFlow::Continue(());
        }
        self.last = Instant::now();
        match Python::attach(|py| py.check_signals()) {
            Ok(()) => ControlFlow::Continue(()),
            Err(signal) => {
                self.signal = Some(signal);
                ControlFlow::Break(())
            }
        }
    }
}

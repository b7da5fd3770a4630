//! Signals while a run goes on without the interpreter.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use pyo3::prelude::*;

/// How long a run may go on before it looks for signals.
pub(crate) const PATIENCE: Duration = Duration::from_millis(50);

/// Runs the handlers of signals that have come. A method of a token is none of all tokens, which `attach` asks for.
pub(crate) fn check_signals(py: Python<'_>) -> PyResult<()> {
    py.check_signals()
}

/// The most steps between two looks at the clock.
const LONGEST: usize = 1 << 12;

/// Looks for signals now and then: the clock is not read in every step of a small scene.
pub(crate) struct Watch {
    /// Python handles signals on its main thread only.
    is_on_main: bool,
    last: Instant,
    /// Steps until the next look at the clock.
    left: usize,
    stride: usize,
    /// What the handler of a signal raised.
    pub(crate) signal: Option<PyErr>,
}

impl Watch {
    pub(crate) fn new(py: Python<'_>) -> PyResult<Self> {
        let threading = py.import("threading")?;
        let main = threading.call_method0("main_thread")?.getattr("ident")?;
        Ok(Self {
            is_on_main: threading.call_method0("get_ident")?.eq(main)?,
            last: Instant::now(),
            left: 1,
            stride: 1,
            signal: None,
        })
    }

    /// To be called after each step.
    pub(crate) fn look(&mut self) -> ControlFlow<()> {
        self.left -= 1;
        if self.left > 0 {
            return ControlFlow::Continue(());
        }
        if !self.is_on_main {
            self.left = LONGEST;
            return ControlFlow::Continue(());
        }
        let passed = self.last.elapsed();
        if passed < PATIENCE {
            if passed < PATIENCE / 4 {
                self.stride = (2 * self.stride).min(LONGEST);
            }
            self.left = self.stride;
            return ControlFlow::Continue(());
        }
        self.stride = (self.stride / 2).max(1);
        self.left = self.stride;
        self.last = Instant::now();
        match Python::attach(check_signals) {
            Ok(()) => ControlFlow::Continue(()),
            Err(signal) => {
                self.signal = Some(signal);
                ControlFlow::Break(())
            }
        }
    }
}

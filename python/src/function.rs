//! Python callables as functions of time.

use std::cell::RefCell;
use std::sync::Arc;

use pyo3::prelude::*;

thread_local! {
    /// What a callable raised in a step on this thread.
    static RAISED: RefCell<Option<PyErr>> = const { RefCell::new(None) };
}

/// A callable that takes the time in s.
///
/// An exception that it raises is kept, and its value is NaN, which no step accepts.
#[derive(Clone)]
pub(crate) struct Function(pub(crate) Arc<Py<PyAny>>);

impl Function {
    pub(crate) fn number(&self, time: f64) -> f64 {
        self.value(time, |value| value.extract())
            .unwrap_or(f64::NAN)
    }

    pub(crate) fn vector<const D: usize>(&self, time: f64) -> [f64; D] {
        let vector = self.value(time, |value| value.extract::<[f64; D]>());
        vector.unwrap_or([f64::NAN; D])
    }

    fn value<T>(
        &self,
        time: f64,
        extract: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<T>,
    ) -> Option<T> {
        Python::attach(|py| {
            let value = self.0.bind(py).call1((time,));
            let value = value.and_then(|value| extract(&value));
            value
                .map_err(|error| RAISED.with_borrow_mut(|raised| _ = raised.get_or_insert(error)))
                .ok()
        })
    }
}

/// What a callable has raised on this thread since the last call.
pub(crate) fn take_raised() -> Option<PyErr> {
    RAISED.take()
}

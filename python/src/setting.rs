//! Schemes by name, tolerances, and how long steps are.

use eem::{Scheme, Tolerance};
use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::prelude::*;

use crate::error;

/// The scheme of this name.
pub(crate) fn scheme(name: &str) -> PyResult<Scheme> {
    Scheme::from_name(name).ok_or_else(|| {
        let names = Scheme::ALL.iter().map(|scheme| scheme.name());
        let names: Vec<_> = std::iter::once("auto").chain(names).collect();
        PyValueError::new_err(format!(
            "there is no scheme {name:?}: take one of {}",
            names.join(", ")
        ))
    })
}

/// How long steps are, s.
#[derive(Clone, Copy)]
pub(crate) enum Pace {
    Constant(f64),
    /// As long as the tolerance asks; the first one that is tried is given.
    Controlled(f64, Tolerance),
    /// As long as the tolerance asks, from the first one on.
    Free(Tolerance),
}

impl Pace {
    /// A step, a relative tolerance, or both.
    pub(crate) fn new(step: Option<f64>, relative: Option<f64>) -> PyResult<Self> {
        let tolerance = relative.map(|relative| tolerance(relative, [0.0; 3], None));
        match (step, tolerance) {
            (Some(step), None) => Ok(Self::Constant(step)),
            (Some(step), Some(tolerance)) => Ok(Self::Controlled(step, tolerance)),
            (None, Some(tolerance)) => Ok(Self::Free(tolerance)),
            (None, None) => Err(error::scene("give a `step`, a `tolerance`, or both")),
        }
    }
}

/// A `UserWarning`.
pub(crate) fn warn(py: Python<'_>, message: &str) -> PyResult<()> {
    let message = std::ffi::CString::new(message)?;
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &message, 1)
}

/// How accurate steps are to be.
pub(crate) fn tolerance(
    relative: f64,
    [position, momentum, temperature]: [f64; 3],
    over: Option<f64>,
) -> Tolerance {
    let tolerance = Tolerance::new(relative)
        .with_position(position)
        .with_momentum(momentum)
        .with_temperature(temperature);
    match over {
        Some(time) => tolerance.over(time),
        None => tolerance,
    }
}

//! Schemes by name, and tolerances.

use eem::{Scheme, Tolerance};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

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

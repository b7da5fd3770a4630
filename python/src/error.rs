//! Errors of the library as exceptions of the package, which are classes of `eem._errors`.

use eem::typed::{Fault, Faults, LawError};
use eem::{EquilibriumError, GradientError, MemberFailure, SceneError, StepError, StepFailure};
use eem_solids::{Refused, SHAPES};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::built::Refusal;

/// An exception of this class with attributes.
fn new(
    class: &str,
    message: String,
    attributes: impl FnOnce(&Bound<'_, PyDict>) -> PyResult<()>,
) -> PyErr {
    Python::attach(|py| {
        let make = || {
            let kwargs = PyDict::new(py);
            attributes(&kwargs)?;
            let class = py.import("eem._errors")?.getattr(class)?;
            class.call((message,), Some(&kwargs))
        };
        make().map_or_else(|error| error, PyErr::from_value)
    })
}

/// A `SceneError` with one error.
pub(crate) fn scene(message: impl Into<String>) -> PyErr {
    let message = message.into();
    scenes(message.clone(), vec![message])
}

/// A `SceneError` with this message and these errors.
pub(crate) fn scenes(message: String, errors: Vec<String>) -> PyErr {
    new("SceneError", message, |attributes| {
        attributes.set_item("errors", errors)
    })
}

pub(crate) fn of_scene(error: SceneError) -> PyErr {
    scene(error.to_string())
}

/// A `CheckpointError`.
pub(crate) fn checkpoint(message: String) -> PyErr {
    new("CheckpointError", message, |_| Ok(()))
}

/// An `EquilibriumError`, or a `SceneError`.
pub(crate) fn equilibrium(error: EquilibriumError) -> PyErr {
    let message = error.to_string();
    match error {
        EquilibriumError::Scene { errors } => {
            scenes(message, errors.iter().map(ToString::to_string).collect())
        }
        _ => new("EquilibriumError", message, |_| Ok(())),
    }
}

/// A `StepError`, with the record of the steps before it if there is one.
pub(crate) fn step(error: &StepError, record: Option<Py<PyAny>>) -> PyErr {
    new("StepError", error.to_string(), |attributes| {
        attributes.set_item("time", error.time)?;
        attributes.set_item("step", error.step)?;
        attributes.set_item("shorter", error.shorter)?;
        attributes.set_item("failure", variant(&error.failure))?;
        let newton = error.history.iter().map(|one| (one.residual, one.update));
        attributes.set_item("newton", newton.collect::<Vec<_>>())?;
        if let StepFailure::LawNotKept {
            law, defect, bound, ..
        } = &error.failure
        {
            attributes.set_item("law", law.to_string())?;
            attributes.set_item("defect", defect)?;
            attributes.set_item("bound", bound)?;
        }
        attributes.set_item("record", record)
    })
}

/// A `GradientError`, or the error of a scene or a step.
pub(crate) fn gradient(error: GradientError) -> PyErr {
    let reason = variant(&error);
    match error {
        GradientError::Scene(error) => of_scene(error),
        GradientError::Step(error) => step(&error, None),
        error => {
            let message = error.to_string().replace("History::bytes", "bytes=");
            let message = message.replace("`run_at` makes", "`run(times=...)` makes");
            new("GradientError", message, |attributes| {
                attributes.set_item("reason", reason)
            })
        }
    }
}

/// `NotConverged`: the name of a variant.
fn variant(one: &impl std::fmt::Debug) -> String {
    let shown = format!("{one:?}");
    let name = shown.split(|c: char| !c.is_alphanumeric()).next();
    name.unwrap_or_default().to_owned()
}

/// The exception of a member of an ensemble.
pub(crate) fn member(failure: MemberFailure) -> PyErr {
    match failure {
        MemberFailure::Scene(error) => of_scene(error),
        MemberFailure::Step(error) => step(&error, None),
        MemberFailure::Other(error) => match error.downcast::<Raised>() {
            Ok(raised) => raised.0,
            Err(error) => PyRuntimeError::new_err(error.to_string()),
        },
        failure => new("EemError", failure.to_string(), |_| Ok(())),
    }
}

/// An exception on its way through an ensemble.
#[derive(Debug)]
pub(crate) struct Raised(pub(crate) PyErr);

impl std::fmt::Display for Raised {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

impl std::error::Error for Raised {}

/// A `MaterialError` with all mistakes and their drawings.
pub(crate) fn faults(faults: &Faults) -> PyErr {
    new("MaterialError", faults.to_string(), |attributes| {
        attributes.set_item("faults", list(attributes.py(), faults.all())?)
    })
}

/// Faults as a list of `eem.Fault`.
fn list<'py>(py: Python<'py>, faults: &[Fault]) -> PyResult<Bound<'py, PyList>> {
    let class = py.import("eem._errors")?.getattr("Fault")?;
    let all = faults.iter().map(|fault| {
        let place = (fault.line, fault.column, fault.width);
        let calls = fault.calls.clone();
        class.call1((
            fault.part.to_string(),
            place.0,
            place.1,
            place.2,
            &fault.text,
            &fault.help,
            calls,
        ))
    });
    PyList::new(py, all.collect::<PyResult<Vec<_>>>()?)
}

/// Why an act was refused.
pub(crate) fn refusal(refusal: Refusal) -> PyErr {
    match refusal {
        Refusal::Law(error) | Refusal::Solid(Refused::Law(error)) => law(error),
        Refusal::Rest(error) => equilibrium(error),
        Refusal::Solid(Refused::Shape) => {
            material(format!("no solid is of this material: {SHAPES}"))
        }
        Refusal::Solid(Refused::Mesh(error)) => scene(error.to_string()),
        Refusal::Solid(Refused::Line) => scene("a solid needs a scene in two or three dimensions"),
    }
}

pub(crate) fn law(error: LawError) -> PyErr {
    match error {
        LawError::Programs(all) => faults(&all),
        LawError::Solid => material(
            "the free energy is per volume, that of a solid: a spring has a `Stretch`; use Scene.solid"
                .to_owned(),
        ),
        error => material(error.to_string()),
    }
}

/// A `MaterialError` without places.
pub(crate) fn material(message: String) -> PyErr {
    new("MaterialError", message, |_| Ok(()))
}

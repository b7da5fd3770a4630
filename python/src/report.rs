//! `eem.StepReport`: what a step proves.

use eem::StepReport;
use pyo3::prelude::*;

/// The certificate of one step.
#[pyclass(frozen, get_all, name = "StepReport", module = "eem")]
pub(crate) struct Report {
    time: f64,
    step: f64,
    iterations: usize,
    update: f64,
    residual: f64,
    defect: f64,
    bound: f64,
    is_bound_wide: bool,
    production: f64,
    least_production: f64,
    error: f64,
    correction: f64,
}

impl From<&StepReport> for Report {
    fn from(report: &StepReport) -> Self {
        Self {
            time: report.time,
            step: report.step,
            iterations: report.iterations,
            update: report.update,
            residual: report.residual,
            defect: report.defect,
            bound: report.bound,
            is_bound_wide: report.is_bound_wide,
            production: report.production,
            least_production: report.least_production,
            error: report.error,
            correction: report.correction,
        }
    }
}

#[pymethods]
impl Report {
    fn __repr__(&self) -> String {
        let Self {
            time,
            step,
            iterations,
            defect,
            bound,
            ..
        } = self;
        format!(
            "StepReport(time={time:?}, step={step:?}, iterations={iterations}, defect={defect:.3e}, bound={bound:.3e})"
        )
    }
}

//! What a run leaves: rows of states and balances as arrays.

use std::sync::Arc;

use eem::{Ledger, SceneError, StepReport};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::built::Parts;
use crate::handle::Lineage;
use crate::run::AnyRun;

/// The scalar entries of a ledger, as their names and as their values; linear and angular momentum follow.
macro_rules! ledger {
    ($($entry:ident)*; $count:ident) => {
        pub(crate) const LEDGER: [&str; [$(stringify!($entry)),*].len() + 1] =
            [$(stringify!($entry),)* stringify!($count)];

        #[expect(clippy::cast_precision_loss, reason = "a count of less than 2⁵³")]
        pub(crate) fn entries<const D: usize>(ledger: &Ledger<D>) -> [f64; LEDGER.len()] {
            [$(ledger.$entry,)* ledger.$count as f64]
        }
    };
}

ledger! {
    kinetic_energy
    potential_energy
    internal_energy
    reservoir_heat
    lost_heat
    energy
    work
    heat
    balance
    element_entropy
    element_entropy_of_state
    reservoir_entropy
    thermostat_entropy
    entropy;
    unresolved
}

/// What is recorded.
#[derive(Clone, Copy)]
pub(crate) struct Wanted {
    /// Every how many steps; only the first and the last state without.
    pub(crate) every: Option<usize>,
    /// Stretches and forces of all springs, too.
    pub(crate) forces: bool,
    /// States at the given times only.
    pub(crate) at_times: bool,
}

/// Rows that grow while a run goes on.
#[derive(Default)]
pub(crate) struct Rows {
    pub(crate) time: Vec<f64>,
    pub(crate) positions: Vec<f64>,
    pub(crate) momenta: Vec<f64>,
    pub(crate) temperatures: Vec<f64>,
    pub(crate) viscous: Vec<f64>,
    pub(crate) ledger: Vec<f64>,
    stretches: Vec<f64>,
    forces: Vec<f64>,
    reports: Vec<StepReport>,
}

impl Rows {
    /// Adds the present state.
    pub(crate) fn add(
        &mut self,
        run: &dyn AnyRun,
        parts: &Parts,
        forces: bool,
    ) -> Result<(), SceneError> {
        self.time.push(run.time());
        for &node in &parts.nodes {
            run.add_position(node, &mut self.positions)?;
            run.add_momentum(node, &mut self.momenta)?;
        }
        for (index, &element) in parts.elements.iter().enumerate() {
            let temperature = if parts.thermal[index] {
                run.temperature(element)?
            } else {
                f64::NAN
            };
            self.temperatures.push(temperature);
            for dashpot in 0..parts.dashpots[index] {
                self.viscous.push(run.viscous_stretch(element, dashpot)?);
            }
            if forces {
                let is_spring = parts.springs[index];
                let [stretch, force] = if is_spring {
                    [run.stretch(element)?, run.force(element)?]
                } else {
                    [f64::NAN; 2]
                };
                self.stretches.push(stretch);
                self.forces.push(force);
            }
        }
        run.add_ledger(&mut self.ledger);
        Ok(())
    }

    /// Adds the certificate of a step.
    pub(crate) fn add_report(&mut self, report: &StepReport) {
        self.reports.push(*report);
    }

    /// The arrays of an `eem.Record`, by name.
    pub(crate) fn arrays<'py>(
        self,
        py: Python<'py>,
        dim: usize,
        parts: &Parts,
    ) -> PyResult<Bound<'py, PyDict>> {
        let arrays = PyDict::new(py);
        let (rows, nodes, springs) = (self.time.len(), parts.nodes.len(), parts.elements.len());
        let cubes = [("q", self.positions), ("p", self.momenta)];
        for (name, values) in cubes {
            let array = PyArray1::from_vec(py, values).reshape([rows, nodes, dim])?;
            arrays.set_item(name, array)?;
        }
        let dashpots = parts.dashpots.iter().sum();
        let widths = [
            ("theta", self.temperatures, springs),
            ("gamma", self.viscous, dashpots),
            ("ledger", self.ledger, LEDGER.len() + dim + 3),
        ];
        for (name, values, width) in widths {
            let array = PyArray1::from_vec(py, values).reshape([rows, width])?;
            arrays.set_item(name, array)?;
        }
        if !self.stretches.is_empty() {
            for (name, values) in [("stretches", self.stretches), ("forces", self.forces)] {
                let array = PyArray1::from_vec(py, values).reshape([rows, springs])?;
                arrays.set_item(name, array)?;
            }
        }
        arrays.set_item("time", PyArray1::from_vec(py, self.time))?;
        arrays.set_item("certificate", certificate(py, &self.reports)?)?;
        Ok(arrays)
    }
}

/// An entry of a report.
type Entry = fn(&StepReport) -> f64;

/// Its columns, each an array.
fn certificate<'py>(py: Python<'py>, reports: &[StepReport]) -> PyResult<Bound<'py, PyDict>> {
    let columns = PyDict::new(py);
    let numbers: [(&str, Entry); 10] = [
        ("time", |report| report.time),
        ("step", |report| report.step),
        ("update", |report| report.update),
        ("residual", |report| report.residual),
        ("defect", |report| report.defect),
        ("bound", |report| report.bound),
        ("production", |report| report.production),
        ("least_production", |report| report.least_production),
        ("error", |report| report.error),
        ("correction", |report| report.correction),
    ];
    for (name, number) in numbers {
        columns.set_item(name, PyArray1::from_iter(py, reports.iter().map(number)))?;
    }
    let iterations = reports
        .iter()
        .map(|report| report.iterations.cast_signed() as i64);
    columns.set_item("iterations", PyArray1::from_iter(py, iterations))?;
    let wide = reports.iter().map(|report| report.is_bound_wide);
    columns.set_item("is_bound_wide", PyArray1::from_iter(py, wide))?;
    Ok(columns)
}

/// An `eem.Record` of these rows.
pub(crate) fn record(
    py: Python<'_>,
    rows: Rows,
    (dim, parts, lineage): (usize, &Arc<Parts>, &Lineage),
    end: &str,
    scheme: &str,
) -> PyResult<Py<PyAny>> {
    let arrays = rows.arrays(py, dim, parts)?;
    let class = py.import("eem._record")?.getattr("Record")?;
    let dashpots = PyArray1::from_iter(py, parts.dashpots.iter().map(|&n| n.cast_signed() as i64));
    let made = class.call1((arrays, lineage.clone(), dashpots, end, scheme))?;
    Ok(made.unbind())
}

/// A ledger as one record of a structured array.
pub(crate) fn ledger(py: Python<'_>, run: &dyn AnyRun) -> PyResult<Py<PyAny>> {
    let mut row = Vec::new();
    run.add_ledger(&mut row);
    let width = row.len();
    let row = PyArray1::from_vec(py, row).reshape([1, width])?;
    let rows = py
        .import("eem._record")?
        .getattr("as_ledger")?
        .call1((row,))?;
    Ok(rows.get_item(0)?.unbind())
}

//! Recording chosen quantities of a run, every k-th step, column by column.

#[cfg(feature = "csv")]
mod csv;
mod quantity;

use core::ops::ControlFlow;
use std::borrow::Cow;

use thiserror::Error;

use crate::element::handle::SceneId;
use crate::run::simulation::Simulation;
use crate::scene::error::SceneError;
use crate::step::newton::StepReport;
use eem_material::number::compensated::Sum;

#[cfg(feature = "gradients")]
pub(crate) use quantity::axis_name;
pub use quantity::{CustomQuantity, Quantity};

/// The name of the first column.
const TIME: &str = "time";

/// Records quantities while a simulation runs.
///
/// The first column is the time, s; the first row is the state when the recorder was made. Memory grows
/// with the number of rows; [`reserve`](Self::reserve) reserves it in advance.
///
/// ```
/// use eem::prelude::*;
///
/// let mut scene = Scene::<2>::new();
/// let pivot = scene.anchor([3.0, 4.0]);
/// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.25)?;
/// let distance = move |run: &Simulation<2>| run.position(pivot).map_or(f64::NAN, |q| q.norm());
/// let quantities = [("q", Quantity::Position(pivot)), ("distance", Quantity::custom(distance))];
/// let mut recorder = Recorder::new(&run, quantities)?.every(2);
/// run.run_until_with(1.0, |run, report| recorder.observe(run, report))?;
///
/// let names: Vec<_> = recorder.columns().iter().map(|column| column.name()).collect();
/// assert_eq!(names, ["time", "q_x", "q_y", "distance"]);
/// assert_eq!(recorder.column("time"), Some([0.0, 0.5, 1.0].as_slice()));
/// assert_eq!(recorder.column("distance"), Some([5.0; 3].as_slice()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Recorder<const D: usize> {
    scene: SceneId,
    quantities: Vec<Quantity<D>>,
    columns: Vec<Column>,
    stride: usize,
    /// Steps, and their Newton iterations, since the last row.
    steps: usize,
    iterations: usize,
    /// The next row.
    row: Vec<f64>,
    /// For quantities of which rows have the changes: their sums at the last row, and at the row before it.
    sums: [Vec<Sum>; 2],
}

/// One component of a quantity in all rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    name: String,
    unit: Cow<'static, str>,
    values: Vec<f64>,
    /// Whether the values are whole numbers.
    is_count: bool,
}

impl Column {
    fn new(name: String, unit: &'static str, is_count: bool) -> Self {
        Self {
            is_count,
            ..Self::of(name, unit.into(), Vec::new())
        }
    }

    /// A column of numbers.
    pub(crate) const fn of(name: String, unit: Cow<'static, str>, values: Vec<f64>) -> Self {
        Self {
            name,
            unit,
            values,
            is_count: false,
        }
    }

    /// The values of the column with this name.
    pub(crate) fn find<'a>(columns: &'a [Self], name: &str) -> Option<&'a [f64]> {
        let mut columns = columns.iter();
        Some(columns.find(|column| column.name == name)?.values())
    }

    /// Adds a value.
    #[cfg(feature = "gradients")]
    pub(crate) fn push(&mut self, value: f64) {
        self.values.push(value);
    }

    /// The name: that of the quantity, for a vector with `_x`, `_y`, `_z`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The unit of the values; empty if there is none or it is unknown.
    #[must_use]
    pub fn unit(&self) -> &str {
        &self.unit
    }

    /// The name with the unit, if there is one: `q_x (m)`.
    #[must_use]
    pub fn head(&self) -> String {
        match self.unit() {
            "" => self.name.clone(),
            unit => format!("{} ({unit})", self.name),
        }
    }

    /// One value per row.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

/// Why quantities cannot be recorded.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The simulation has no such quantity.
    #[error("quantity `{name}`: {source}")]
    Quantity {
        /// Its name in the recorder.
        name: String,
        /// The error of the quantity.
        r#source: SceneError,
    },
    /// Two columns would have the same name; the first of all is `time`.
    #[error("there are two columns of the name `{name}`")]
    DuplicateColumn {
        /// The name.
        name: String,
    },
}

impl<const D: usize> Recorder<D> {
    /// A recorder of named quantities of `run`. It records the present state, and then every step.
    ///
    /// # Errors
    ///
    /// [`RecordError`] if `run` has no such quantity, or two columns have the same name.
    pub fn new<N: Into<String>>(
        run: &Simulation<D>,
        quantities: impl IntoIterator<Item = (N, Quantity<D>)>,
    ) -> Result<Self, RecordError> {
        let mut recorder = Self {
            scene: run.scene(),
            quantities: Vec::new(),
            columns: vec![Column::new(TIME.to_owned(), "s", false)],
            stride: 1,
            steps: 0,
            iterations: 0,
            row: Vec::new(),
            sums: [Vec::new(), Vec::new()],
        };
        for (name, quantity) in quantities {
            let name = name.into();
            if let Err(source) = quantity.check(run) {
                return Err(RecordError::Quantity { name, source });
            }
            for name in quantity.columns(&name) {
                if recorder.column(&name).is_some() {
                    return Err(RecordError::DuplicateColumn { name });
                }
                let column = Column::new(name, quantity.unit(), quantity.is_count());
                recorder.columns.push(column);
            }
            recorder.quantities.push(quantity);
        }
        let name = TIME.to_owned();
        let recorded = recorder.record(run);
        recorded.map_err(|source| RecordError::Quantity { name, source })?;
        Ok(recorder)
    }

    /// Records only every `stride`-th step; 0 counts as 1.
    #[must_use]
    pub fn every(mut self, stride: usize) -> Self {
        self.stride = stride.max(1);
        self
    }

    /// Reserves memory for this many more rows.
    pub fn reserve(&mut self, rows: usize) {
        for column in &mut self.columns {
            column.values.reserve(rows);
        }
    }

    /// Records a step if it is due. Use it as an observer in [`run_until_with`](Simulation::run_until_with).
    ///
    /// If `run` belongs to another scene or to a copy, nothing is recorded and the run stops;
    /// [`record`](Self::record) returns the reason.
    pub fn observe(&mut self, run: &Simulation<D>, report: &StepReport) -> ControlFlow<()> {
        self.steps += 1;
        self.iterations = self.iterations.saturating_add(report.iterations);
        if self.steps < self.stride {
            return ControlFlow::Continue(());
        }
        match self.record(run) {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        }
    }

    /// Records the present state, due or not. The next step is due a full stride later. If the last row has the
    /// same time and no step was observed since, it is replaced; so you can call this at the end of a run with any
    /// stride.
    ///
    /// # Errors
    ///
    /// [`SceneError::ForeignHandle`] if `run` belongs to another scene than the recorder. Nothing is recorded then.
    pub fn record(&mut self, run: &Simulation<D>) -> Result<(), SceneError> {
        if run.scene() != self.scene {
            let handle = "the recorder".to_owned();
            return Err(SceneError::ForeignHandle { handle });
        }
        let mut ledger = None;
        let time = run.time();
        let last = self.column(TIME).and_then(<[f64]>::last);
        let is_again = self.steps == 0 && last.is_some_and(|last| last.to_bits() == time.to_bits());
        // The row that is replaced began where the row before it ended.
        let [last, before] = &self.sums;
        let mut since = if is_again { before.iter() } else { last.iter() };
        self.row.clear();
        self.row.push(time);
        for quantity in &self.quantities {
            let row = &mut self.row;
            quantity.append(run, self.iterations, &mut ledger, &mut since, row)?;
        }
        if !is_again {
            self.sums.swap(0, 1);
            self.sums[0].clear();
            for quantity in &self.quantities {
                quantity.add_metered(run, &mut self.sums[0])?;
            }
        }
        for (column, &value) in self.columns.iter_mut().zip(&self.row) {
            if !is_again {
                column.values.push(value);
            } else if !column.is_count
                && let Some(last) = column.values.last_mut()
            {
                *last = value;
            }
        }
        (self.steps, self.iterations) = (0, 0);
        Ok(())
    }

    /// All columns, of equal length: time, then the quantities in their order.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The values of the column with this name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        Column::find(&self.columns, name)
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |time| time.values.len())
    }
}

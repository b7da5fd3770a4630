//! The table of derivatives along a run.

use crate::run::recorder::Column;

/// The derivatives of quantities by inputs at every state of a history, see
/// [`Simulation::sensitivities`](crate::Simulation::sensitivities).
///
/// The columns are those of a [`Recorder`](crate::Recorder): the time, s, then for each quantity (each component of a vector) one per
/// input. Rows are states, from the first one on.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivities {
    pub(crate) columns: Vec<Column>,
    pub(crate) inputs: usize,
}

impl Sensitivities {
    /// The times, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        self.columns[0].values()
    }

    /// All columns, the time first.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The values of the column with this name, `z by stiffness of element 0 (Spring)`.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        Column::find(&self.columns, name)
    }

    /// The derivatives of a component by an input, both counted from 0: components in the order of the quantities that were asked for,
    /// all of one before those of the next. `None` without such a component or input.
    #[must_use]
    pub fn of(&self, component: usize, input: usize) -> Option<&[f64]> {
        let own = input < self.inputs;
        let place = component.checked_mul(self.inputs)?.checked_add(input + 1)?;
        self.columns.get(place).filter(|_| own).map(Column::values)
    }
}

//! The inputs of one member.

use super::error::InputError;

/// The inputs of one member: its id and a number per column.
///
/// ```
/// use eem::sweep::Inputs;
///
/// let inputs = Inputs::grid([("stiffness", vec![1.0, 2.0]), ("mass", vec![5.0])])?;
/// let mut values = Vec::new();
/// let row = inputs.row(1, &mut values);
/// assert_eq!((row.id(), row.number("stiffness")?, row.number("mass")?), (1, 2.0, 5.0));
/// assert!(row.number("length").is_err());
/// # Ok::<(), eem::sweep::InputError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    id: u64,
    columns: &'a [String],
    values: &'a [f64],
}

impl<'a> Row<'a> {
    /// The row with these values, one per column.
    pub(crate) fn new(id: u64, columns: &'a [String], values: &'a [f64]) -> Self {
        Self {
            id,
            columns,
            values,
        }
    }

    /// The id of the member in every file of the sweep.
    #[must_use]
    pub fn id(&self) -> u64 {
        self.id
    }

    /// The value in the column of this name.
    ///
    /// # Errors
    ///
    /// [`InputError::NoColumn`].
    pub fn number(&self, name: &str) -> Result<f64, InputError> {
        let mut columns = self.columns.iter().zip(self.values);
        let found = columns.find(|(column, _)| *column == name);
        found
            .map(|(_, &value)| value)
            .ok_or_else(|| InputError::NoColumn {
                name: name.to_owned(),
                columns: self.columns.join(", "),
            })
    }

    /// All values, in the order of the columns.
    #[must_use]
    pub fn values(&self) -> &'a [f64] {
        self.values
    }
}

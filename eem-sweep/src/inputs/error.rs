//! Errors of the inputs of a sweep.

use thiserror::Error;

/// Why inputs, or the row of one member, cannot be used.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InputError {
    /// A column that the experiment reads does not exist.
    #[error("there is no input column `{name}`; there are: {columns}")]
    NoColumn {
        /// The name that was asked for.
        name: String,
        /// The names that exist.
        columns: String,
    },
    /// Two columns have one name, or the name of a column that every table has.
    #[error(
        "there are two columns `{name}`: inputs, outputs and id, failure, failed_at (s), message need different names"
    )]
    DuplicateColumn {
        /// The name.
        name: String,
    },
    /// The name of a column has a line break or another control character.
    #[error(
        "the column {name:?} has a control character in its name; heads of tables are one line"
    )]
    ColumnName {
        /// The name.
        name: String,
    },
    /// A sweep has no member.
    #[error("the inputs have no member; give every axis a value, or ask for one member at least")]
    Empty,
    /// There are more members than can be numbered.
    #[error("the inputs have {members:.3e} members, at most {most} can be numbered", most = u32::MAX)]
    TooMany {
        /// The number of members.
        members: f64,
    },
    /// A range has no width, or its ends are no numbers.
    #[error(
        "column `{column}` ranges from {low} to {high}; both ends must be finite, the second larger"
    )]
    Range {
        /// The name of the column.
        column: String,
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
    },
    /// A row has too many or too few values.
    #[error("row {row} has {given} values, there are {expected} columns")]
    Ragged {
        /// The number of the row, from 0.
        row: usize,
        /// The number of its values.
        given: usize,
        /// The number of columns.
        expected: usize,
    },
    /// Two rows have one id.
    #[error("two rows have the id {id}; ids must differ, as records are found by them")]
    DuplicateId {
        /// The id.
        id: u64,
    },
    /// A cell of a file is no number, or an id is no whole number.
    #[error("{path}, line {line}, column `{column}`: `{text}` is not a {expected}")]
    Cell {
        /// The file.
        path: String,
        /// The line, from 1.
        line: u64,
        /// The name of the column.
        column: String,
        /// The text of the cell.
        text: String,
        /// The expected kind of number.
        expected: &'static str,
    },
    /// A file with inputs cannot be read.
    #[error("cannot read the inputs {path}: {reason}")]
    File {
        /// The file.
        path: String,
        /// Why.
        reason: String,
    },
    /// An error of the caller's own, from the function that makes an input of a row.
    #[error("{0}")]
    Refused(String),
}

impl InputError {
    /// The caller's reason for refusing a row, which is then the failure of its member.
    ///
    /// ```
    /// use eem::sweep::InputError;
    ///
    /// let refused = InputError::refused("a stiffness of -3 N/m");
    /// assert_eq!(refused.to_string(), "a stiffness of -3 N/m");
    /// ```
    pub fn refused(reason: impl Into<String>) -> Self {
        Self::Refused(reason.into())
    }
}

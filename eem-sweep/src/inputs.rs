//! The inputs in which the members of a sweep differ: columns of numbers, and ids that are the same in every process.

mod error;
mod latin;
mod row;
mod table;

use std::ops::Range;
use std::path::Path;

use crate::digest::Digest;
use latin::Latin;
use table::Table;

pub use error::InputError;
pub use row::Row;

/// The inputs of all members: one number per member and named column, and an id per member.
///
/// Ids are 0, 1, 2 …, or come from the column `id` of a CSV file. Rows of grids and Latin hypercubes are computed when
/// they are needed, with the same result in every process.
///
/// ```
/// use eem::sweep::Inputs;
///
/// let inputs = Inputs::grid([("stiffness", vec![1.0, 2.0, 3.0]), ("mass", vec![5.0, 6.0])])?;
/// assert_eq!(inputs.members(), 6);
/// let mut values = Vec::new();
/// assert_eq!(inputs.row(4, &mut values).values(), [3.0, 5.0]);
/// # Ok::<(), eem::sweep::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Inputs {
    columns: Vec<String>,
    source: Source,
}

/// Where the values come from.
#[derive(Clone, Debug)]
enum Source {
    Grid(Vec<Vec<f64>>),
    Latin(Latin),
    Table(Table),
}

impl Inputs {
    /// All combinations of values on some axes; the last axis varies fastest.
    ///
    /// # Errors
    ///
    /// [`InputError`] if an axis has no value, or there are 2³² members. Two equal names are an error of the sweep.
    pub fn grid<N: Into<String>>(
        axes: impl IntoIterator<Item = (N, Vec<f64>)>,
    ) -> Result<Self, InputError> {
        let axes = axes.into_iter().map(|(name, values)| (name.into(), values));
        let (columns, axes): (Vec<String>, Vec<Vec<f64>>) = axes.unzip();
        let counts = axes.iter().map(Vec::len);
        let members = counts.fold(1.0, |product, count| product * count as f64);
        if axes.is_empty() || members == 0.0 {
            return Err(InputError::Empty);
        }
        if members > f64::from(u32::MAX) {
            return Err(InputError::TooMany { members });
        }
        Self::checked(columns, Source::Grid(axes))
    }

    /// A Latin hypercube: every range is divided into n equal layers, one per member in random order, with a random
    /// value in the layer. The same seed gives the same members on every machine.
    ///
    /// It takes 4 bytes of memory per member and column. If only the order of magnitude of a quantity is known, use
    /// its logarithm as the column, `("log10 stiffness", 3.0..6.0)`, and compute the power in the function that
    /// makes inputs from rows: powers differ in the last bit between machines, and rows must not.
    ///
    /// ```
    /// use eem::sweep::Inputs;
    ///
    /// let inputs = Inputs::latin_hypercube(10, 2012, [("stiffness", 90.0..110.0), ("mass", 1.0..2.0)])?;
    /// let mut values = Vec::new();
    /// let mut layers: Vec<f64> = (0..10)
    ///     .map(|member| ((inputs.row(member, &mut values).values()[0] - 90.0) / 2.0).floor())
    ///     .collect();
    /// layers.sort_by(f64::total_cmp);
    /// assert_eq!(layers, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
    /// # Ok::<(), eem::sweep::InputError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`InputError`] if there is no member or no range, a range is empty, or there are 2³² members. Two equal names are
    /// an error of the sweep.
    pub fn latin_hypercube<N: Into<String>>(
        members: usize,
        seed: u64,
        ranges: impl IntoIterator<Item = (N, Range<f64>)>,
    ) -> Result<Self, InputError> {
        let ranges = ranges.into_iter().map(|(name, range)| (name.into(), range));
        let (columns, ranges): (Vec<String>, Vec<Range<f64>>) = ranges.unzip();
        for (column, range) in columns.iter().zip(&ranges) {
            if !(range.start.is_finite() && range.end.is_finite() && range.start < range.end) {
                return Err(InputError::Range {
                    column: column.clone(),
                    low: range.start,
                    high: range.end,
                });
            }
        }
        let count = u32::try_from(members).map_err(|_| InputError::TooMany {
            members: members as f64,
        })?;
        Self::checked(columns, Source::Latin(Latin::new(count, seed, ranges)))
    }

    /// Given rows, kept in memory.
    ///
    /// # Errors
    ///
    /// [`InputError`] if there is no row, or rows have different lengths. Two equal names are an error of the sweep.
    pub fn rows<N: Into<String>, R: AsRef<[f64]>>(
        columns: impl IntoIterator<Item = N>,
        rows: impl IntoIterator<Item = R>,
    ) -> Result<Self, InputError> {
        let columns: Vec<String> = columns.into_iter().map(Into::into).collect();
        let (mut ids, mut values) = (Vec::new(), Vec::new());
        for (number, row) in rows.into_iter().enumerate() {
            let row = row.as_ref();
            if row.len() != columns.len() {
                return Err(InputError::Ragged {
                    row: number,
                    given: row.len(),
                    expected: columns.len(),
                });
            }
            ids.push(number as u64);
            values.extend_from_slice(row);
        }
        Self::checked(columns, Source::Table(Table { ids, values }))
    }

    /// The rows of a CSV file with a header, kept in memory, in ascending order of the column `id` if there is one.
    ///
    /// # Errors
    ///
    /// [`InputError`] if the file cannot be read, a cell is not a number, an id occurs twice, there is no row, or
    /// two names are equal.
    pub fn csv(path: impl AsRef<Path>) -> Result<Self, InputError> {
        let (columns, table) = Table::read(path.as_ref())?;
        Self::checked(columns, Source::Table(table))
    }

    /// An error if there is no member.
    fn checked(columns: Vec<String>, source: Source) -> Result<Self, InputError> {
        let inputs = Self { columns, source };
        if inputs.members() == 0 {
            return Err(InputError::Empty);
        }
        Ok(inputs)
    }

    /// The number of members.
    #[must_use]
    pub fn members(&self) -> usize {
        match &self.source {
            Source::Grid(axes) => axes.iter().map(Vec::len).product(),
            Source::Latin(latin) => latin.members(),
            Source::Table(table) => table.ids.len(),
        }
    }

    /// The column names.
    #[must_use]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The id of a member, by its place in the ascending order of ids, from 0.
    pub(crate) fn id(&self, place: usize) -> u64 {
        match &self.source {
            Source::Grid(_) | Source::Latin(_) => place as u64,
            Source::Table(table) => table.ids[place],
        }
    }

    /// How many members have a smaller id.
    pub(crate) fn place(&self, id: u64) -> usize {
        match &self.source {
            Source::Grid(_) | Source::Latin(_) => {
                usize::try_from(id).map_or(self.members(), |place| place.min(self.members()))
            }
            Source::Table(table) => table.ids.partition_point(|&other| other < id),
        }
    }

    /// Appends the values of a member.
    pub(crate) fn push_values(&self, place: usize, values: &mut Vec<f64>) {
        match &self.source {
            Source::Grid(axes) => {
                let start = values.len();
                let mut rest = place;
                for axis in axes.iter().rev() {
                    values.push(axis[rest % axis.len()]);
                    rest /= axis.len();
                }
                values[start..].reverse();
            }
            Source::Latin(latin) => latin.values(place, values),
            Source::Table(table) => {
                let width = self.columns.len();
                values.extend_from_slice(&table.values[place * width..(place + 1) * width]);
            }
        }
    }

    /// The row of a member, by its index in the ascending order of ids, from 0. `values` is the buffer for its
    /// numbers.
    ///
    /// # Panics
    ///
    /// If the index is too large.
    pub fn row<'a>(&'a self, place: usize, values: &'a mut Vec<f64>) -> Row<'a> {
        values.clear();
        self.push_values(place, values);
        Row::new(self.id(place), &self.columns, values)
    }

    /// A digest of everything that determines the rows: of a Latin hypercube the seed, the ranges and a sample of rows, so
    /// that no process has to compute the rows of others.
    pub(crate) fn digest(&self) -> String {
        const SAMPLE: usize = 64;
        let mut digest = Digest::new();
        digest.whole(self.members() as u64);
        for column in &self.columns {
            digest.text(column);
        }
        match &self.source {
            Source::Grid(axes) => {
                digest.text("grid");
                for axis in axes {
                    digest.numbers(axis);
                }
            }
            Source::Latin(latin) => {
                digest.text("latin hypercube");
                let (seed, ranges) = latin.recipe();
                digest.whole(seed);
                for range in ranges {
                    digest.numbers(&[range.start, range.end]);
                }
                let mut values = Vec::new();
                for place in (0..self.members()).step_by(self.members().div_ceil(SAMPLE)) {
                    digest.numbers(self.row(place, &mut values).values());
                }
            }
            Source::Table(table) => {
                digest.text("table");
                for &id in &table.ids {
                    digest.whole(id);
                }
                digest.numbers(&table.values);
            }
        }
        digest.hex()
    }
}

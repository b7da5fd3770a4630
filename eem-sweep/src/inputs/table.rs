//! Rows that are given one by one, or read from a CSV file.

use std::fs::File;
use std::path::Path;

use super::error::InputError;

/// The head of the column with ids.
const ID: &str = "id";

/// All values, row after row, in ascending order of ids.
#[derive(Clone, Debug)]
pub(super) struct Table {
    pub(super) ids: Vec<u64>,
    pub(super) values: Vec<f64>,
}

impl Table {
    /// Sorts rows of `width` values by their ids.
    fn sorted(ids: Vec<u64>, values: Vec<f64>, width: usize) -> Result<Self, InputError> {
        if let Some(pair) = ids.windows(2).find(|pair| pair[0] >= pair[1]) {
            if pair[0] == pair[1] {
                return Err(InputError::DuplicateId { id: pair[0] });
            }
        } else {
            return Ok(Self { ids, values });
        }
        let mut order: Vec<usize> = (0..ids.len()).collect();
        order.sort_by_key(|&row| ids[row]);
        let row = |&row: &usize| values[row * width..(row + 1) * width].iter().copied();
        let sorted = order.iter().map(|&row| ids[row]).collect();
        Self::sorted(sorted, order.iter().flat_map(row).collect(), width)
    }

    /// Reads a file whose first line has the names of the columns.
    pub(super) fn read(path: &Path) -> Result<(Vec<String>, Self), InputError> {
        let name = path.display().to_string();
        let unreadable = |reason: String| InputError::File {
            path: name.clone(),
            reason,
        };
        let file = File::open(path).map_err(|error| unreadable(error.to_string()))?;
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_reader(file);
        let heads = reader.headers().map_err(|e| unreadable(e.to_string()))?;
        let heads: Vec<String> = heads.iter().map(str::to_owned).collect();
        let repeated = (1..heads.len()).find(|&at| heads[..at].contains(&heads[at]));
        if let Some(name) = repeated.map(|at| heads[at].clone()) {
            return Err(InputError::DuplicateColumn { name });
        }
        let id_column = heads.iter().position(|head| head == ID);
        let (mut ids, mut values) = (Vec::new(), Vec::new());
        let mut record = csv::StringRecord::new();
        while reader
            .read_record(&mut record)
            .map_err(|e| unreadable(e.to_string()))?
        {
            let line = record.position().map_or(0, csv::Position::line);
            let wrong = |column: usize, expected| InputError::Cell {
                path: name.clone(),
                line,
                column: heads[column].clone(),
                text: record[column].to_owned(),
                expected,
            };
            for (column, text) in record.iter().enumerate() {
                if Some(column) == id_column {
                    let id = text.parse().map_err(|_| wrong(column, "whole number"))?;
                    ids.push(id);
                } else {
                    let value: f64 = text.parse().map_err(|_| wrong(column, "number"))?;
                    // `1e400` is parsed as infinite; only `inf` may mean that.
                    if value.is_infinite() && text.contains(|c: char| c.is_ascii_digit()) {
                        return Err(wrong(column, "number that 64 bits can hold"));
                    }
                    values.push(value);
                }
            }
            if id_column.is_none() {
                ids.push(ids.len() as u64);
            }
        }
        let columns: Vec<String> = heads.into_iter().filter(|head| head != ID).collect();
        let table = Self::sorted(ids, values, columns.len())?;
        Ok((columns, table))
    }
}

//! Tables as Arrow IPC files, in record batches of a fixed size, so that the same rows have the same bytes.

use std::io::{self, Cursor, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch, StringArray, UInt64Array};
use arrow_ipc::reader::FileReader;
use arrow_ipc::writer::FileWriter;
use arrow_schema::{ArrowError, DataType, Field, Schema};

use super::heads::{FAILED_AT, FAILURE, Heads, ID, MESSAGE};
use crate::error::SweepError;
use crate::record::{Batch, Failure, FailureKind};

/// Rows of a record batch.
const ROWS: usize = 4096;

fn schema(heads: &Heads) -> Schema {
    let number = |name: &String, nullable| Field::new(name, DataType::Float64, nullable);
    let mut fields = vec![
        Field::new(ID, DataType::UInt64, false),
        Field::new(FAILURE, DataType::Utf8, true),
    ];
    fields.extend(heads.inputs.iter().map(|head| number(head, false)));
    fields.extend(heads.outputs.iter().map(|head| number(head, true)));
    fields.push(Field::new(FAILED_AT, DataType::Float64, true));
    fields.push(Field::new(MESSAGE, DataType::Utf8, true));
    Schema::new(fields)
}

/// Collects rows column by column and writes record batches.
pub(crate) struct Writer<W: Write> {
    to: FileWriter<W>,
    schema: Arc<Schema>,
    ids: Vec<u64>,
    failures: Vec<Option<String>>,
    inputs: Vec<Vec<f64>>,
    outputs: Vec<Vec<f64>>,
    times: Vec<Option<f64>>,
    messages: Vec<Option<String>>,
}

impl<W: Write> Writer<W> {
    /// Writes the heads.
    pub(super) fn new(to: W, heads: &Heads) -> io::Result<Self> {
        let schema = Arc::new(schema(heads));
        Ok(Self {
            to: FileWriter::try_new(to, &schema).map_err(of_io)?,
            schema,
            ids: Vec::new(),
            failures: Vec::new(),
            inputs: vec![Vec::new(); heads.inputs.len()],
            outputs: vec![Vec::new(); heads.outputs.len()],
            times: Vec::new(),
            messages: Vec::new(),
        })
    }

    /// Writes a row for each member.
    pub(super) fn batch(&mut self, batch: &Batch) -> io::Result<()> {
        let (inputs, outputs) = (self.inputs.len(), self.outputs.len());
        for (row, (id, failure)) in batch.ids.iter().zip(&batch.failures).enumerate() {
            let values = &batch.inputs[row * inputs..];
            let columns = self.inputs.iter_mut().zip(values);
            columns.for_each(|(column, value)| column.push(*value));
            let values = &batch.outputs[row * outputs..];
            let columns = self.outputs.iter_mut().zip(values);
            columns.for_each(|(column, value)| column.push(*value));
            self.failures
                .push(failure.as_ref().map(|f| f.kind.name().to_owned()));
            self.times.push(failure.as_ref().and_then(|f| f.time));
            self.messages
                .push(failure.as_ref().map(|f| f.message.clone()));
            self.end_row(*id)?;
        }
        Ok(())
    }

    /// Writes the current row of a reader.
    pub(super) fn row(&mut self, reader: &Reader) -> io::Result<()> {
        let Some((batch, row)) = reader.at() else {
            return Ok(());
        };
        let failure = text(batch, 1, row);
        let mut column = 2;
        for values in self.inputs.iter_mut().chain(&mut self.outputs) {
            values.push(number(batch, column, row).unwrap_or_default());
            column += 1;
        }
        self.failures.push(failure.map(str::to_owned));
        self.times.push(number(batch, column, row));
        self.messages
            .push(text(batch, column + 1, row).map(str::to_owned));
        self.end_row(reader.id().unwrap_or_default())
    }

    /// Writes a record batch when it is full.
    fn end_row(&mut self, id: u64) -> io::Result<()> {
        self.ids.push(id);
        if self.ids.len() == ROWS {
            self.flush()?;
        }
        Ok(())
    }

    /// Writes the rows that have been collected.
    fn flush(&mut self) -> io::Result<()> {
        use std::mem::take;

        if self.ids.is_empty() {
            return Ok(());
        }
        let failures = take(&mut self.failures);
        let mut columns: Vec<ArrayRef> = vec![
            Arc::new(UInt64Array::from(take(&mut self.ids))),
            Arc::new(StringArray::from_iter(&failures)),
        ];
        for values in &mut self.inputs {
            columns.push(Arc::new(Float64Array::from(take(values))));
        }
        let none_failed = failures.iter().all(Option::is_none);
        for values in &mut self.outputs {
            let values = take(values);
            columns.push(Arc::new(if none_failed {
                Float64Array::from(values)
            } else {
                // Outputs of failed members have no meaning.
                let pairs = values.into_iter().zip(&failures);
                pairs.map(|(v, f)| f.is_none().then_some(v)).collect()
            }));
        }
        columns.push(Arc::new(Float64Array::from(take(&mut self.times))));
        columns.push(Arc::new(StringArray::from(take(&mut self.messages))));
        let batch = RecordBatch::try_new(self.schema.clone(), columns).map_err(of_io)?;
        self.to.write(&batch).map_err(of_io)
    }

    /// Writes what is left.
    pub(super) fn finish(mut self) -> io::Result<()> {
        self.flush()?;
        self.to.finish().map_err(of_io)
    }
}

/// Unwraps an error of the file system, so that a full disk is recognised.
fn of_io(error: ArrowError) -> io::Error {
    match error {
        ArrowError::IoError(_, error) => error,
        other => io::Error::other(other),
    }
}

/// Reads record batches.
pub(crate) struct Reader {
    path: PathBuf,
    from: FileReader<Cursor<Vec<u8>>>,
    batch: Option<RecordBatch>,
    row: usize,
}

impl Reader {
    /// Checks the columns of a file and goes to the first row. The caller has verified the bytes: a damaged file may make
    /// this reserve any amount of memory.
    pub(super) fn open(path: &Path, bytes: Vec<u8>, heads: &Heads) -> Result<Self, SweepError> {
        let from = FileReader::try_new(Cursor::new(bytes), None);
        let from = from.map_err(|error| damaged(path, &error))?;
        if *from.schema() != schema(heads) {
            return Err(damaged(path, &"it has other columns"));
        }
        let mut reader = Self {
            path: path.to_owned(),
            from,
            batch: None,
            row: 0,
        };
        reader.next_batch()?;
        Ok(reader)
    }

    /// The record batch and the row in it.
    fn at(&self) -> Option<(&RecordBatch, usize)> {
        self.batch.as_ref().map(|batch| (batch, self.row))
    }

    /// The id of the row; `None` after the last one.
    pub(super) fn id(&self) -> Option<u64> {
        let (batch, row) = self.at()?;
        let ids = batch.column(0).as_any().downcast_ref::<UInt64Array>()?;
        Some(ids.value(row))
    }

    /// Whether the member has failed.
    pub(super) fn has_failed(&self) -> bool {
        self.at()
            .is_some_and(|(batch, row)| !batch.column(1).is_null(row))
    }

    /// Fills in the outputs of the row, or returns the failure.
    pub(super) fn result(
        &self,
        heads: &Heads,
        outputs: &mut Vec<f64>,
    ) -> Result<Option<Failure>, SweepError> {
        let wrong = || damaged(&self.path, &"a row is none that was written");
        let (batch, row) = self.at().ok_or_else(wrong)?;
        let first = 2 + heads.inputs.len();
        let end = first + heads.outputs.len();
        if let Some(kind) = text(batch, 1, row) {
            return Ok(Some(Failure {
                kind: FailureKind::from_name(kind).ok_or_else(wrong)?,
                time: number(batch, end, row),
                message: text(batch, end + 1, row).unwrap_or_default().to_owned(),
            }));
        }
        for column in first..end {
            outputs.push(number(batch, column, row).ok_or_else(wrong)?);
        }
        Ok(None)
    }

    /// Whether two rows have the same bits.
    pub(super) fn equals(&self, other: &Self) -> bool {
        let (Some((one, row)), Some((two, place))) = (self.at(), other.at()) else {
            return false;
        };
        let bits = |batch, column, row| number(batch, column, row).map(f64::to_bits);
        self.id() == other.id()
            && one.num_columns() == two.num_columns()
            && (1..one.num_columns()).all(|column| {
                text(one, column, row) == text(two, column, place)
                    && bits(one, column, row) == bits(two, column, place)
            })
    }

    /// Goes to the next row.
    pub(super) fn advance(&mut self) -> Result<(), SweepError> {
        self.row += 1;
        let rows = self.batch.as_ref().map_or(0, RecordBatch::num_rows);
        if self.row >= rows {
            self.next_batch()?;
        }
        Ok(())
    }

    fn next_batch(&mut self) -> Result<(), SweepError> {
        self.row = 0;
        self.batch = loop {
            match self.from.next() {
                None => break None,
                Some(Ok(batch)) if batch.num_rows() == 0 => {}
                Some(Ok(batch)) => break Some(batch),
                Some(Err(error)) => return Err(damaged(&self.path, &error)),
            }
        };
        Ok(())
    }
}

/// The number in a cell, if there is one.
fn number(batch: &RecordBatch, column: usize, row: usize) -> Option<f64> {
    let column = batch.column(column).as_any();
    let numbers = column.downcast_ref::<Float64Array>()?;
    numbers.is_valid(row).then(|| numbers.value(row))
}

/// The text in a cell, if there is one.
fn text(batch: &RecordBatch, column: usize, row: usize) -> Option<&str> {
    let column = batch.column(column).as_any();
    let texts = column.downcast_ref::<StringArray>()?;
    texts.is_valid(row).then(|| texts.value(row))
}

fn damaged(path: &Path, reason: &dyn std::fmt::Display) -> SweepError {
    SweepError::Damaged {
        path: path.to_owned(),
        reason: reason.to_string(),
    }
}

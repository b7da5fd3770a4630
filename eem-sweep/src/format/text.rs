//! Tables as CSV: a member is a line, so that lines can be counted, compared and copied without reading numbers.

use std::fmt::Write as _;
use std::io::{self, BufRead, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::heads::Heads;
use crate::error::SweepError;
use crate::files::failed;
use crate::record::{Batch, Failure, FailureKind};

/// Writes lines.
pub(crate) struct Writer<W: Write> {
    to: W,
    lines: String,
}

impl<W: Write> Writer<W> {
    /// Writes the heads.
    pub(super) fn new(mut to: W, heads: &Heads) -> io::Result<Self> {
        to.write_all(head_line(heads).as_bytes())?;
        Ok(Self {
            to,
            lines: String::new(),
        })
    }

    /// Writes a line for each member.
    pub(super) fn batch(&mut self, batch: &Batch) -> io::Result<()> {
        let members = batch.ids.len().max(1);
        let (inputs, outputs) = (batch.inputs.len() / members, batch.outputs.len() / members);
        for (row, (id, failure)) in batch.ids.iter().zip(&batch.failures).enumerate() {
            self.lines.clear();
            let inputs = &batch.inputs[row * inputs..(row + 1) * inputs];
            let outputs = &batch.outputs[row * outputs..(row + 1) * outputs];
            push_line(&mut self.lines, *id, inputs, outputs, failure.as_ref())
                .map_err(io::Error::other)?;
            self.to.write_all(self.lines.as_bytes())?;
        }
        Ok(())
    }

    /// Writes a line that was read.
    pub(super) fn line(&mut self, line: &[u8]) -> io::Result<()> {
        self.to.write_all(line)
    }

    /// Flushes the file.
    pub(super) fn finish(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// Adds a line, with the shortest digits that give back the bits of a number.
fn push_line(
    line: &mut String,
    id: u64,
    inputs: &[f64],
    outputs: &[f64],
    failure: Option<&Failure>,
) -> Result<(), std::fmt::Error> {
    let mut digits = zmij::Buffer::new();
    write!(line, "{id},{}", failure.map_or("", |f| f.kind.name()))?;
    for input in inputs {
        line.push(',');
        line.push_str(digits.format(*input));
    }
    match failure {
        None => {
            for output in outputs {
                line.push(',');
                line.push_str(digits.format(*output));
            }
            line.push_str(",,\n");
        }
        Some(failure) => {
            line.extend(outputs.iter().map(|_| ','));
            line.push(',');
            if let Some(time) = failure.time {
                line.push_str(digits.format(time));
            }
            writeln!(line, ",{}", quoted(&failure.message))?;
        }
    }
    Ok(())
}

/// The first line.
fn head_line(heads: &Heads) -> String {
    let heads: Vec<String> = heads.all().into_iter().map(quoted).collect();
    heads.join(",") + "\n"
}

/// A cell, in quotes if it needs them (RFC 4180); it has no line break.
fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// Reads lines; of each line only the id and whether there is a failure, until outputs are requested.
pub(crate) struct Reader {
    path: PathBuf,
    bytes: Vec<u8>,
    line: Range<usize>,
    row: Option<(u64, bool)>,
}

impl Reader {
    /// Checks the heads of a file and goes to the first line.
    pub(super) fn open(path: &Path, bytes: Vec<u8>, heads: &Heads) -> Result<Self, SweepError> {
        let mut reader = Self {
            path: path.to_owned(),
            bytes,
            line: 0..0,
            row: None,
        };
        if !reader.read()? || reader.line() != head_line(heads).as_bytes() {
            return Err(reader.damaged("it has other columns"));
        }
        reader.advance()?;
        Ok(reader)
    }

    /// The id of the line; `None` after the last one.
    pub(super) fn id(&self) -> Option<u64> {
        self.row.map(|(id, _)| id)
    }

    /// Whether the member has failed.
    pub(super) fn has_failed(&self) -> bool {
        self.row.is_some_and(|(_, failed)| failed)
    }

    /// The line as it is.
    pub(super) fn line(&self) -> &[u8] {
        &self.bytes[self.line.clone()]
    }

    /// Fills in the outputs of the line, or returns the failure.
    pub(super) fn result(
        &self,
        heads: &Heads,
        outputs: &mut Vec<f64>,
    ) -> Result<Option<Failure>, SweepError> {
        let mut line = csv::StringRecord::new();
        let mut reader = csv::ReaderBuilder::new();
        let mut reader = reader.has_headers(false).from_reader(self.line());
        let read = reader.read_record(&mut line);
        let wrong = || self.damaged("a line is none that was written");
        let cells: Vec<&str> = line.iter().collect();
        let first = 2 + heads.inputs.len();
        if read.is_err() || cells.len() != first + heads.outputs.len() + 2 {
            return Err(wrong());
        }
        let (values, failure) = cells[first..].split_at(heads.outputs.len());
        if cells[1].is_empty() {
            let values = values.iter().map(|cell| cell.parse::<f64>());
            outputs.extend(values.collect::<Result<Vec<_>, _>>().map_err(|_| wrong())?);
            return Ok(None);
        }
        Ok(Some(Failure {
            kind: FailureKind::from_name(cells[1]).ok_or_else(wrong)?,
            time: failure[0].parse().ok(),
            message: failure[1].to_owned(),
        }))
    }

    /// Goes to the next line.
    pub(super) fn advance(&mut self) -> Result<(), SweepError> {
        self.row = None;
        if self.read()? {
            let mut cells = self.line().split(|&byte| byte == b',');
            let id = cells.next().and_then(|id| str::from_utf8(id).ok());
            let id = id.and_then(|id| id.parse().ok());
            match (id, cells.next()) {
                (Some(id), Some(failure)) => self.row = Some((id, !failure.is_empty())),
                _ => return Err(self.damaged("a line has no id")),
            }
        }
        Ok(())
    }

    /// Finds the next line; says whether there is one.
    fn read(&mut self) -> Result<bool, SweepError> {
        let start = self.line.end;
        let mut rest = &self.bytes[start..];
        let length = rest.skip_until(b'\n');
        let length = length.map_err(failed("read", &self.path))?;
        self.line = start..start + length;
        match self.line().last() {
            None => Ok(false),
            Some(b'\n') => Ok(true),
            Some(_) => Err(self.damaged("its last line is torn")),
        }
    }

    fn damaged(&self, reason: &str) -> SweepError {
        SweepError::Damaged {
            path: self.path.clone(),
            reason: reason.to_owned(),
        }
    }
}

//! Writing and reading of records: one table per part, in CSV or as an Arrow IPC file.

#[cfg(feature = "arrow")]
mod arrow;
mod heads;
mod text;

use std::fmt;
use std::io::{self, Write};
use std::path::Path;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::error::SweepError;
use crate::record::{Batch, Failure};

pub(crate) use heads::Heads;

/// The format of tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Format {
    /// Text, every number with the digits that give back its bits.
    #[default]
    Csv,
    /// Arrow IPC files, with the feature `arrow`.
    Arrow,
}

impl Format {
    /// The extension of its files.
    ///
    /// ```
    /// assert_eq!(eem::sweep::Format::Csv.extension(), "csv");
    /// ```
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Arrow => "arrow",
        }
    }

    /// Whether this program can read and write it.
    pub(crate) const fn is_available(self) -> bool {
        match self {
            Self::Csv => true,
            Self::Arrow => cfg!(feature = "arrow"),
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.extension())
    }
}

/// Writes a table to a file.
pub(crate) enum Writer<W: Write> {
    Text(text::Writer<W>),
    #[cfg(feature = "arrow")]
    Arrow(Box<arrow::Writer<W>>),
}

/// The error of a format that this program was built without.
#[cfg(not(feature = "arrow"))]
fn no_arrow() -> io::Error {
    io::Error::new(
        io::ErrorKind::Unsupported,
        "the feature `arrow` is not there",
    )
}

impl<W: Write> Writer<W> {
    /// Writes the heads.
    pub(crate) fn new(format: Format, to: W, heads: &Heads) -> io::Result<Self> {
        match format {
            Format::Csv => Ok(Self::Text(text::Writer::new(to, heads)?)),
            #[cfg(feature = "arrow")]
            Format::Arrow => Ok(Self::Arrow(Box::new(arrow::Writer::new(to, heads)?))),
            #[cfg(not(feature = "arrow"))]
            Format::Arrow => Err(no_arrow()),
        }
    }

    /// Writes a row for each member.
    pub(crate) fn batch(&mut self, batch: &Batch) -> io::Result<()> {
        match self {
            Self::Text(writer) => writer.batch(batch),
            #[cfg(feature = "arrow")]
            Self::Arrow(writer) => writer.batch(batch),
        }
    }

    /// Writes the current row of a reader of the same format.
    pub(crate) fn copy(&mut self, reader: &Reader) -> io::Result<()> {
        match (self, reader) {
            (Self::Text(writer), Reader::Text(reader)) => writer.line(reader.line()),
            #[cfg(feature = "arrow")]
            (Self::Arrow(writer), Reader::Arrow(reader)) => writer.row(reader),
            #[cfg(feature = "arrow")]
            (Self::Text(_), Reader::Arrow(_)) | (Self::Arrow(_), Reader::Text(_)) => {
                Err(io::Error::other("a sweep has one format"))
            }
        }
    }

    /// Writes what is left, and ends the table.
    pub(crate) fn finish(self) -> io::Result<()> {
        match self {
            Self::Text(mut writer) => writer.finish(),
            #[cfg(feature = "arrow")]
            Self::Arrow(writer) => writer.finish(),
        }
    }
}

/// Reads a table row by row.
pub(crate) enum Reader {
    Text(text::Reader),
    #[cfg(feature = "arrow")]
    Arrow(Box<arrow::Reader>),
}

impl Reader {
    /// Reads a file whose bytes have been checked, and goes to the first row; the path is for messages.
    pub(crate) fn open(
        format: Format,
        path: &Path,
        bytes: Vec<u8>,
        heads: &Heads,
    ) -> Result<Self, SweepError> {
        match format {
            Format::Csv => Ok(Self::Text(text::Reader::open(path, bytes, heads)?)),
            #[cfg(feature = "arrow")]
            Format::Arrow => {
                let reader = arrow::Reader::open(path, bytes, heads)?;
                Ok(Self::Arrow(Box::new(reader)))
            }
            #[cfg(not(feature = "arrow"))]
            Format::Arrow => Err(SweepError::NoArrow),
        }
    }

    /// The id of the row; `None` after the last one.
    pub(crate) fn id(&self) -> Option<u64> {
        match self {
            Self::Text(reader) => reader.id(),
            #[cfg(feature = "arrow")]
            Self::Arrow(reader) => reader.id(),
        }
    }

    /// Whether the member of the row has failed.
    pub(crate) fn has_failed(&self) -> bool {
        match self {
            Self::Text(reader) => reader.has_failed(),
            #[cfg(feature = "arrow")]
            Self::Arrow(reader) => reader.has_failed(),
        }
    }

    /// Fills in the outputs of the row, or returns the failure.
    pub(crate) fn result(
        &self,
        heads: &Heads,
        outputs: &mut Vec<f64>,
    ) -> Result<Option<Failure>, SweepError> {
        outputs.clear();
        match self {
            Self::Text(reader) => reader.result(heads, outputs),
            #[cfg(feature = "arrow")]
            Self::Arrow(reader) => reader.result(heads, outputs),
        }
    }

    /// Whether two rows have the same bits.
    pub(crate) fn equals(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Text(one), Self::Text(other)) => one.line() == other.line(),
            #[cfg(feature = "arrow")]
            (Self::Arrow(one), Self::Arrow(other)) => one.equals(other),
            #[cfg(feature = "arrow")]
            (Self::Text(_), Self::Arrow(_)) | (Self::Arrow(_), Self::Text(_)) => false,
        }
    }

    /// Goes to the next row.
    pub(crate) fn advance(&mut self) -> Result<(), SweepError> {
        match self {
            Self::Text(reader) => reader.advance(),
            #[cfg(feature = "arrow")]
            Self::Arrow(reader) => reader.advance(),
        }
    }
}

//! One table of all members: proven complete, with the bits of a run on one machine.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::digest::{self, Digest};
use crate::error::SweepError;
use crate::files::{failed, publish, remove_temporaries, replace};
use crate::format::Writer;
use crate::part::Part;
use crate::places::Places;
use crate::status::named;
use crate::sweep::{Opened, Sweep};
use crate::walk::walk;

/// What was merged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Merged {
    /// The table.
    pub path: PathBuf,
    /// The digest of program, inputs and settings that all parts have.
    pub sweep: String,
    /// A digest of the table, which is the same for any number of processes.
    pub table: String,
    /// Members, each of which has one row.
    pub members: usize,
    /// Members that have failed.
    pub failed: usize,
    /// Records that a later run has superseded.
    pub superseded: usize,
    /// Records that were there more than once, with the same bits.
    pub repeated: usize,
}

impl Sweep<'_> {
    /// Merges all parts into one table, `into` or `merged.csv` in the directory, in ascending order of ids.
    ///
    /// It proves that every member has a record of a program, inputs and settings with one digest, takes the last
    /// record of each, and compares those that are there twice. Beside the table it writes what it has found,
    /// with `.json` added to the name. What killed processes have left behind is removed.
    ///
    /// # Errors
    ///
    /// [`SweepError::Incomplete`] if members are missing, [`SweepError::Conflict`] if a member has different bits
    /// in two parts, [`SweepError::Exists`] if the file exists and is none of this sweep, and others if files
    /// cannot be read or written. Nothing is written then.
    pub fn merge(&self, directory: &Path, into: Option<&Path>) -> Result<Merged, SweepError> {
        let opened = self.open(directory, None, false)?;
        let shelf = opened.shelf();
        let parts = shelf.parts()?;
        let members = self.inputs().members();
        let missing = Places::one(0..members).without(&shelf.reported(&parts)?);
        if missing.count() > 0 {
            return Err(SweepError::Incomplete {
                directory: directory.to_owned(),
                missing: missing.count(),
                members,
                which: named(&missing, self.inputs()),
            });
        }
        let default = || directory.join(format!("merged.{}", shelf.format));
        let path = into.map_or_else(default, Path::to_owned);
        let note = beside(&path);
        let earlier = earlier(&note)?;
        let mut merged = Merged {
            path: path.clone(),
            sweep: opened.manifest.digest.clone(),
            table: String::new(),
            members,
            failed: 0,
            superseded: 0,
            repeated: 0,
        };
        let is_new = attempt(&mut merged, |merged, problem| {
            publish(&path, |file| {
                write_table(&opened, &parts, file, merged, problem)
            })
        })?;
        if !is_new && digest::of_file(&path).map_err(failed("read", &path))? != merged.table {
            // The table that was merged before some members were run again.
            if earlier.is_none_or(|earlier| earlier.sweep != merged.sweep) {
                return Err(SweepError::Exists { path });
            }
            attempt(&mut merged, |merged, problem| {
                replace(&path, |file| {
                    write_table(&opened, &parts, file, merged, problem)
                })
            })?;
        }
        let text = serde_json::to_vec_pretty(&merged).unwrap_or_default();
        replace(&note, |file| file.write_all(&text))?;
        remove_temporaries(shelf.folder)?;
        Ok(merged)
    }
}

/// The file with what was found, beside the table.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".json");
    path.with_file_name(name)
}

/// What was found when the table was merged before; an error if the file is something else.
fn earlier(note: &Path) -> Result<Option<Merged>, SweepError> {
    let Ok(text) = fs::read(note) else {
        return Ok(None);
    };
    let path = note.to_owned();
    let read = serde_json::from_slice(&text);
    read.map(Some).map_err(|_| SweepError::Exists { path })
}

/// Calls `write` with a place for an error of this crate, which then goes before the error of the file.
fn attempt<T>(
    merged: &mut Merged,
    write: impl FnOnce(&mut Merged, &mut Option<SweepError>) -> Result<T, SweepError>,
) -> Result<T, SweepError> {
    let mut problem = None;
    let result = write(merged, &mut problem);
    match problem {
        Some(problem) => Err(problem),
        None => result,
    }
}

/// Writes all rows and fills in what was found.
fn write_table(
    opened: &Opened<'_>,
    parts: &[Part],
    file: &mut dyn Write,
    merged: &mut Merged,
    problem: &mut Option<SweepError>,
) -> io::Result<()> {
    let shelf = opened.shelf();
    let mut hashing = Hashing {
        to: file,
        digest: Digest::new(),
    };
    let mut table = Writer::new(shelf.format, &mut hashing, opened.heads())?;
    (merged.failed, merged.superseded, merged.repeated) = (0, 0, 0);
    let mut rows = 0;
    let mut file_error = None;
    let walked = walk(&shelf, parts, |record| {
        if record.place != rows || file_error.is_some() {
            return Ok(());
        }
        rows += 1;
        merged.failed += usize::from(record.reader.has_failed());
        merged.superseded += record.superseded;
        merged.repeated += record.repeated;
        file_error = table.copy(record.reader).err();
        Ok(())
    });
    if let Some(error) = file_error {
        return Err(error);
    }
    if let Err(error) = walked {
        *problem = Some(error);
        return Err(io::Error::other("the parts cannot be read"));
    }
    if rows != merged.members {
        return Err(io::Error::other(
            "the parts have changed while they were merged",
        ));
    }
    table.finish()?;
    merged.table = hashing.digest.hex();
    Ok(())
}

/// Forms the digest of what passes.
struct Hashing<'a> {
    to: &'a mut dyn Write,
    digest: Digest,
}

impl Write for Hashing<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.digest.bytes(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

//! One table of all members: proven complete, with the bits of a run on one machine.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::begun;
use crate::digest::{self, Digest};
use crate::error::SweepError;
use crate::files::{self, Draft, failed, folder_of, remove_dead};
use crate::format::Writer;
use crate::part::Part;
use crate::places::Places;
use crate::progress;
use crate::status::named;
use crate::sweep::{Opened, Sweep};
use crate::walk::walk;

/// The result of a merge.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Merged {
    /// The table. The note next to it does not contain its name, so both can be moved.
    #[serde(skip)]
    pub path: PathBuf,
    /// The digest of program, inputs and settings, common to all parts.
    pub sweep: String,
    /// A digest of the table; it is the same for any number of processes.
    pub table: String,
    /// Number of members, each with one row.
    pub members: usize,
    /// Number of failed members.
    pub failed: usize,
    /// Number of records replaced by a later run.
    pub superseded: usize,
    /// Number of records found more than once, with identical bits.
    pub repeated: usize,
}

impl Sweep<'_> {
    /// Merges all parts into one table, `into` or `merged.csv` in the directory, in ascending order of ids.
    ///
    /// It verifies that every member has a record with the same digest of program, inputs and settings, takes the
    /// latest record of each, and compares duplicates. A note with the findings is written next to the table, with
    /// `.json` added to the name. A read-only directory can be merged `into` another one, once. A merge can be
    /// killed and repeated at any time; it removes temporary files of killed processes once they are an hour old.
    ///
    /// # Errors
    ///
    /// [`SweepError::Incomplete`] if members are missing, [`SweepError::Conflict`] if a member has different
    /// records in two parts, [`SweepError::Damaged`] if a part was changed, [`SweepError::Exists`] if the file
    /// exists and does not belong to this sweep, and others if files cannot be read or written. Nothing is written
    /// then.
    pub fn merge(&self, directory: &Path, into: Option<&Path>) -> Result<Merged, SweepError> {
        let opened = self.open(directory, None, false)?;
        let shelf = opened.shelf();
        let default = || directory.join(format!("merged.{}", shelf.format));
        let path = into.map_or_else(default, Path::to_owned);
        let own = [
            shelf.folder.to_owned(),
            progress::folder(directory),
            Tables::of(directory).0,
        ];
        refuse_own(&path, &own)?;
        let note = beside(&path);
        // Most files in the way can be detected before the work.
        is_there(&path)?;
        refuse_other_note(&note)?;
        let parts = shelf.parts()?;
        self.refuse_gaps(directory, &shelf.reported(&parts)?)?;

        let mut draft = Draft::new(&path)?;
        let merged = write_table(&opened, &parts, &mut draft, &path)?;
        let tables = Tables::of(directory);
        let remembered = tables.remember(&merged.table);
        // A read-only sweep can be merged into a table elsewhere, but that table cannot be replaced later.
        if into.is_none() {
            remembered?;
        }
        if tables.refuse_others(&path)? || !draft.publish()? {
            // Another call may have put its table there in the meantime; a dangling link is not a table.
            if !tables.refuse_others(&path)? {
                return Err(SweepError::Exists { path });
            }
            draft.replace()?;
        }
        files::replace(&note, &files::json(&note, &merged)?)?;
        begun::forget(directory, &Places::one(0..self.inputs().members()));
        for folder in &own {
            remove_dead(folder);
        }
        remove_dead(directory);
        remove_dead(folder_of(&path));
        Ok(merged)
    }

    /// An error unless all members are reported.
    fn refuse_gaps(&self, directory: &Path, reported: &Places) -> Result<(), SweepError> {
        let members = self.inputs().members();
        let missing = Places::one(0..members).without(reported);
        if missing.count() == 0 {
            return Ok(());
        }
        Err(SweepError::Incomplete {
            directory: directory.to_owned(),
            missing: missing.count(),
            members,
            which: named(&missing, self.inputs()),
        })
    }
}

/// Refuses a table among the files of the sweep itself.
fn refuse_own(path: &Path, folders: &[PathBuf]) -> Result<(), SweepError> {
    let resolve = |folder: &Path| fs::canonicalize(folder).ok();
    let Some(place) = resolve(folder_of(path)) else {
        // It does not exist: the error comes when it is written to.
        return Ok(());
    };
    let owns = |folder: &&PathBuf| resolve(folder).is_some_and(|own| place.starts_with(own));
    match folders.iter().find(|folder| owns(folder)) {
        None => Ok(()),
        Some(folder) => Err(SweepError::OwnFolder {
            path: path.to_owned(),
            folder: folder.clone(),
        }),
    }
}

/// Whether there is a file of this name. Anything else than a regular file is refused: reading a pipe may never end.
fn is_there(path: &Path) -> Result<bool, SweepError> {
    match fs::metadata(path) {
        Ok(data) if data.is_file() => Ok(true),
        Ok(_) => Err(SweepError::NoFile {
            path: path.to_owned(),
        }),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(failed("read", path)(error)),
    }
}

/// The tables that have been merged from a directory: for each an empty file whose name is the digest. It is written
/// before its table, so that a kill never leaves an unknown table.
struct Tables(PathBuf);

impl Tables {
    fn of(directory: &Path) -> Self {
        Self(directory.join("tables"))
    }

    fn remember(&self, digest: &str) -> Result<(), SweepError> {
        files::directory(&self.0)?;
        files::replace(&self.0.join(digest), b"")
    }

    /// Whether there is a file of this name, which has to be one of the tables or empty.
    fn refuse_others(&self, path: &Path) -> Result<bool, SweepError> {
        if !is_there(path)? {
            return Ok(false);
        }
        let digest = digest::of_file(path).map_err(failed("read", path))?;
        if digest == Digest::new().hex() || self.0.join(digest).is_file() {
            return Ok(true);
        }
        Err(SweepError::Exists {
            path: path.to_owned(),
        })
    }
}

/// The file with the findings, next to the table.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".json");
    path.with_file_name(name)
}

/// Refuses a file of the note's name that is something else.
fn refuse_other_note(note: &Path) -> Result<(), SweepError> {
    let Some(text) = files::read(note)? else {
        return Ok(());
    };
    let read: Result<Merged, _> = serde_json::from_slice(&text);
    read.map(drop).map_err(|_| SweepError::Exists {
        path: note.to_owned(),
    })
}

/// Writes all rows and returns the findings; `path` is for messages.
fn write_table(
    opened: &Opened<'_>,
    parts: &[Part],
    file: &mut dyn Write,
    path: &Path,
) -> Result<Merged, SweepError> {
    let shelf = opened.shelf();
    let mut hashing = Hashing {
        to: file,
        digest: Digest::new(),
    };
    let writing = || failed("write", path);
    let mut merged = Merged {
        path: path.to_owned(),
        sweep: opened.manifest.digest.clone(),
        table: String::new(),
        members: 0,
        failed: 0,
        superseded: 0,
        repeated: 0,
    };
    let table = Writer::new(shelf.format, &mut hashing, opened.heads());
    let mut table = table.map_err(writing())?;
    walk(&shelf, parts, |record| {
        merged.members += 1;
        merged.failed += usize::from(record.reader.has_failed());
        merged.superseded += record.superseded;
        merged.repeated += record.repeated;
        table.copy(record.reader).map_err(writing())
    })?;
    table.finish().map_err(writing())?;
    merged.table = hashing.digest.hex();
    Ok(merged)
}

/// Passes bytes on, and forms their digest.
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

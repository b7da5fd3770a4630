//! One table of all members: proven complete, with the bits of a run on one machine.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::begun;
use crate::digest::{self, Digest};
use crate::error::SweepError;
use crate::files::{self, Draft, failed, remove_dead};
use crate::format::Writer;
use crate::part::Part;
use crate::places::Places;
use crate::progress;
use crate::status::named;
use crate::sweep::{Opened, Sweep};
use crate::walk::walk;

/// What was merged.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Merged {
    /// The table. The note beside it does not repeat its name, so that both can be moved.
    #[serde(skip)]
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

/// The file beside a table. It is written before the table gets its name, so that a table of this crate always has
/// a note that knows it.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Note {
    #[serde(flatten)]
    merged: Merged,
    /// The digests of all tables of this sweep that have been here.
    tables: Vec<String>,
}

impl Sweep<'_> {
    /// Merges all parts into one table, `into` or `merged.csv` in the directory, in ascending order of ids.
    ///
    /// It proves that every member has a record of a program, inputs and settings with one digest, takes the last
    /// record of each, and compares those that are there twice. Beside the table it writes what it has found,
    /// with `.json` added to the name. It can be killed and repeated at any time; temporary files that killed
    /// processes have left behind are removed when they are an hour old.
    ///
    /// # Errors
    ///
    /// [`SweepError::Incomplete`] if members are missing, [`SweepError::Conflict`] if a member has different bits
    /// in two parts, [`SweepError::Damaged`] if a part is not what was written, [`SweepError::Exists`] if the file
    /// exists and is none of this sweep, and others if files cannot be read or written. Nothing is written then.
    pub fn merge(&self, directory: &Path, into: Option<&Path>) -> Result<Merged, SweepError> {
        let opened = self.open(directory, None, false)?;
        let shelf = opened.shelf();
        let default = || directory.join(format!("merged.{}", shelf.format));
        let path = into.map_or_else(default, Path::to_owned);
        refuse_own(&path, &[shelf.folder, &progress::folder(directory)])?;
        // Some of what is in the way can be seen before the work.
        is_there(&path)?;
        own_tables(&opened, &path)?;
        let parts = shelf.parts()?;
        self.refuse_gaps(directory, &shelf.reported(&parts)?)?;

        let mut draft = Draft::new(&path)?;
        let merged = write_table(&opened, &parts, &mut draft, &path)?;
        let mut tables = own_tables(&opened, &path)?;
        if !tables.contains(&merged.table) {
            tables.push(merged.table.clone());
        }
        let exists = refuse_foreign(&path, &tables)?;
        let note = Note {
            merged: merged.clone(),
            tables,
        };
        let note_path = beside(&path);
        files::replace(&note_path, &files::json(&note_path, &note)?)?;
        if exists || !draft.publish()? {
            // Another call may have put its table there in the meantime.
            refuse_foreign(&path, &note.tables)?;
            draft.replace()?;
        }
        begun::forget(directory, &Places::one(0..self.inputs().members()));
        for folder in [shelf.folder, &progress::folder(directory), directory] {
            remove_dead(folder);
        }
        remove_dead(path.parent().unwrap_or(directory));
        Ok(merged)
    }

    /// All members must be there.
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
fn refuse_own(path: &Path, folders: &[&Path]) -> Result<(), SweepError> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let resolve = |folder: &Path| fs::canonicalize(folder).ok();
    let Some(place) = resolve(folder.unwrap_or(Path::new("."))) else {
        // It does not exist: the error comes when it is written to.
        return Ok(());
    };
    let owns = |folder: &&Path| resolve(folder).is_some_and(|own| place.starts_with(own));
    match folders.iter().find(|folder| owns(folder)) {
        None => Ok(()),
        Some(folder) => Err(SweepError::OwnFolder {
            path: path.to_owned(),
            folder: (*folder).to_owned(),
        }),
    }
}

/// Whether there is a file of this name; what is none is refused, as reading a pipe may never end.
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

/// Whether there is a table, which has to be one of these or empty.
fn refuse_foreign(path: &Path, tables: &[String]) -> Result<bool, SweepError> {
    if !is_there(path)? {
        return Ok(false);
    }
    let digest = digest::of_file(path).map_err(failed("read", path))?;
    if tables.contains(&digest) || digest == Digest::new().hex() {
        return Ok(true);
    }
    Err(SweepError::Exists {
        path: path.to_owned(),
    })
}

/// The digests of tables of this sweep that have been there.
fn own_tables(opened: &Opened<'_>, path: &Path) -> Result<Vec<String>, SweepError> {
    let earlier = earlier(&beside(path))?;
    let earlier = earlier.filter(|note| note.merged.sweep == opened.manifest.digest);
    Ok(earlier.map_or_else(Vec::new, |note| note.tables))
}

/// The file with what was found, beside the table.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".json");
    path.with_file_name(name)
}

/// What was found when the table was merged before; an error if the file is something else.
fn earlier(note: &Path) -> Result<Option<Note>, SweepError> {
    let Some(text) = files::read(note)? else {
        return Ok(None);
    };
    let path = note.to_owned();
    let read = serde_json::from_slice(&text);
    read.map(Some).map_err(|_| SweepError::Exists { path })
}

/// Writes all rows and says what was found; `path` is for messages.
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

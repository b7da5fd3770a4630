//! Files that are complete or absent, even if the process is killed or the disk is full.
//!
//! A file is written under a temporary name in the same directory, synced to disk, and only then given its name; the
//! directory is synced before the call returns. Temporary names begin with a dot and differ in every call of every
//! process on every machine, so that no process waits for another and there are no locks.

use std::fs::{self, File};
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::Duration;

use serde::Serialize;

use crate::error::SweepError;

/// How temporary names end.
const TEMPORARY: &str = ".tmp";

/// The process of a temporary file that has not been written to for this time is taken for dead.
const DEAD: Duration = Duration::from_hours(1);

/// Adds action and path to an error of the operating system, which names neither.
pub(crate) fn failed(
    action: &'static str,
    path: &Path,
) -> impl FnOnce(io::Error) -> SweepError + use<> {
    let path = path.to_owned();
    move |source| SweepError::File {
        action,
        path,
        source,
    }
}

/// Makes a directory and those above it.
pub(crate) fn directory(path: &Path) -> Result<(), SweepError> {
    fs::create_dir_all(path).map_err(failed("make the directory", path))
}

/// The directory that a file is in.
pub(crate) fn folder_of(path: &Path) -> &Path {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// All bytes of a regular file; `None` if it does not exist. Pipes and devices, which may never end, are refused.
pub(crate) fn read(path: &Path) -> Result<Option<Vec<u8>>, SweepError> {
    let bytes = fs::metadata(path).and_then(|data| {
        if data.is_file() {
            fs::read(path)
        } else {
            Err(io::Error::other("it is no regular file"))
        }
    });
    match bytes {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(failed("read", path)(error)),
    }
}

/// A file under a temporary name, which is removed unless it gets its own.
pub(crate) struct Draft {
    path: PathBuf,
    temporary: PathBuf,
    to: BufWriter<File>,
}

impl Draft {
    /// An empty file that may get the name `path`.
    pub(crate) fn new(path: &Path) -> Result<Self, SweepError> {
        let temporary = temporary_name(path);
        let file = File::create_new(&temporary).map_err(failed("write", path))?;
        Ok(Self {
            path: path.to_owned(),
            temporary,
            to: BufWriter::with_capacity(1 << 17, file),
        })
    }

    /// Gives the file its name unless that is taken; returns whether it did.
    pub(crate) fn publish(&mut self) -> Result<bool, SweepError> {
        self.named(|temporary, path| {
            let taken = match fs::hard_link(temporary, path) {
                // File systems without hard links: the name is taken by an empty file, which is then replaced.
                Err(error) if has_no_links(&error) => File::create_new(path).and_then(|_empty| {
                    fs::rename(temporary, path).inspect_err(|_| {
                        let _absent = fs::remove_file(path);
                    })
                }),
                linked => linked,
            };
            match taken {
                Ok(()) => Ok(true),
                Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(false),
                Err(error) => Err(error),
            }
        })
    }

    /// Gives the file its name, in the place of an older file if there is one.
    pub(crate) fn replace(&mut self) -> Result<(), SweepError> {
        self.named(|temporary, path| fs::rename(temporary, path))
    }

    fn named<T>(
        &mut self,
        name: impl FnOnce(&Path, &Path) -> io::Result<T>,
    ) -> Result<T, SweepError> {
        let attempt = || {
            self.to.flush()?;
            self.to.get_ref().sync_all()?;
            let named = name(&self.temporary, &self.path)?;
            sync_directory(folder_of(&self.path))?;
            Ok(named)
        };
        let result: io::Result<T> = attempt();
        result.map_err(failed("write", &self.path))
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.to.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // After a renaming it is gone.
        let _absent = fs::remove_file(&self.temporary);
    }
}

/// Writes a whole file, in the place of an older one if there is one.
pub(crate) fn replace(path: &Path, bytes: &[u8]) -> Result<(), SweepError> {
    let mut draft = Draft::new(path)?;
    draft.write_all(bytes).map_err(failed("write", path))?;
    draft.replace()
}

/// The same for a file that a kill or a full disk may destroy: it is not synced.
pub(crate) fn replace_without_sync(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let temporary = temporary_name(path);
    let written = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path));
    written.inspect_err(|_| {
        let _absent = fs::remove_file(&temporary);
    })
}

/// The contents of a file, as JSON of several lines; `path` is for an error.
pub(crate) fn json(path: &Path, said: &impl Serialize) -> Result<Vec<u8>, SweepError> {
    let text = serde_json::to_vec_pretty(said);
    let mut text = text.map_err(|error| failed("form", path)(error.into()))?;
    text.push(b'\n');
    Ok(text)
}

/// A name beside `path` that no other call of any process has.
fn temporary_name(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let chance = RandomState::new().build_hasher().finish();
    path.with_file_name(format!(
        ".{name}.{}-{chance:016x}{TEMPORARY}",
        process::id()
    ))
}

/// Whether a name is that of a temporary file of this crate.
fn is_temporary(name: &str) -> bool {
    let body = name
        .strip_prefix('.')
        .and_then(|n| n.strip_suffix(TEMPORARY));
    let chance = body.and_then(|body| body.rsplit_once('.')?.1.split_once('-'));
    chance.is_some_and(|(process, chance)| {
        process.parse::<u32>().is_ok()
            && chance.len() == 16
            && chance.bytes().all(|digit| digit.is_ascii_hexdigit())
    })
}

/// Removes temporary files of killed processes: those that are too old for a process to be still writing them.
pub(crate) fn remove_dead(folder: &Path) {
    // A file that cannot be removed does no harm.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let age = || entry.metadata().ok()?.modified().ok()?.elapsed().ok();
        if is_temporary(&entry.file_name().to_string_lossy()) && age().is_some_and(|age| age > DEAD)
        {
            let _gone = fs::remove_file(entry.path());
        }
    }
}

/// Syncs the names in a directory; only Unix can open directories.
fn sync_directory(folder: &Path) -> io::Result<()> {
    if cfg!(unix) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}

/// Whether a file system says that it has no hard links: EPERM by Linux, EOPNOTSUPP by others.
fn has_no_links(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::Unsupported | ErrorKind::PermissionDenied
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("eem-files-{name}-{}", process::id()));
        let _absent = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn draft(path: &Path, text: &str) -> Draft {
        let mut draft = Draft::new(path).unwrap();
        draft.write_all(text.as_bytes()).unwrap();
        draft
    }

    #[test]
    fn a_full_disk_leaves_nothing_behind_and_says_what_to_do() {
        let folder = folder("full");
        let path = folder.join("part");
        let full = |_: &Path, _: &Path| -> io::Result<()> { Err(ErrorKind::StorageFull.into()) };
        let error = draft(&path, "half of it").named(full).unwrap_err();
        assert_eq!(error.exit_code(), 5);
        assert!(error.to_string().contains("free space"), "{error}");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_name_is_taken_once() {
        let folder = folder("once");
        let path = folder.join("part");
        assert!(draft(&path, "first").publish().unwrap());
        assert!(!draft(&path, "second").publish().unwrap());
        assert_eq!(fs::read_to_string(&path).unwrap(), "first");
        replace(&path, b"third").unwrap();
        assert_eq!(read(&path).unwrap().unwrap(), b"third");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn temporaries_of_the_living_and_files_of_others_stay() {
        let folder = folder("dead");
        let path = folder.join("part");
        let (old, young) = (temporary_name(&path), temporary_name(&path));
        let others = [".notes.tmp", ".part.12-x.tmp", "part.tmp"].map(|name| folder.join(name));
        let hours = std::time::SystemTime::now() - 2 * DEAD;
        for path in others.iter().chain([&old, &young]) {
            fs::write(path, "torn").unwrap();
            if *path != young {
                let file = File::options().write(true).open(path).unwrap();
                file.set_modified(hours).unwrap();
            }
        }
        remove_dead(&folder);
        assert!(!old.exists() && young.exists());
        assert!(others.iter().all(|path| path.exists()));
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn what_is_no_file_is_not_read() {
        let folder = folder("device");
        let error = read(&folder).unwrap_err();
        assert!(error.to_string().contains("no regular file"), "{error}");
        assert!(read(&folder.join("absent")).unwrap().is_none());
        fs::remove_dir_all(&folder).unwrap();
    }
}

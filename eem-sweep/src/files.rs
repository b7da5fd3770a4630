//! Files that are there whole or not at all, whatever kills the process or fills the disk.
//!
//! A file is written under a temporary name beside its place, brought to disk, and only then given its name; the
//! directory is brought to disk before the call returns. Temporary names begin with a dot and are different in
//! every call of every process of every machine, so that nobody waits for anybody and nothing has to be unlocked.

use std::fs::{self, File};
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;

use crate::error::SweepError;

/// How temporary names end.
const TEMPORARY: &str = ".tmp";

/// Names an error of the operating system, which does not say what it is about.
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

/// Publishes a file under a name that nothing has yet; says whether it did, or the name was taken.
pub(crate) fn publish(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<bool, SweepError> {
    with_temporary(path, write, |temporary| {
        match fs::hard_link(temporary, path) {
            Ok(()) => {}
            Err(error) if error.kind() == ErrorKind::AlreadyExists => return Ok(false),
            // File systems without hard links. Between the two calls another process may take the name; what is
            // replaced then are the same records.
            Err(error) if has_no_links(&error) => {
                if path.try_exists()? {
                    return Ok(false);
                }
                fs::rename(temporary, path)?;
                return Ok(true);
            }
            Err(error) => return Err(error),
        }
        fs::remove_file(temporary)?;
        Ok(true)
    })
}

/// Publishes a file in the place of an older one.
pub(crate) fn replace(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), SweepError> {
    with_temporary(path, write, |temporary| fs::rename(temporary, path))
}

/// Writes a temporary file, gives it its name by `publish`, and removes it if that went wrong.
fn with_temporary<T>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    publish: impl FnOnce(&Path) -> io::Result<T>,
) -> Result<T, SweepError> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let temporary = temporary_name(path);
    let attempt = || {
        let mut file = BufWriter::with_capacity(1 << 17, File::create_new(&temporary)?);
        write(&mut file)?;
        file.into_inner()?.sync_all()?;
        let published = publish(&temporary)?;
        sync_directory(folder)?;
        Ok(published)
    };
    let result: io::Result<T> = attempt();
    // What was published has lost its temporary name already.
    let _absent = fs::remove_file(&temporary);
    result.map_err(failed("write", path))
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

/// Removes temporary files that killed processes have left; a process that still writes one fails and can be
/// started again.
pub(crate) fn remove_temporaries(folder: &Path) -> Result<(), SweepError> {
    let reading = || failed("read the directory", folder);
    for entry in fs::read_dir(folder).map_err(reading())? {
        let entry = entry.map_err(reading())?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with('.') && name.ends_with(TEMPORARY) {
            // Another `merge` may be removing it, too.
            let _gone = fs::remove_file(entry.path());
        }
    }
    Ok(())
}

/// Brings names to disk; only Unix has directories that can be opened.
fn sync_directory(folder: &Path) -> io::Result<()> {
    if cfg!(unix) {
        let folder = if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            folder
        };
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

    #[test]
    fn a_full_disk_leaves_nothing_behind_and_says_what_to_do() {
        let folder = folder("full");
        let path = folder.join("part");
        let full = |file: &mut dyn Write| {
            file.write_all(b"half of it")?;
            Err(io::Error::from(ErrorKind::StorageFull))
        };
        let error = publish(&path, full).unwrap_err();
        assert_eq!(error.exit_code(), 5);
        assert!(error.to_string().contains("free space"), "{error}");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_name_is_taken_once_and_temporaries_are_swept_away() {
        let folder = folder("once");
        let path = folder.join("part");
        let text = |text: &'static str| move |file: &mut dyn Write| file.write_all(text.as_bytes());
        assert!(publish(&path, text("first")).unwrap());
        assert!(!publish(&path, text("second")).unwrap());
        assert_eq!(fs::read_to_string(&path).unwrap(), "first");
        replace(&path, text("third")).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "third");
        fs::write(temporary_name(&path), "torn").unwrap();
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
        remove_temporaries(&folder).unwrap();
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }
}

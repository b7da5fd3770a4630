//! Checkpoints in files.
//!
//! ```text
//! eem checkpoint 1 f64
//! scheme: eem-entropy
//! …
//! digest: 5f6e…             of all lines before
//! ```

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::Checkpoint;
use super::error::{FormatError, KIND, LoadError, VERSION};
use super::text::{Fault, Text};
use eem_material::number::digest::Digest;

/// The beginning of the last line.
const DIGEST: &str = "digest: ";

/// The type of the numbers, as the first line names it.
const NUMBERS: &str = "f64";

impl Checkpoint {
    /// Writes the checkpoint to a file, from which [`load`](Self::load) restores every bit, in any program.
    ///
    /// The file is text, one named list of numbers per line, and ends with a digest. It is complete or absent: it is written
    /// under another name in the same folder, and then renamed. An existing file is replaced.
    ///
    /// # Errors
    ///
    /// The errors of the file system.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let build = || {
    ///     let mut scene = Scene::<1>::new();
    ///     scene.mass(1.0, [1.1], [0.3]);
    ///     Simulation::new(scene, Scheme::EemEntropy, 0.1)
    /// };
    /// let mut run = build()?;
    /// run.run_until(1.0)?;
    /// let path = std::env::temp_dir().join(format!("run-{}.checkpoint", std::process::id()));
    /// run.checkpoint().save(&path)?;
    ///
    /// let mut resumed = build()?;
    /// resumed.restore(&Checkpoint::load(&path)?)?;
    /// assert_eq!((resumed.time(), resumed.checkpoint()), (1.0, run.checkpoint()));
    /// # std::fs::remove_file(path)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn save(&self, path: impl AsRef<Path>) -> io::Result<()> {
        let path = path.as_ref();
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".{}.part", std::process::id()));
        let part = PathBuf::from(name);
        let written = write(&part, &self.to_text()).and_then(|()| fs::rename(&part, path));
        written.inspect_err(|_| {
            // An incomplete file is of no use.
            _ = fs::remove_file(&part);
        })
    }

    /// Reads a file that [`save`](Self::save) has written.
    ///
    /// # Errors
    ///
    /// [`LoadError`] if the file does not exist, is not a checkpoint, has another version or numbers in `f32`, is cut off or has
    /// been edited.
    ///
    /// ```
    /// use eem::{Checkpoint, LoadError};
    ///
    /// let found = Checkpoint::load("no such file");
    /// assert!(matches!(found, Err(LoadError::File { .. })));
    /// ```
    pub fn load(path: impl AsRef<Path>) -> Result<Self, LoadError> {
        let path = path.as_ref();
        let bytes = fs::read(path).map_err(|source| LoadError::File {
            path: path.to_owned(),
            source,
        })?;
        let text = String::from_utf8(bytes);
        let text = text.map_err(|_| FormatError::Kind);
        let found = text.and_then(|text| Self::from_text(&text));
        found.map_err(|source| LoadError::Format {
            path: path.to_owned(),
            source,
        })
    }

    /// The contents of a file.
    pub(super) fn to_text(&self) -> String {
        let mut text = Text::new("", 0);
        _ = Self::lines(&mut text, Some(self));
        let lines = text.written();
        let head = format!("{KIND} {VERSION} {NUMBERS}\n{lines}");
        let digest = digest(&head);
        format!("{head}{DIGEST}{digest}\n")
    }

    fn from_text(text: &str) -> Result<Self, FormatError> {
        let (head, _) = text.split_once('\n').ok_or(FormatError::Kind)?;
        let words = head.strip_prefix(KIND).ok_or(FormatError::Kind)?;
        let mut words = words.split_ascii_whitespace().map(str::to_owned);
        let (version, numbers) = (words.next(), words.next());
        if version.as_deref() != Some(VERSION) {
            let found = version.unwrap_or_default();
            return Err(FormatError::Version { found });
        }
        let body = text
            .strip_suffix('\n')
            .and_then(|text| text.rsplit_once('\n'));
        let (lines, last) = body.ok_or(FormatError::Digest)?;
        let lines = &text[..=lines.len()];
        if last.strip_prefix(DIGEST) != Some(&digest(lines).to_string()) {
            return Err(FormatError::Digest);
        }
        if numbers.as_deref() != Some(NUMBERS) {
            let found = numbers.unwrap_or_default();
            return Err(FormatError::Scalar { found });
        }
        let mut rest = Text::new(&lines[head.len() + 1..], 1);
        Self::lines(&mut rest, None)
            .map_err(|Fault { line, expected }| FormatError::Line { line, expected })
    }
}

/// The digest of a text.
fn digest(text: &str) -> Digest {
    Digest::of(|digest| digest.bytes(text.as_bytes()))
}

/// Writes a file to the disk.
fn write(path: &Path, text: &str) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()
}

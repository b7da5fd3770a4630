//! Checkpoints in files.
//!
//! ```text
//! eem checkpoint 1 f64
//! scheme: eem-entropy
//! …
//! digest: 5f6e…             of all lines before
//! ```
//!
//! Every line has a name and its items. Numbers are the shortest decimals that are read as the same number. Every function of the text
//! writes the value `own`, or reads it from the next line.

use core::fmt::{self, Display, Write as _};
use core::mem;
use core::str::{FromStr, Lines};
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use super::Checkpoint;
use super::error::{FormatError, KIND, LoadError, VERSION};
use eem_material::number::compensated::{Compensated, Sum};
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
        let write = || {
            let mut file = File::create(&part)?;
            file.write_all(self.to_text().as_bytes())?;
            file.sync_all()?;
            fs::rename(&part, path)
        };
        write().inspect_err(|_| {
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
        let mut text = Text::to_write();
        _ = self.clone().lines(&mut text);
        let lines = text.written;
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
        let mut rest = Text::to_read(&lines[head.len() + 1..], 1);
        let mut checkpoint = Self::blank();
        match checkpoint.lines(&mut rest) {
            Ok(()) => Ok(checkpoint),
            Err(Fault { line, expected }) => Err(FormatError::Line { line, expected }),
        }
    }
}

/// The digest of a text.
fn digest(text: &str) -> Digest {
    Digest::of(|digest| digest.bytes(text.as_bytes()))
}

/// The number, from 1, of a line that is not as expected, and the name that it should have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) line: usize,
    pub(super) expected: &'static str,
}

/// What a function of the text returns.
pub(super) type Read = Result<(), Fault>;

/// A text that is written or read.
pub(super) struct Text<'a> {
    written: String,
    /// `None` while the text is written.
    lines: Option<Lines<'a>>,
    /// The number of the last line.
    number: usize,
}

impl<'a> Text<'a> {
    /// A text to write.
    fn to_write() -> Self {
        Self {
            written: String::new(),
            lines: None,
            number: 0,
        }
    }

    /// A text to read: `rest` follows after `number` lines.
    fn to_read(rest: &'a str, number: usize) -> Self {
        Self {
            written: String::new(),
            lines: Some(rest.lines()),
            number,
        }
    }

    /// A line of items: so many are written, of which `show` writes one; or any number is read, of which `read` reads one.
    fn line(
        &mut self,
        name: &'static str,
        count: usize,
        show: &dyn Fn(usize, &mut String) -> fmt::Result,
        read: &mut dyn FnMut(&str) -> Option<()>,
    ) -> Read {
        self.number += 1;
        let fault = self.fault(name);
        let Some(lines) = &mut self.lines else {
            self.written.push_str(name);
            self.written.push(':');
            for index in 0..count {
                self.written.push(' ');
                // Writing to a string does not fail.
                _ = show(index, &mut self.written);
            }
            self.written.push('\n');
            return Ok(());
        };
        let line = lines.next().ok_or(fault)?;
        let items = line
            .strip_prefix(name)
            .and_then(|rest| rest.strip_prefix(':'));
        for item in items.ok_or(fault)?.split_ascii_whitespace() {
            read(item).ok_or(fault)?;
        }
        Ok(())
    }

    /// A list of numbers.
    pub(super) fn numbers(&mut self, name: &'static str, own: &mut Vec<f64>) -> Read {
        let numbers = mem::take(own);
        let show = |at: usize, text: &mut String| write!(text, "{:?}", numbers[at]);
        self.line(name, numbers.len(), &show, &mut |item| {
            own.push(item.parse().ok()?);
            Some(())
        })?;
        if self.lines.is_none() {
            *own = numbers;
        }
        Ok(())
    }

    /// Given numbers.
    pub(super) fn array(&mut self, name: &'static str, own: &mut [&mut f64]) -> Read {
        let mut numbers = Vec::with_capacity(own.len());
        for number in &*own {
            numbers.push(**number);
        }
        self.numbers(name, &mut numbers)?;
        if numbers.len() != own.len() {
            return Err(self.fault(name));
        }
        for (own, number) in own.iter_mut().zip(numbers) {
            **own = number;
        }
        Ok(())
    }

    /// One number.
    pub(super) fn number(&mut self, name: &'static str, own: &mut f64) -> Read {
        self.array(name, &mut [own])
    }

    /// One number or none.
    pub(super) fn maybe(&mut self, name: &'static str, own: &mut Option<f64>) -> Read {
        let mut numbers = own.map(|own| [own]);
        self.few(name, &mut numbers)?;
        *own = numbers.map(|[number]| number);
        Ok(())
    }

    /// N numbers or none.
    pub(super) fn few<const N: usize>(
        &mut self,
        name: &'static str,
        own: &mut Option<[f64; N]>,
    ) -> Read {
        let mut numbers = own.as_slice().as_flattened().to_vec();
        self.numbers(name, &mut numbers)?;
        *own = None;
        if !numbers.is_empty() {
            let numbers = <[f64; N]>::try_from(numbers);
            *own = Some(numbers.map_err(|_| self.fault(name))?);
        }
        Ok(())
    }

    /// Items without blanks: counts, words, digests.
    pub(super) fn items<T: Display + FromStr>(
        &mut self,
        name: &'static str,
        own: &mut Vec<T>,
    ) -> Read {
        let items = mem::take(own);
        let show = |at: usize, text: &mut String| write!(text, "{}", items[at]);
        self.line(name, items.len(), &show, &mut |item| {
            own.push(item.parse().ok()?);
            Some(())
        })?;
        if self.lines.is_none() {
            *own = items;
        }
        Ok(())
    }

    /// One such item.
    pub(super) fn item<T: Display + FromStr>(&mut self, name: &'static str, own: &mut T) -> Read {
        let mut found = None;
        self.word(name, own, &mut |item| {
            found = Some(item.parse().ok()?);
            Some(())
        })?;
        if let Some(found) = found {
            *own = found;
        }
        Ok(())
    }

    /// The same, given what reads it.
    fn word(
        &mut self,
        name: &'static str,
        own: &dyn Display,
        read: &mut dyn FnMut(&str) -> Option<()>,
    ) -> Read {
        let mut count = 0;
        let show = |_: usize, text: &mut String| write!(text, "{own}");
        self.line(name, 1, &show, &mut |item| {
            count += 1;
            read(item)
        })?;
        if self.lines.is_some() && count != 1 {
            return Err(self.fault(name));
        }
        Ok(())
    }

    /// A part that may be absent; it is read over a blank one.
    pub(super) fn part<T>(
        &mut self,
        name: &'static str,
        own: &mut Option<T>,
        blank: T,
        pass: fn(&mut Self, &mut T) -> Read,
    ) -> Read {
        let mut is_there = own.is_some();
        self.item(name, &mut is_there)?;
        if is_there {
            return pass(self, own.get_or_insert(blank));
        }
        *own = None;
        Ok(())
    }

    /// A sum and its compensation.
    pub(super) fn sum(&mut self, name: &'static str, own: &mut Sum) -> Read {
        self.array(name, &mut [&mut own.value, &mut own.carry])
    }

    /// Sums, and their compensations in the next line.
    pub(super) fn sums(&mut self, names: [&'static str; 2], own: &mut Compensated) -> Read {
        let mut values = own.values().to_vec();
        let mut carries = own.sums().map(|(_, carry)| carry).collect();
        self.numbers(names[0], &mut values)?;
        self.numbers(names[1], &mut carries)?;
        *own = Compensated::of(values, carries).ok_or_else(|| self.fault(names[1]))?;
        Ok(())
    }

    /// Pairs of a value and its compensation.
    pub(super) fn pairs(&mut self, name: &'static str, own: &mut Vec<Sum>) -> Read {
        let mut numbers = flat(own);
        self.numbers(name, &mut numbers)?;
        let (pairs, []) = numbers.as_chunks() else {
            return Err(self.fault(name));
        };
        own.clear();
        for &[value, carry] in pairs {
            own.push(Sum { value, carry });
        }
        Ok(())
    }

    /// The fault that the last line is not as expected.
    pub(super) const fn fault(&self, expected: &'static str) -> Fault {
        let line = self.number;
        Fault { line, expected }
    }
}

/// The values of sums, each with its compensation behind it.
pub(super) fn flat(sums: &[Sum]) -> Vec<f64> {
    let mut numbers = Vec::with_capacity(2 * sums.len());
    for sum in sums {
        numbers.extend([sum.value, sum.carry]);
    }
    numbers
}

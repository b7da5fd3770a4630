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
//! writes the value `own` and returns it; if `own` is `None`, it reads the value from the next line.

use core::fmt::{Display, Write as _};
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

/// The number, from 1, of a line that is not as expected, and the name that it should have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) line: usize,
    pub(super) expected: &'static str,
}

/// What a function of the text returns.
pub(super) type Read<T> = Result<T, Fault>;

/// A text that is written or read.
pub(super) struct Text<'a> {
    written: String,
    lines: Lines<'a>,
    /// The number of the last line.
    number: usize,
}

impl<'a> Text<'a> {
    /// A text to write, or to read: `rest` follows after `number` lines.
    pub(super) fn new(rest: &'a str, number: usize) -> Self {
        Self {
            written: String::new(),
            lines: rest.lines(),
            number,
        }
    }

    /// All that has been written.
    pub(super) fn written(self) -> String {
        self.written
    }

    /// A line of so many items, of which `show` writes one, or of any number, of which `read` reads one.
    fn line(
        &mut self,
        name: &'static str,
        count: Option<usize>,
        show: &dyn Fn(usize, &mut String),
        read: &mut dyn FnMut(&str) -> Option<()>,
    ) -> Read<()> {
        self.number += 1;
        if let Some(count) = count {
            self.written.push_str(name);
            self.written.push(':');
            for index in 0..count {
                self.written.push(' ');
                show(index, &mut self.written);
            }
            self.written.push('\n');
            return Ok(());
        }
        let fault = self.fault(name);
        let line = self.lines.next().ok_or(fault)?;
        let items = line
            .strip_prefix(name)
            .and_then(|rest| rest.strip_prefix(':'));
        for item in items.ok_or(fault)?.split_ascii_whitespace() {
            read(item).ok_or(fault)?;
        }
        Ok(())
    }

    /// A line of items, written as `show` does.
    fn list<T: FromStr + Clone>(
        &mut self,
        name: &'static str,
        own: Option<&[T]>,
        show: fn(&T, &mut String),
    ) -> Read<Vec<T>> {
        let mut items = own.unwrap_or_default().to_vec();
        let mut found = Vec::new();
        let count = own.map(<[T]>::len);
        self.line(
            name,
            count,
            &|at, text| show(&items[at], text),
            &mut |item| {
                found.push(item.parse().ok()?);
                Some(())
            },
        )?;
        items.append(&mut found);
        Ok(items)
    }

    /// A list of numbers.
    pub(super) fn numbers(&mut self, name: &'static str, own: Option<&[f64]>) -> Read<Vec<f64>> {
        // Writing to a string does not fail.
        self.list(name, own, |number, text| _ = write!(text, "{number:?}"))
    }

    /// N numbers.
    pub(super) fn array<const N: usize>(
        &mut self,
        name: &'static str,
        own: Option<[f64; N]>,
    ) -> Read<[f64; N]> {
        let numbers = self.numbers(name, own.as_ref().map(|own| &own[..]))?;
        numbers.try_into().map_err(|_| self.fault(name))
    }

    /// One number.
    pub(super) fn number(&mut self, name: &'static str, own: Option<f64>) -> Read<f64> {
        let [number] = self.array(name, own.map(|own| [own]))?;
        Ok(number)
    }

    /// N numbers or none.
    pub(super) fn few<const N: usize>(
        &mut self,
        name: &'static str,
        own: Option<&Option<[f64; N]>>,
    ) -> Read<Option<[f64; N]>> {
        let own = own.map(|own| own.as_ref().map_or(&[][..], |own| &own[..]));
        let numbers = self.numbers(name, own)?;
        if numbers.is_empty() {
            return Ok(None);
        }
        numbers.try_into().map(Some).map_err(|_| self.fault(name))
    }

    /// Items without blanks: counts, words, digests.
    pub(super) fn items<T: Display + FromStr + Clone>(
        &mut self,
        name: &'static str,
        own: Option<&[T]>,
    ) -> Read<Vec<T>> {
        self.list(name, own, |item, text| _ = write!(text, "{item}"))
    }

    /// One such item.
    pub(super) fn item<T: Display + FromStr + Clone>(
        &mut self,
        name: &'static str,
        own: Option<T>,
    ) -> Read<T> {
        let own = own.map(|own| [own]);
        let items = self.items(name, own.as_ref().map(|own| &own[..]))?;
        let items: Result<[T; 1], _> = items.try_into();
        items.map(|[item]| item).map_err(|_| self.fault(name))
    }

    /// A part that may be absent.
    pub(super) fn part<T>(
        &mut self,
        name: &'static str,
        own: Option<&Option<T>>,
        pass: impl FnOnce(&mut Self, Option<&T>) -> Read<T>,
    ) -> Read<Option<T>> {
        let is_there = self.item(name, own.map(Option::is_some))?;
        let own = own.and_then(Option::as_ref);
        is_there.then(|| pass(self, own)).transpose()
    }

    /// A sum and its compensation.
    pub(super) fn sum(&mut self, name: &'static str, own: Option<Sum>) -> Read<Sum> {
        let [value, carry] = self.array(name, own.map(|own| [own.value, own.carry]))?;
        Ok(Sum { value, carry })
    }

    /// Sums, and their compensations in the next line.
    pub(super) fn sums(
        &mut self,
        names: [&'static str; 2],
        own: Option<&Compensated>,
    ) -> Read<Compensated> {
        let carries: Option<Vec<f64>> = own.map(|own| own.sums().map(|(_, carry)| carry).collect());
        let values = self.numbers(names[0], own.map(Compensated::values))?;
        let carries = self.numbers(names[1], carries.as_deref())?;
        Compensated::of(values, carries).ok_or_else(|| self.fault(names[1]))
    }

    /// Pairs of a value and its compensation.
    pub(super) fn pairs(&mut self, name: &'static str, own: Option<&[Sum]>) -> Read<Vec<Sum>> {
        let numbers = self.numbers(name, own.map(flat).as_deref())?;
        let (pairs, []) = numbers.as_chunks::<2>() else {
            return Err(self.fault(name));
        };
        let pairs = pairs.iter();
        Ok(pairs.map(|&[value, carry]| Sum { value, carry }).collect())
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

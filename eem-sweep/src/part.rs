//! Parts: the files with records that processes have reported, and the information in their names.

use std::fs;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::digest::Digest;
use crate::error::SweepError;
use crate::files::{self, failed};
use crate::format::{Format, Heads, Reader};
use crate::inputs::Inputs;
use crate::places::Places;

/// The folder of parts in the directory of a sweep.
pub(crate) const PARTS: &str = "parts";

/// Hexadecimal digits of the digests that a name has.
const DIGITS: usize = 16;

/// A file with records of some members.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    pub(crate) path: PathBuf,
    /// From the first member's place to that after the last.
    pub(crate) span: Range<usize>,
    /// Members in it; less than the span if there are gaps.
    pub(crate) members: usize,
    /// 0 for members that are given up, 1 for the first run of a member, more for the runs that supersede it.
    pub(crate) generation: u32,
    /// The digest of its contents and of all else that its name says.
    content: String,
}

/// What parts have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shelf<'a> {
    pub(crate) folder: &'a Path,
    pub(crate) digest: &'a str,
    pub(crate) format: Format,
    pub(crate) heads: &'a Heads,
    pub(crate) inputs: &'a Inputs,
}

/// An error if a folder has parts of another sweep than that of a digest.
pub(crate) fn refuse_foreign(folder: &Path, digest: &str) -> Result<(), SweepError> {
    let reading = || failed("read the directory", folder);
    for entry in fs::read_dir(folder).map_err(reading())? {
        let path = entry.map_err(reading())?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if let Some(name) = Name::read(&name) {
            name.refuse_foreign(&path, digest)?;
        }
    }
    Ok(())
}

impl Shelf<'_> {
    /// Reports the records of some members. The name has a digest of the contents, so that a file of the same name
    /// is one with the same bytes, and may be replaced.
    pub(crate) fn report(
        &self,
        span: Range<usize>,
        members: usize,
        generation: u32,
        bytes: &[u8],
    ) -> Result<(), SweepError> {
        let content = self.content(&span, members, generation, bytes);
        let Range { start, end } = span;
        let last = end.saturating_sub(1);
        let (sweep, extension) = (&self.digest[..DIGITS], self.format.extension());
        let name =
            format!("{start:010}-{last:010}.{members}.g{generation}.{sweep}.{content}.{extension}");
        files::replace(&self.folder.join(name), bytes)
    }

    /// The digest of a part.
    fn content(
        &self,
        span: &Range<usize>,
        members: usize,
        generation: u32,
        bytes: &[u8],
    ) -> String {
        let mut digest = Digest::new();
        digest.text(self.digest);
        for number in [span.start, span.end, members, generation as usize] {
            digest.whole(number as u64);
        }
        digest.bytes(bytes);
        digest.hex()[..DIGITS].to_owned()
    }

    /// All parts, ordered by their first members; other files are left alone unless they are parts of another
    /// sweep.
    pub(crate) fn parts(&self) -> Result<Vec<Part>, SweepError> {
        let reading = || failed("read the directory", self.folder);
        let mut parts = Vec::new();
        for entry in fs::read_dir(self.folder).map_err(reading())? {
            let path = entry.map_err(reading())?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if let Some(part) = self.part(&name, &path)? {
                parts.push(part);
            }
        }
        parts.sort_by(|a, b| (a.span.start, &a.path).cmp(&(b.span.start, &b.path)));
        Ok(parts)
    }

    fn part(&self, name: &str, path: &Path) -> Result<Option<Part>, SweepError> {
        let Some(name) = Name::read(name) else {
            return Ok(None);
        };
        name.refuse_foreign(path, self.digest)?;
        if name.extension != self.format.extension() {
            return Err(SweepError::Damaged {
                path: path.to_owned(),
                reason: format!("its name does not end in `{}`", self.format),
            });
        }
        let (span, members) = (name.span, name.members);
        if span.end > self.inputs.members() || members == 0 || members > span.len() {
            return Err(SweepError::Damaged {
                path: path.to_owned(),
                reason: "its name says what cannot be".to_owned(),
            });
        }
        Ok(Some(Part {
            path: path.to_owned(),
            span,
            members,
            generation: name.generation,
            content: name.content.to_owned(),
        }))
    }

    /// The members that some part has; of parts without gaps the names are enough.
    pub(crate) fn reported(&self, parts: &[Part]) -> Result<Places, SweepError> {
        let mut ranges = Vec::new();
        for part in parts {
            if part.members == part.span.len() {
                ranges.push(part.span.clone());
                continue;
            }
            let mut rows = self.open(part)?;
            while let Some(id) = rows.id() {
                let place = self.inputs.place(id);
                ranges.push(place..place + 1);
                rows.advance()?;
            }
        }
        Ok(Places::new(ranges))
    }

    /// The rows of a part, which is read as a whole, and refused if a byte has changed.
    pub(crate) fn open(&self, part: &Part) -> Result<Reader, SweepError> {
        let bytes = files::read(&part.path)?;
        let damaged = |reason: &str| SweepError::Damaged {
            path: part.path.clone(),
            reason: reason.to_owned(),
        };
        let gone = || failed("read", &part.path)(ErrorKind::NotFound.into());
        let bytes = bytes.ok_or_else(gone)?;
        if self.content(&part.span, part.members, part.generation, &bytes) != part.content {
            return Err(damaged("its contents are not those that its name says"));
        }
        Reader::open(self.format, &part.path, bytes, self.heads)
    }
}

/// What the name of a part says.
struct Name<'n> {
    span: Range<usize>,
    members: usize,
    generation: u32,
    sweep: &'n str,
    content: &'n str,
    extension: &'n str,
}

impl<'n> Name<'n> {
    /// `None` if it is the name of something else.
    fn read(name: &'n str) -> Option<Self> {
        let mut pieces = name.split('.');
        let (first, last) = pieces.next()?.split_once('-')?;
        let members = pieces.next()?.parse().ok()?;
        let generation = pieces.next()?.strip_prefix('g')?.parse().ok()?;
        let (sweep, content) = (pieces.next()?, pieces.next()?);
        let extension = pieces.next()?;
        let end = last.parse::<usize>().ok()?.checked_add(1)?;
        let is_whole = pieces.next().is_none() && sweep.len() == DIGITS && content.len() == DIGITS;
        is_whole.then_some(Self {
            span: first.parse().ok()?..end,
            members,
            generation,
            sweep,
            content,
            extension,
        })
    }

    /// An error unless it is a part of the sweep with this digest.
    fn refuse_foreign(&self, path: &Path, digest: &str) -> Result<(), SweepError> {
        if *self.sweep == digest[..DIGITS] {
            return Ok(());
        }
        Err(SweepError::ForeignPart {
            path: path.to_owned(),
            found: self.sweep.to_owned(),
            expected: digest[..DIGITS].to_owned(),
        })
    }
}

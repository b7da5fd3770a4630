//! Parts: the files with records that processes have reported, and what their names say.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::error::SweepError;
use crate::files::failed;
use crate::format::{Format, Heads, Reader};
use crate::inputs::Inputs;
use crate::places::Places;

/// Hexadecimal digits of the digest that a name has.
const DIGITS: usize = 16;

/// A file with records of some members.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    pub(crate) path: PathBuf,
    /// From the first member's place to that after the last.
    pub(crate) span: Range<usize>,
    /// Members in it; less than the span if there are gaps.
    pub(crate) members: usize,
    /// 0 for the first run of a member, more for the runs that supersede it.
    pub(crate) generation: u32,
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

impl Shelf<'_> {
    /// The path of a part: `FIRST-LAST.MEMBERS.gGENERATION.DIGEST.csv`.
    pub(crate) fn path(&self, span: &Range<usize>, members: usize, generation: u32) -> PathBuf {
        let Range { start, end } = *span;
        let last = end.saturating_sub(1);
        let (digest, extension) = (&self.digest[..DIGITS], self.format.extension());
        let name = format!("{start:010}-{last:010}.{members}.g{generation}.{digest}.{extension}");
        self.folder.join(name)
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
        let Some((span, members, generation, digest, extension)) = read_name(name) else {
            return Ok(None);
        };
        if *digest != self.digest[..DIGITS] || extension != self.format.extension() {
            return Err(SweepError::ForeignPart {
                path: path.to_owned(),
                found: digest.to_owned(),
                expected: self.digest[..DIGITS].to_owned(),
            });
        }
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
            generation,
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

    /// The rows of a part.
    pub(crate) fn open(&self, part: &Part) -> Result<Reader, SweepError> {
        Reader::open(self.format, &part.path, self.heads)
    }
}

/// Span, members, generation, digest and format in the name of a part.
fn read_name(name: &str) -> Option<(Range<usize>, usize, u32, &str, &str)> {
    let mut pieces = name.split('.');
    let (first, last) = pieces.next()?.split_once('-')?;
    let members = pieces.next()?.parse().ok()?;
    let generation = pieces.next()?.strip_prefix('g')?.parse().ok()?;
    let (digest, extension) = (pieces.next()?, pieces.next()?);
    let end = last.parse::<usize>().ok()?.checked_add(1)?;
    let is_whole = pieces.next().is_none() && digest.len() == DIGITS;
    is_whole.then_some((
        first.parse().ok()?..end,
        members,
        generation,
        digest,
        extension,
    ))
}

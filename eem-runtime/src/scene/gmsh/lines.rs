//! The lines of a file, read one after the other, with their numbers.

use std::str::FromStr;

use super::error::{LineFault, MshError};

/// The lines of a file, of which those up to one have been read.
pub(super) struct Lines<'a> {
    all: Vec<&'a str>,
    /// The next line, from 0.
    at: usize,
}

/// A section that is being read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Section<'a> {
    pub(super) name: &'a str,
    /// The line with its name, from 1.
    pub(super) line: usize,
}

/// A line that has been read, with its number, from 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    pub(super) number: usize,
    pub(super) text: &'a str,
}

impl<'a> Lines<'a> {
    /// All lines; a mark of the order of bytes before the first is none of it.
    pub(super) fn of(text: &'a str) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Self {
            all: text.lines().map(str::trim).collect(),
            at: 0,
        }
    }

    /// The next line that is not empty.
    fn next(&mut self) -> Option<Line<'a>> {
        while let Some(&text) = self.all.get(self.at) {
            self.at += 1;
            if !text.is_empty() {
                let number = self.at;
                return Some(Line { number, text });
            }
        }
        None
    }

    /// The head of the next section.
    pub(super) fn section(&mut self) -> Result<Option<Section<'a>>, MshError> {
        let Some(Line { number, text }) = self.next() else {
            return Ok(None);
        };
        match text.strip_prefix('$') {
            Some(name) => Ok(Some(Section { name, line: number })),
            None => Err(MshError::Outside {
                line: number,
                found: text.to_owned(),
            }),
        }
    }

    /// The next line of a section.
    pub(super) fn line(&mut self, section: Section<'_>) -> Result<Line<'a>, MshError> {
        self.next().ok_or_else(|| section.unended())
    }

    /// The next line of a section, of numbers, as many as `wanted` says.
    pub(super) fn numbers<T: FromStr>(
        &mut self,
        section: Section<'_>,
        wanted: impl Fn(usize) -> bool,
    ) -> Result<(Line<'a>, Vec<T>), MshError> {
        let line = self.line(section)?;
        let words = line.text.split_ascii_whitespace().map(str::parse);
        let numbers: Result<Vec<T>, T::Err> = words.collect();
        match numbers {
            Ok(numbers) if wanted(numbers.len()) => Ok((line, numbers)),
            _ => Err(line.wrong(section, LineFault::Numbers)),
        }
    }

    /// The next line of a section, of four integers that are not negative but for the second.
    pub(super) fn head(
        &mut self,
        section: Section<'_>,
    ) -> Result<(Line<'a>, [u64; 4], i32), MshError> {
        let (line, numbers) = self.numbers::<i128>(section, |count| count == 4)?;
        let wrong = || line.wrong(section, LineFault::Numbers);
        let mut all = [0; 4];
        for (at, (to, &from)) in all.iter_mut().zip(&numbers).enumerate() {
            if at != 1 {
                *to = u64::try_from(from).map_err(|_| wrong())?;
            }
        }
        let entity = i32::try_from(numbers[1]).map_err(|_| wrong())?;
        Ok((line, all, entity))
    }

    /// The end of a section.
    pub(super) fn end(&mut self, section: Section<'_>) -> Result<(), MshError> {
        let line = self.line(section)?;
        if section.is_ended_by(line.text) {
            return Ok(());
        }
        Err(line.wrong(section, LineFault::NotTheEnd))
    }

    /// Passes over the rest of a section.
    pub(super) fn skip(&mut self, section: Section<'_>) -> Result<(), MshError> {
        loop {
            let line = self.line(section)?;
            if section.is_ended_by(line.text) {
                return Ok(());
            }
        }
    }
}

impl Section<'_> {
    fn is_ended_by(self, line: &str) -> bool {
        line.strip_prefix("$End") == Some(self.name)
    }

    fn unended(self) -> MshError {
        MshError::Unended {
            section: self.name.to_owned(),
            line: self.line,
        }
    }
}

impl Line<'_> {
    /// What is in the line is not what has to be there.
    pub(super) fn wrong(self, section: Section<'_>, fault: LineFault) -> MshError {
        MshError::Line {
            section: section.name.to_owned(),
            line: self.number,
            found: self.text.to_owned(),
            fault,
        }
    }
}

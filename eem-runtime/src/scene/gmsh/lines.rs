//! The lines of a file, read one after the other, with their numbers and sections.

use std::str::FromStr;

use super::error::{LineFault, MshError};

/// The lines of a file, from the next one to be read.
pub(super) struct Lines<'a> {
    all: Vec<&'a str>,
    /// The index of the next line.
    next: usize,
    /// The present section.
    pub(super) section: Section<'a>,
}

/// A section of a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Section<'a> {
    pub(super) name: &'a str,
    /// The number of the line with its name, from 1.
    pub(super) line: usize,
}

/// A line of a section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    section: Section<'a>,
    /// Its number, from 1.
    pub(super) number: usize,
    pub(super) text: &'a str,
}

impl<'a> Lines<'a> {
    /// All lines, without a byte order mark.
    pub(super) fn of(text: &'a str) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Self {
            all: text.lines().map(str::trim).collect(),
            next: 0,
            section: Section { name: "", line: 0 },
        }
    }

    /// The next line that is not empty.
    fn next(&mut self) -> Option<Line<'a>> {
        let index = self.next
            + self.all[self.next..]
                .iter()
                .position(|text| !text.is_empty())?;
        self.next = index + 1;
        Some(Line {
            section: self.section,
            number: self.next,
            text: self.all[index],
        })
    }

    /// Begins the next section; false at the end of the file.
    pub(super) fn begin_section(&mut self) -> Result<bool, MshError> {
        let Some(Line { number, text, .. }) = self.next() else {
            return Ok(false);
        };
        match text.strip_prefix('$') {
            Some(name) => {
                self.section = Section { name, line: number };
                Ok(true)
            }
            None => Err(MshError::Outside {
                line: number,
                found: text.to_owned(),
            }),
        }
    }

    /// The next line of the section.
    pub(super) fn line(&mut self) -> Result<Line<'a>, MshError> {
        let Section { name, line } = self.section;
        self.next().ok_or_else(|| MshError::Unended {
            section: name.to_owned(),
            line,
        })
    }

    /// The next line, of as many numbers as `is_count` allows.
    pub(super) fn numbers<T: FromStr>(
        &mut self,
        is_count: impl Fn(usize) -> bool,
    ) -> Result<(Line<'a>, Vec<T>), MshError> {
        let line = self.line()?;
        let words = line.text.split_ascii_whitespace().map(str::parse);
        let numbers: Result<Vec<T>, T::Err> = words.collect();
        match numbers {
            Ok(numbers) if is_count(numbers.len()) => Ok((line, numbers)),
            _ => Err(line.wrong(LineFault::Numbers)),
        }
    }

    /// The next line, of four integers, of which only the second may be negative.
    pub(super) fn head(&mut self) -> Result<(Line<'a>, [u64; 4], i32), MshError> {
        let (line, numbers) = self.numbers::<i128>(|count| count == 4)?;
        let wrong = || line.wrong(LineFault::Numbers);
        let mut all = [0; 4];
        for (at, (to, &from)) in all.iter_mut().zip(&numbers).enumerate() {
            if at != 1 {
                *to = u64::try_from(from).map_err(|_| wrong())?;
            }
        }
        let entity = i32::try_from(numbers[1]).map_err(|_| wrong())?;
        Ok((line, all, entity))
    }

    /// Reads the end of the section.
    pub(super) fn end(&mut self) -> Result<(), MshError> {
        let line = self.line()?;
        if line.is_end() {
            return Ok(());
        }
        Err(line.wrong(LineFault::NotTheEnd))
    }

    /// Skips the rest of the section.
    pub(super) fn skip(&mut self) -> Result<(), MshError> {
        while !self.line()?.is_end() {}
        Ok(())
    }
}

impl Line<'_> {
    fn is_end(self) -> bool {
        self.text.strip_prefix("$End") == Some(self.section.name)
    }

    /// The error of the line.
    pub(super) fn wrong(self, fault: LineFault) -> MshError {
        MshError::Line {
            section: self.section.name.to_owned(),
            line: self.number,
            found: self.text.to_owned(),
            fault,
        }
    }
}

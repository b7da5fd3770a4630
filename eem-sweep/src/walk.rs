//! All records of a sweep in the order of their members, each once, whatever the parts they are in.

use crate::error::SweepError;
use crate::format::Reader;
use crate::part::{Part, Shelf};

/// The record of a member that counts.
pub(crate) struct Found<'r> {
    pub(crate) place: usize,
    pub(crate) reader: &'r Reader,
    pub(crate) generation: u32,
    /// Records of the same member in older generations.
    pub(crate) superseded: usize,
    /// Further records of the same generation, with the same bits.
    pub(crate) repeated: usize,
}

/// A part that is being read.
struct Open<'p> {
    part: &'p Part,
    reader: Reader,
    place: usize,
    rows: usize,
}

impl<'p> Open<'p> {
    fn new(shelf: &Shelf<'_>, part: &'p Part) -> Result<Self, SweepError> {
        let reader = shelf.open(part)?;
        let mut open = Self {
            part,
            reader,
            place: part.span.start,
            rows: 0,
        };
        if !open.find(shelf)? || open.place != part.span.start {
            return Err(open.damaged("its first record is not the one that its name says"));
        }
        Ok(open)
    }

    /// Finds the place of the record; says whether there is one.
    fn find(&mut self, shelf: &Shelf<'_>) -> Result<bool, SweepError> {
        let Some(id) = self.reader.id() else {
            let has_all = self.rows == self.part.members && self.place + 1 == self.part.span.end;
            return if has_all {
                Ok(false)
            } else {
                Err(self.damaged("it has other members than its name says"))
            };
        };
        let place = shelf.inputs.place(id);
        let is_known = self.part.span.contains(&place) && shelf.inputs.id(place) == id;
        if !is_known || (self.rows > 0 && place <= self.place) {
            return Err(self.damaged("its members are out of order"));
        }
        self.place = place;
        self.rows += 1;
        Ok(true)
    }

    fn damaged(&self, reason: &str) -> SweepError {
        SweepError::Damaged {
            path: self.part.path.clone(),
            reason: reason.to_owned(),
        }
    }
}

/// Visits the record of every member that some part has, in ascending order. Of several the one of the last
/// generation counts; those of one generation must have the same bits.
pub(crate) fn walk(
    shelf: &Shelf<'_>,
    parts: &[Part],
    mut visit: impl FnMut(Found<'_>) -> Result<(), SweepError>,
) -> Result<(), SweepError> {
    let mut closed = parts.iter().peekable();
    let mut open: Vec<Open<'_>> = Vec::new();
    loop {
        let lowest = open.iter().map(|part| part.place).min();
        let next = closed.peek().map(|part| part.span.start);
        let Some(place) = lowest.into_iter().chain(next).min() else {
            return Ok(());
        };
        while let Some(part) = closed.next_if(|part| part.span.start == place) {
            open.push(Open::new(shelf, part)?);
        }
        let has_it = |part: &&Open<'_>| part.place == place;
        let Some(last) = open.iter().filter(has_it).max_by_key(|o| o.part.generation) else {
            return Ok(());
        };
        let generation = last.part.generation;
        let (mut superseded, mut repeated) = (0, 0);
        for other in open.iter().filter(has_it) {
            if other.part.generation < generation {
                superseded += 1;
            } else if other.reader.equals(&last.reader) {
                repeated += 1;
            } else {
                return Err(SweepError::Conflict {
                    member: shelf.inputs.id(place),
                    first: other.part.path.clone(),
                    second: last.part.path.clone(),
                });
            }
        }
        visit(Found {
            place,
            reader: &last.reader,
            generation,
            superseded,
            repeated: repeated - 1,
        })?;
        let mut index = 0;
        while index < open.len() {
            let part = &mut open[index];
            if part.place == place {
                part.reader.advance()?;
                if !part.find(shelf)? {
                    open.swap_remove(index);
                    continue;
                }
            }
            index += 1;
        }
    }
}

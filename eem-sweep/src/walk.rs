//! All records of a sweep in the order of their members, each once, whatever the parts they are in.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

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

/// A part that is being read, ordered so that the one with the lowest place comes first from a heap.
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

impl Ord for Open<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        other.place.cmp(&self.place)
    }
}

impl PartialOrd for Open<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.place == other.place
    }
}

impl Eq for Open<'_> {}

/// Visits the record of every member that some part has, in ascending order. If a member has several, the one of the
/// last generation counts; records of one generation must have the same bits.
pub(crate) fn walk(
    shelf: &Shelf<'_>,
    parts: &[Part],
    mut visit: impl FnMut(Found<'_>) -> Result<(), SweepError>,
) -> Result<(), SweepError> {
    let mut closed = parts.iter().peekable();
    let mut open: BinaryHeap<Open<'_>> = BinaryHeap::new();
    let mut here: Vec<Open<'_>> = Vec::new();
    loop {
        let lowest = open.peek().map(|part| part.place);
        let next = closed.peek().map(|part| part.span.start);
        let Some(place) = lowest.into_iter().chain(next).min() else {
            return Ok(());
        };
        while let Some(part) = closed.next_if(|part| part.span.start == place) {
            here.push(Open::new(shelf, part)?);
        }
        while open.peek().is_some_and(|part| part.place == place) {
            here.extend(open.pop());
        }
        if let Some(found) = judge(shelf, place, &here)? {
            visit(found)?;
        }
        for mut part in here.drain(..) {
            part.reader.advance()?;
            if part.find(shelf)? {
                open.push(part);
            }
        }
    }
}

/// The record that counts among those of one member.
fn judge<'r>(
    shelf: &Shelf<'_>,
    place: usize,
    records: &'r [Open<'_>],
) -> Result<Option<Found<'r>>, SweepError> {
    let Some(last) = records.iter().max_by_key(|open| open.part.generation) else {
        return Ok(None);
    };
    let generation = last.part.generation;
    let (mut superseded, mut repeated) = (0, 0);
    for other in records {
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
    Ok(Some(Found {
        place,
        reader: &last.reader,
        generation,
        superseded,
        repeated: repeated - 1,
    }))
}

//! How much of a sweep has been reported, and who is at work.

use std::fmt;
use std::path::Path;

use serde::Serialize;

use crate::begun::begun;
use crate::error::SweepError;
use crate::inputs::Inputs;
use crate::places::{Places, extend};
use crate::progress::{ShardProgress, of_all_processes};
use crate::sweep::Sweep;
use crate::walk::walk;

/// Ranges that a message names; the others are counted.
const NAMED: usize = 8;

/// The progress of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Status {
    /// Number of members.
    pub members: usize,
    /// Number of members with a record.
    pub reported: usize,
    /// Number of members whose latest record is a failure.
    pub failed: usize,
    /// Number of records replaced by a later run.
    pub superseded: usize,
    /// Number of records found more than once, with identical bits.
    pub repeated: usize,
    /// The ids without a record, possibly shortened; empty if there are none.
    pub missing: String,
    /// The ids among these that a process has begun: it is working on them, or ended while it was.
    pub begun: String,
    /// The latest reports of all processes.
    pub processes: Vec<ShardProgress>,
}

impl Sweep<'_> {
    /// Counts the reported members; other processes may be running.
    ///
    /// # Errors
    ///
    /// [`SweepError`] if there is no sweep or another one in the directory, or a file of it cannot be read.
    pub fn status(&self, directory: &Path) -> Result<Status, SweepError> {
        let opened = self.open(directory, None, false)?;
        let shelf = opened.shelf();
        let mut status = Status {
            members: self.inputs().members(),
            reported: 0,
            failed: 0,
            superseded: 0,
            repeated: 0,
            missing: String::new(),
            begun: String::new(),
            processes: of_all_processes(directory),
        };
        let mut found = Vec::new();
        walk(&shelf, &shelf.parts()?, |record| {
            status.reported += 1;
            status.failed += usize::from(record.reader.has_failed());
            status.superseded += record.superseded;
            status.repeated += record.repeated;
            extend(&mut found, record.place);
            Ok(())
        })?;
        let missing = Places::one(0..status.members).without(&Places::new(found));
        status.missing = named(&missing, self.inputs());
        status.begun = named(&begun(directory, &missing), self.inputs());
        Ok(status)
    }
}

/// The ids of members as text for people; if there are many ranges, the first of them.
pub(crate) fn named(places: &Places, inputs: &Inputs) -> String {
    // Ids ascend: those of a range are consecutive if its ends differ by its length less one.
    let pieces = places.ranges().iter().flat_map(|range| {
        let between = inputs.id(range.end - 1) - inputs.id(range.start);
        let is_run = between == range.len() as u64 - 1;
        let length = if is_run { range.len() } else { 1 };
        let starts = range.clone().step_by(length);
        starts.map(move |start| start..start + length)
    });
    let mut ranges: Vec<[u64; 2]> = Vec::new();
    let mut named = 0;
    for piece in pieces {
        let [first, last] = [piece.start, piece.end - 1].map(|place| inputs.id(place));
        let known = ranges.len();
        match ranges.last_mut() {
            Some([_, end]) if *end + 1 == first => *end = last,
            _ if known == NAMED => break,
            _ => ranges.push([first, last]),
        }
        named += piece.len();
    }
    let name = |&[first, last]: &[u64; 2]| match last - first {
        0 => first.to_string(),
        _ => format!("{first}-{last}"),
    };
    let mut texts: Vec<String> = ranges.iter().map(name).collect();
    let left = places.count() - named;
    if left > 0 {
        texts.push(format!("and {left} more"));
    }
    texts.join(",")
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            members,
            reported,
            failed,
            superseded,
            repeated,
            missing,
            begun,
            processes,
        } = self;
        write!(
            f,
            "{reported} of {members} members reported, {failed} failed"
        )?;
        if superseded + repeated > 0 {
            write!(
                f,
                "; {superseded} records superseded, {repeated} repeated with the same bits"
            )?;
        }
        if !missing.is_empty() {
            write!(f, "\nmissing: {missing}")?;
        }
        if !begun.is_empty() {
            write!(
                f,
                "\nof these a process is at work on, or has ended at: {begun}"
            )?;
        }
        for process in processes {
            let ShardProgress {
                selection,
                members,
                reported,
                failed,
                seconds,
                host,
                process,
                ..
            } = process;
            write!(
                f,
                "\n{selection}: {reported} of {members} reported, {failed} failed, in {seconds:.1} s by process {process} on {host}"
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::selection::Selection;

    #[test]
    fn what_is_named_can_be_selected() {
        let file = std::env::temp_dir().join(format!("eem-named-{}.csv", std::process::id()));
        std::fs::write(&file, "id,speed\n10,1\n20,2\n30,3\n31,4\n").unwrap();
        let inputs = Inputs::csv(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        let text = named(&Places::one(0..4), &inputs);
        assert_eq!(text, "10,20,30-31");
        let places = Selection::list(&text).unwrap().places(&inputs).unwrap();
        assert_eq!(places, Places::one(0..4));
        // The first ranges of many.
        let inputs = Inputs::grid([("speed", vec![0.0; 100])]).unwrap();
        let odd = Places::new((0..50).map(|i| 2 * i..2 * i + 1).collect());
        assert!(named(&odd, &inputs).ends_with(&format!("and {} more", 50 - NAMED)));
    }
}

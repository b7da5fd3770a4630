//! Notes of the members that a process has begun, which it removes when they are reported.
//!
//! A note that is left over is of a process that was killed, possibly by one of these members: by a stack overflow, by
//! `abort`, or for lack of memory. Such members come last when they are run again, in batches of a sixteenth of the
//! size. If a member was alone in its batch more than once, the number of threads is halved each further time. So other
//! members do not wait for one that cannot be run. Records do not depend on the order; a lost note only costs time.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fs;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process;

use crate::places::{Places, extend};
use crate::progress;

/// How names of notes end.
const ENDING: &str = "begun";

/// A batch during which a process ended is divided into this many when it is run again.
const SHARE: usize = 16;

/// The note of one thread.
pub(crate) struct Note(PathBuf);

impl Note {
    /// The note of a thread that has begun nothing; `name` is that of the run.
    pub(crate) fn new(directory: &Path, name: &str) -> Self {
        let chance = RandomState::new().build_hasher().finish();
        let name = format!("{name}.{}-{chance:016x}.{ENDING}", process::id());
        Self(progress::folder(directory).join(name))
    }

    /// Notes that these places are begun; all before are reported.
    pub(crate) fn begin(&self, places: &[usize]) {
        let ranges = Places::new(places.iter().map(|&place| place..place + 1).collect());
        let text = serde_json::to_vec(ranges.ranges()).unwrap_or_default();
        // If writing fails, they are not put last.
        let _lost = fs::write(&self.0, text);
    }
}

impl Drop for Note {
    fn drop(&mut self) {
        let _absent = fs::remove_file(&self.0);
    }
}

/// All notes with their files; a note is empty if its process was killed while writing it.
fn notes(directory: &Path) -> Vec<(PathBuf, Places)> {
    let entries = fs::read_dir(progress::folder(directory));
    let paths = entries.into_iter().flatten().flatten().map(|e| e.path());
    let paths = paths.filter(|path| path.extension().is_some_and(|end| end == ENDING));
    let read = |path: PathBuf| {
        let text = fs::read(&path).unwrap_or_default();
        let ranges: Vec<Range<usize>> = serde_json::from_slice(&text).unwrap_or_default();
        (path, Places::new(ranges))
    };
    paths.map(read).collect()
}

/// The places of `missing` that a process has begun.
pub(crate) fn begun(directory: &Path, missing: &Places) -> Places {
    let notes = notes(directory).into_iter();
    let ranges = notes.flat_map(|(_, note)| note.ranges().to_vec()).collect();
    missing.within(&Places::new(ranges))
}

/// Members that are run in the same way.
pub(crate) struct Class {
    pub(crate) places: Places,
    /// How many are reported at once; `None` if no process has begun them.
    pub(crate) batch: Option<usize>,
    /// How often the number of threads is halved.
    pub(crate) halvings: u32,
}

/// The places of `missing` in the order in which they are run: first those that no process has begun, last those that
/// were begun alone most often.
pub(crate) fn classes(directory: &Path, missing: &Places) -> Vec<Class> {
    // Of each place the smallest batch, and how often that had one member.
    let mut found: BTreeMap<usize, (Reverse<usize>, u32)> = BTreeMap::new();
    for (_, note) in notes(directory) {
        let members = note.count();
        for place in note.within(missing).iter() {
            let (least, alone) = found.entry(place).or_insert((Reverse(members), 0));
            *least = (*least).max(Reverse(members));
            *alone += u32::from(members == 1);
        }
    }
    let fresh = Places::new(found.keys().map(|&place| place..place + 1).collect());
    let fresh = Class {
        places: missing.without(&fresh),
        batch: None,
        halvings: 0,
    };
    let mut classes: BTreeMap<(Reverse<usize>, u32), Vec<Range<usize>>> = BTreeMap::new();
    for (place, key) in found {
        extend(classes.entry(key).or_default(), place);
    }
    let begun = classes.into_iter().map(|((least, alone), ranges)| Class {
        places: Places::new(ranges),
        batch: Some((least.0 / SHARE).max(1)),
        halvings: alone.saturating_sub(1),
    });
    [fresh].into_iter().chain(begun).collect()
}

/// Removes the notes that are about `reported` only.
pub(crate) fn forget(directory: &Path, reported: &Places) {
    for (path, note) in notes(directory) {
        if note.without(reported).count() == 0 {
            let _gone = fs::remove_file(path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_begun_alone_most_often_comes_last() {
        let directory = std::env::temp_dir().join(format!("eem-begun-{}", process::id()));
        let _absent = fs::remove_dir_all(&directory);
        fs::create_dir_all(progress::folder(&directory)).unwrap();
        let note = |places: &[usize]| {
            let note = Note::new(&directory, "all");
            note.begin(places);
            // As a killed process leaves it.
            std::mem::forget(note);
        };
        let many: Vec<usize> = (100..164).collect();
        for places in [many.as_slice(), &many[..4], &[101], &[103], &[103], &[7]] {
            note(places);
        }
        fs::write(progress::folder(&directory).join("torn.begun"), "[{").unwrap();
        let missing = Places::one(90..200);
        let classes = classes(&directory, &missing);
        let told: Vec<_> = classes
            .iter()
            .map(|class| (class.places.count(), class.batch, class.halvings))
            .collect();
        let expected = [
            (46, None, 0),
            (60, Some(4), 0),
            (2, Some(1), 0),
            (1, Some(1), 0),
            (1, Some(1), 1),
        ];
        assert_eq!(told, expected);
        assert_eq!(classes[4].places, Places::one(103..104));
        assert_eq!(begun(&directory, &missing), Places::one(100..164));
        forget(&directory, &missing);
        // That of a member that is not reported.
        let left = fs::read_dir(progress::folder(&directory)).unwrap();
        assert_eq!(left.count(), 1);
        fs::remove_dir_all(&directory).unwrap();
    }
}

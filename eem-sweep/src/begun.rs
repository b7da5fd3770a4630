//! Notes of the members that a process has begun, which it takes away when they are reported.
//!
//! What is left over is of processes that were killed, or of members that have killed theirs: by a stack overflow,
//! by `abort`, by more memory than there is. Such members come last when they are run again, each in a batch of its
//! own, those at which more processes have ended after the others and with fewer beside them. So nobody else waits
//! for a member that cannot be run. Records do not depend on the order; a note that is lost costs time only.

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

/// The note of one thread.
pub(crate) struct Note(PathBuf);

impl Note {
    /// Nothing is begun yet; `name` is that of the run.
    pub(crate) fn new(directory: &Path, name: &str) -> Self {
        let chance = RandomState::new().build_hasher().finish();
        let name = format!("{name}.{}-{chance:016x}.{ENDING}", process::id());
        Self(progress::folder(directory).join(name))
    }

    /// These places are begun, and all before are reported.
    pub(crate) fn begin(&self, places: &[usize]) {
        let ranges = Places::new(places.iter().map(|&place| place..place + 1).collect());
        let text = serde_json::to_vec(ranges.ranges()).unwrap_or_default();
        // Without it they are not put last.
        let _lost = fs::write(&self.0, text);
    }
}

impl Drop for Note {
    fn drop(&mut self) {
        let _absent = fs::remove_file(&self.0);
    }
}

/// All notes that can be read, with their files.
fn notes(directory: &Path) -> Vec<(PathBuf, Places)> {
    let entries = fs::read_dir(progress::folder(directory));
    let paths = entries.into_iter().flatten().flatten().map(|e| e.path());
    let paths = paths.filter(|path| path.extension().is_some_and(|end| end == ENDING));
    let read = |path: PathBuf| {
        let ranges: Vec<Range<usize>> = serde_json::from_slice(&fs::read(&path).ok()?).ok()?;
        Some((path, Places::new(ranges)))
    };
    paths.filter_map(read).collect()
}

/// Those of `missing` that somebody has begun.
pub(crate) fn begun(directory: &Path, missing: &Places) -> Places {
    let notes = notes(directory).into_iter();
    let ranges = notes.flat_map(|(_, note)| note.ranges().to_vec()).collect();
    missing.within(&Places::new(ranges))
}

/// The places of `missing` by how many notes they are in, those in none first.
pub(crate) fn classes(directory: &Path, missing: &Places) -> Vec<(u32, Places)> {
    let mut counts: BTreeMap<usize, u32> = BTreeMap::new();
    for (_, note) in notes(directory) {
        for place in note.within(missing).iter() {
            *counts.entry(place).or_default() += 1;
        }
    }
    let mut classes: BTreeMap<u32, Vec<Range<usize>>> = BTreeMap::new();
    for (&place, &count) in &counts {
        extend(classes.entry(count).or_default(), place);
    }
    let begun = counts.keys().map(|&place| place..place + 1);
    let fresh = missing.without(&Places::new(begun.collect()));
    let others = classes
        .into_iter()
        .map(|(n, ranges)| (n, Places::new(ranges)));
    [(0, fresh)].into_iter().chain(others).collect()
}

/// Removes the notes that are about `reported` only.
pub(crate) fn forget(directory: &Path, reported: &Places) {
    for (path, note) in notes(directory) {
        if note.without(reported).count() == 0 {
            let _gone = fs::remove_file(path);
        }
    }
}

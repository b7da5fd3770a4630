//! The strongly connected components of a graph that have more than one node.

use std::collections::BTreeSet;

use super::imports::Imports;

/// Sets of files of which each imports every other, directly or through others of the set.
pub(crate) fn circles(imports: &Imports) -> Vec<Vec<&str>> {
    let mut found = Vec::new();
    let mut done = BTreeSet::new();
    for file in imports.keys().map(String::as_str) {
        let reached = reached_from(imports, file);
        if done.contains(file) || !reached.contains(file) {
            continue;
        }
        let back = |other: &&str| reached_from(imports, other).contains(file);
        let circle: Vec<&str> = reached.iter().copied().filter(back).collect();
        done.extend(circle.iter().copied());
        found.push(circle);
    }
    found
}

/// What a file imports, and what that imports, and so on; the file itself if it is in a circle.
fn reached_from<'i>(imports: &'i Imports, file: &str) -> BTreeSet<&'i str> {
    let mut reached = BTreeSet::new();
    let mut pending = vec![file];
    while let Some(file) = pending.pop() {
        for next in imports.get(file).into_iter().flatten() {
            if reached.insert(next.as_str()) {
                pending.push(next);
            }
        }
    }
    reached
}

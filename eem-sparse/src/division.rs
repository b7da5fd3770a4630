//! Which fronts can be eliminated at the same time.
//!
//! ```text
//! fronts   part … part, own      parts: whole trees, divided the same way;  own: what follows them
//! ```
//!
//! Trees of fronts that do not contribute to each other are independent. As each front follows those
//! that contribute to it at once, a tree is a range of fronts, its last the root. The division depends on
//! the fronts and on the length of nodes alone.

use core::ops::Range;

use crate::fronts::Fronts;
use crate::threads;

/// A part is at most one in this many of the whole work, if it can be divided further.
const PARTS: usize = 32;

/// Work that is not worth another thread: some milliseconds.
const SMALL: usize = 1 << 23;

/// A range of fronts: parts that know nothing of each other, and the fronts after them.
#[derive(Debug)]
pub(crate) struct Division {
    pub(crate) parts: Vec<Division>,
    pub(crate) own: Range<usize>,
}

impl Division {
    /// All fronts, for nodes of this length; undivided if there are no threads or little work.
    pub(crate) fn new(fronts: &Fronts, length: usize) -> Self {
        let all = 0..fronts.len();
        if threads::DIVIDE {
            Forest::new(fronts, length).divide(all)
        } else {
            Self::whole(all)
        }
    }

    /// One after the other.
    pub(crate) fn whole(own: Range<usize>) -> Self {
        let parts = Vec::new();
        Self { parts, own }
    }
}

/// The trees of the fronts.
struct Forest {
    /// The first front of the tree below each front.
    firsts: Vec<usize>,
    /// The work of all fronts before each front, and of all.
    works: Vec<usize>,
    /// The most work of a part.
    most: usize,
}

impl Forest {
    fn new(fronts: &Fronts, length: usize) -> Self {
        let count = fronts.len();
        let mut firsts: Vec<usize> = (0..count).collect();
        let mut works = Vec::with_capacity(count + 1);
        let mut work = 0;
        works.push(work);
        for at in 0..count {
            let front = fronts.front(at);
            let [width, height] = front.sizes(length);
            let tall = width + height;
            // Moving an entry costs as much as a few multiplications.
            work += tall * tall * (width + 8);
            works.push(work);
            if let Some(parent) = fronts.parent(at) {
                firsts[parent] = firsts[parent].min(firsts[at]);
            }
        }
        Self {
            firsts,
            works,
            most: SMALL.max(work / PARTS),
        }
    }

    fn work(&self, range: &Range<usize>) -> usize {
        self.works[range.end] - self.works[range.start]
    }

    fn is_large(&self, range: &Range<usize>) -> bool {
        self.work(range) > self.most
    }

    /// The trees of a range of whole trees.
    fn trees(&self, range: Range<usize>) -> Vec<Range<usize>> {
        let mut trees = Vec::new();
        let mut end = range.end;
        while end > range.start {
            let start = self.firsts[end - 1];
            trees.push(start..end);
            end = start;
        }
        trees.reverse();
        trees
    }

    /// Divides a range of whole trees.
    fn divide(&self, range: Range<usize>) -> Division {
        if !self.is_large(&range) {
            return Division::whole(range);
        }
        let mut parts: Vec<Range<usize>> = Vec::new();
        for tree in self.branches(range.clone()) {
            match parts.last_mut() {
                Some(last) if !self.is_large(&(last.start..tree.end)) => last.end = tree.end,
                _ => parts.push(tree),
            }
        }
        let own = parts.last().map_or(range.start, |last| last.end)..range.end;
        if parts.len() < 2 {
            return Division::whole(range);
        }
        let parts = parts.into_iter().map(|part| self.divide(part));
        Division {
            parts: parts.collect(),
            own,
        }
    }

    /// Trees from the begin of a range, such that the only large one among them would be divided.
    fn branches(&self, mut range: Range<usize>) -> Vec<Range<usize>> {
        let mut branches = Vec::new();
        loop {
            let trees = self.trees(range);
            let is_large = |tree: &Range<usize>| self.is_large(tree);
            let first = trees.iter().position(is_large);
            let last = trees.iter().rposition(is_large);
            let Some(only) = first.filter(|_| first == last) else {
                branches.extend(trees);
                return branches;
            };
            // What is below the root.
            range = trees[only].start..trees[only].end - 1;
            branches.extend_from_slice(&trees[..only]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Division, Forest};

    /// A forest whose fronts take the same work, from the first front of each tree.
    fn forest(firsts: &[usize], most: usize) -> Forest {
        Forest {
            firsts: firsts.to_vec(),
            works: (0..=firsts.len()).collect(),
            most,
        }
    }

    fn shape(division: &Division) -> String {
        let parts: String = division.parts.iter().map(shape).collect();
        format!("({parts}{:?})", division.own)
    }

    #[test]
    fn a_path_is_not_divided() {
        let division = forest(&[0; 9], 2).divide(0..9);
        assert_eq!(shape(&division), "(0..9)");
    }

    #[test]
    fn trees_are_divided_until_they_are_small() {
        //        8          first fronts
        //     3     7       0       4
        //    0 1 2  4─5─6
        let trees = [0, 1, 2, 0, 4, 4, 4, 4, 0];
        let division = forest(&trees, 4).divide(0..9);
        assert_eq!(shape(&division), "((0..4)(4..8)8..9)");
        let division = forest(&trees, 3).divide(0..9);
        assert_eq!(shape(&division), "((0..4)(4..8)8..9)");
        let division = forest(&trees, 2).divide(0..9);
        assert_eq!(shape(&division), "(((0..2)(2..3)3..4)(4..8)8..9)");
    }
}

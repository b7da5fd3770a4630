//! Which fronts can be eliminated in parallel.
//!
//! ```text
//! fronts   part … part, own      parts: independent trees, divided in the same way;  own: all later fronts
//! ```
//!
//! A front and all fronts below it are a tree, and disjoint trees are independent. Fronts are in postorder,
//! so a tree is a range of fronts whose last is the root. The division depends on the fronts and on the
//! block length alone, not on the number of threads.

use core::ops::Range;

use crate::fronts::Fronts;
use crate::threads;

/// A part with more than 1/32 of the whole work is divided further if possible: enough parts for a few
/// dozen threads.
const PARTS: usize = 32;

/// Parts with at most this many multiplications, some milliseconds, are not divided.
const SMALL: usize = 1 << 23;

/// A range of fronts: independent parts, and the fronts after them.
#[derive(Debug)]
pub(crate) struct Division {
    pub(crate) parts: Vec<Division>,
    pub(crate) own: Range<usize>,
}

impl Division {
    /// Divides all fronts, for blocks of this many rows; without the feature `parallel`, not at all.
    pub(crate) fn new(fronts: &Fronts, length: usize) -> Self {
        let all = 0..fronts.len();
        if threads::DIVIDE {
            Forest::new(fronts, length).divide(all)
        } else {
            Self::whole(all)
        }
    }

    /// A range without parts.
    pub(crate) fn whole(own: Range<usize>) -> Self {
        let parts = Vec::new();
        Self { parts, own }
    }
}

/// The trees of the fronts.
struct Forest {
    /// The first front of the tree below each front.
    firsts: Vec<usize>,
    /// Prefix sums of the work of the fronts.
    works: Vec<usize>,
    /// A part with more work is divided further.
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
            // Multiplications per entry of the front, and 8 for gathering and moving it.
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

    /// The trees of a range. While exactly one of them is large, it is replaced by the trees below its root,
    /// as a single large tree could not run in parallel to anything.
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
            // The trees below the root of the large one.
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

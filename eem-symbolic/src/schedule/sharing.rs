//! Common parts of products and of sums: which operands are best combined first.
//!
//! The order in which a product or a sum is evaluated is free, and some orders have more partial
//! results in common than others: `a·(x·y)` and `b·(x·y)` take three products, `(a·x)·y` and
//! `(b·x)·y` four. The pair of operands that occurs most often becomes one operand, again and
//! again, until no pair occurs twice (Breuer 1969, *Generation of optimal code for expressions via
//! factorization*). Among equals the earlier pair wins, so the choice is the same every time.

use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

/// Position of an operand in a [`Sharing`].
pub(super) type Token = usize;

/// Lists of more operands than this keep their order.
const LONGEST: usize = 32;

/// An operand of a product or a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Entry {
    pub(super) token: Token,
    /// Whether it is subtracted; never true in a product.
    pub(super) negative: bool,
}

/// Two operands, and whether the second one has the other sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub(super) first: Token,
    pub(super) second: Token,
    pub(super) opposite: bool,
}

/// Lists of operands, and the pairs that have been taken together.
#[derive(Debug, Default)]
pub(super) struct Sharing {
    lists: Vec<Vec<Entry>>,
    /// The pair that a token stands for; `None` for an operand from outside.
    pairs: Vec<Option<Pair>>,
    /// The lists in which a pair occurs.
    occurrences: BTreeMap<Pair, BTreeSet<usize>>,
}

impl Sharing {
    /// A new operand.
    pub(super) fn token(&mut self) -> Token {
        self.pairs.push(None);
        self.pairs.len() - 1
    }

    /// A new list; returns its position.
    pub(super) fn list(&mut self, entries: Vec<Entry>) -> usize {
        self.lists.push(entries);
        self.lists.len() - 1
    }

    /// The present operands of a list, some of them pairs.
    pub(super) fn entries(&self, list: usize) -> &[Entry] {
        &self.lists[list]
    }

    /// The pair that a token stands for; `None` for an operand from outside.
    pub(super) fn pair(&self, token: Token) -> Option<Pair> {
        self.pairs[token]
    }

    /// Takes pairs together until none occurs twice.
    pub(super) fn solve(&mut self) {
        for list in 0..self.lists.len() {
            if self.lists[list].len() <= LONGEST {
                for (i, &entry) in self.lists[list].clone().iter().enumerate() {
                    self.note(list, entry, i + 1);
                }
            }
        }
        let count = |(pair, lists): (&Pair, &BTreeSet<usize>)| Candidate::new(*pair, lists.len());
        let mut candidates: BinaryHeap<_> = self.occurrences.iter().map(count).collect();
        while let Some(candidate) = candidates.pop() {
            let pair = candidate.pair();
            let present = self.occurrences.get(&pair).map_or(0, BTreeSet::len);
            if present < 2 {
                continue;
            }
            if present < candidate.count {
                candidates.push(Candidate::new(pair, present));
                continue;
            }
            candidates.extend(self.combine(pair));
        }
        self.occurrences.clear();
    }

    /// Records the pairs of an entry with the entries that follow in its list.
    fn note(&mut self, list: usize, entry: Entry, following: usize) {
        for &other in &self.lists[list][following..] {
            let lists = self.occurrences.entry(pair_of(entry, other)).or_default();
            lists.insert(list);
        }
    }

    /// Makes the pair one operand of all lists in which it occurs; returns the new pairs.
    fn combine(&mut self, pair: Pair) -> Vec<Candidate> {
        let lists = self.occurrences.remove(&pair).unwrap_or_default();
        let token = self.token();
        self.pairs[token] = Some(pair);
        let mut touched = BTreeSet::new();
        for list in lists {
            let old = std::mem::take(&mut self.lists[list]);
            let is_part = |entry: &&Entry| entry.token == pair.first || entry.token == pair.second;
            let Some(&first) = old.iter().find(|entry| entry.token == pair.first) else {
                self.lists[list] = old;
                continue;
            };
            for part in old.iter().filter(is_part) {
                for other in old.iter().filter(|other| other.token != part.token) {
                    if let Some(lists) = self.occurrences.get_mut(&pair_of(*part, *other)) {
                        lists.remove(&list);
                    }
                }
            }
            let combined = Entry {
                token,
                negative: first.negative,
            };
            let mut new: Vec<_> = old
                .iter()
                .filter(|entry| !is_part(entry))
                .copied()
                .collect();
            for &other in &new {
                let pair = pair_of(combined, other);
                self.occurrences.entry(pair).or_default().insert(list);
                touched.insert(pair);
            }
            new.push(combined);
            self.lists[list] = new;
        }
        let count = |pair: Pair| Candidate::new(pair, self.occurrences[&pair].len());
        touched.into_iter().map(count).collect()
    }
}

/// Both entries as a pair, the older token first.
fn pair_of(a: Entry, b: Entry) -> Pair {
    let (first, second) = if a.token < b.token { (a, b) } else { (b, a) };
    Pair {
        first: first.token,
        second: second.token,
        opposite: first.negative != second.negative,
    }
}

/// A pair ordered by the number of its occurrences: the greatest is the most frequent, among equals the oldest.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Candidate {
    count: usize,
    pair: std::cmp::Reverse<Pair>,
}

impl Candidate {
    fn new(pair: Pair, count: usize) -> Self {
        let pair = std::cmp::Reverse(pair);
        Self { count, pair }
    }

    fn pair(&self) -> Pair {
        self.pair.0
    }
}

#[cfg(test)]
mod tests {
    use super::{Entry, Sharing};

    fn entry(token: usize) -> Entry {
        Entry {
            token,
            negative: false,
        }
    }

    #[test]
    fn the_most_frequent_pair_is_combined() {
        let mut sharing = Sharing::default();
        let [a, b, x, y] = [0; 4].map(|_| sharing.token());
        let lists = [[a, x, y], [b, x, y], [x, a, y]];
        let lists = lists.map(|list| sharing.list(list.map(entry).to_vec()));
        sharing.solve();
        let pair = sharing.pair(4).expect("a pair has been made");
        assert_eq!((pair.first, pair.second), (x, y));
        let lengths = lists.map(|list| sharing.entries(list).len());
        // `a·x·y` occurs twice, and is one operand in the end.
        assert_eq!(lengths, [1, 2, 1]);
    }

    #[test]
    fn differences_are_shared_up_to_their_sign() {
        let mut sharing = Sharing::default();
        let [a, b, c] = [0; 3].map(|_| sharing.token());
        let minus = |token| Entry {
            token,
            negative: true,
        };
        let first = sharing.list(vec![entry(a), minus(b), entry(c)]);
        let second = sharing.list(vec![entry(b), minus(a)]);
        let third = sharing.list(vec![entry(a), entry(b)]);
        sharing.solve();
        assert_eq!(sharing.entries(first).len(), 2);
        assert_eq!(sharing.entries(second), [minus(3)]);
        assert_eq!(sharing.entries(third).len(), 2);
    }
}

//! Nested dissection: an order of elimination that splits a graph into two sides and a separator.
//!
//! All unknowns of a node are eliminated together, so "unknown" stands for a node here.
//!
//! ```text
//! order   one side, the other side, the separator;  each side is ordered in the same way
//! ```
//!
//! There is no fill-in between the two sides (George 1973). Candidates for separators are level sets of the
//! distance from one of three points that are far from each other, and of the difference of two such
//! distances: in a lattice, diagonal and straight lines. Parts of at most `SMALL` unknowns are ordered by
//! minimum degree.

use core::cmp::Ordering;
use core::mem;

use crate::compact::compact;
use crate::pattern::Pattern;

/// Parts with at most this many unknowns are not divided.
const SMALL: usize = 500;

/// A cut is accepted if the smaller side has at least 1/5 of the unknowns.
const LARGEST_SHARE: usize = 5;

/// Stands for the number of an unknown in a separator, and for the distance of an unknown that was not reached.
const NONE: u32 = u32::MAX;

/// The unknowns in the order of their elimination; `None` if `amd` finds none.
pub(crate) fn order(pattern: &Pattern) -> Option<Vec<u32>> {
    let count = pattern.nodes();
    let mut dissection = Dissection::new(pattern);
    let mut unknowns: Vec<u32> = (0..compact(count)).collect();
    let mut separators = Vec::new();
    let mut parts = vec![(0, count)];
    while let Some((start, end)) = parts.pop() {
        let set = &mut unknowns[start..end];
        if set.len() * pattern.block_length() <= SMALL {
            continue;
        }
        let Some([left, right]) = dissection.divide(set) else {
            continue;
        };
        let middle = start + left;
        parts.extend([(start, middle), (middle, middle + right)]);
        separators.push(middle + right..end);
    }
    let mut order = rest_by_degree(pattern, &dissection.separated)?;
    // Those found first are eliminated last.
    for separator in separators.into_iter().rev() {
        order.extend_from_slice(&unknowns[separator]);
    }
    Some(order)
}

/// All unknowns by minimum degree; `None` if `amd` finds no order.
pub(crate) fn by_degree(pattern: &Pattern) -> Option<Vec<u32>> {
    rest_by_degree(pattern, &vec![false; pattern.nodes()])
}

/// The unknowns outside of separators by minimum degree.
fn rest_by_degree(pattern: &Pattern, separated: &[bool]) -> Option<Vec<u32>> {
    let inner = (0..separated.len()).filter(|&unknown| !separated[unknown]);
    let inner: Vec<u32> = inner.map(compact).collect();
    let mut numbers = vec![NONE; separated.len()];
    for (number, &unknown) in inner.iter().enumerate() {
        numbers[unknown as usize] = compact(number);
    }
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for &unknown in &inner {
        let neighbours = pattern.row(unknown as usize).iter();
        let neighbours = neighbours.map(|&neighbour| numbers[neighbour as usize]);
        rows.extend(neighbours.filter(|&number| number != NONE));
        starts.push(compact(rows.len()));
    }
    let ordered = amd::order(
        compact(inner.len()),
        &starts,
        &rows,
        &amd::Control::default(),
    );
    let (mut order, ..) = ordered.ok()?;
    for number in &mut order {
        *number = inner[*number as usize];
    }
    Some(order)
}

/// Memory shared by all levels of the recursion; vectors have an element for each unknown.
struct Dissection<'a> {
    pattern: &'a Pattern,
    /// Whether each unknown is in a separator. Others in different parts are never neighbours.
    separated: Vec<bool>,
    distances: [Vec<u32>; 3],
    key: Vec<u32>,
    queue: Vec<u32>,
}

/// A split of a part: the left side has a key below the threshold, the right side does not, and the
/// separator is below it with a neighbour that is not.
#[derive(Clone, Copy)]
struct Cut {
    /// Which points: the key is the distance from the first, less that from the second if there is one.
    key: (usize, Option<usize>),
    threshold: u32,
    separator: usize,
    left: usize,
    right: usize,
}

impl Cut {
    /// Compares the costs `separator² / (left · right)`.
    fn compare(&self, other: &Self) -> Ordering {
        let cost = |cut: &Self, other: &Self| {
            let [separator, left, right] = [cut.separator, other.left, other.right];
            let [separator, left, right] = [separator, left, right].map(|count| count as u128);
            separator * separator * left * right
        };
        cost(self, other).cmp(&cost(other, self))
    }
}

impl<'a> Dissection<'a> {
    /// All unknowns as one part.
    fn new(pattern: &'a Pattern) -> Self {
        let count = pattern.nodes();
        Self {
            pattern,
            separated: vec![false; count],
            distances: [vec![0; count], vec![0; count], vec![0; count]],
            key: vec![0; count],
            queue: Vec::with_capacity(count),
        }
    }

    /// Sorts a part into left side, right side and separator; returns the sizes of the sides.
    fn divide(&mut self, set: &mut [u32]) -> Option<[usize; 2]> {
        if let Some(left) = self.components(set) {
            set.copy_from_slice(&self.queue);
            return Some([left, set.len() - left]);
        }
        let mut point = *self.queue.last()?;
        for at in 0..3 {
            self.measure(at, point, set);
            let [first, second, _] = &self.distances;
            let from_both = |unknown: u32| {
                let unknown = unknown as usize;
                first[unknown].min(second[unknown])
            };
            point = match at {
                0 => *self.queue.last()?,
                _ => *set.iter().max_by_key(|&&unknown| from_both(unknown))?,
            };
        }
        let points = [(0, None), (1, None), (2, None)];
        let pairs = [(0, Some(1)), (0, Some(2)), (1, Some(2))];
        let keys = points.into_iter().chain(pairs);
        let cuts = keys.filter_map(|key| self.best_cut(key, set));
        let best = cuts.min_by(Cut::compare)?;
        self.evaluate(best.key, set);
        let threshold = best.threshold;
        set.sort_by_cached_key(|&unknown| match self.reach(unknown) {
            (key, _) if key >= threshold => 1,
            (_, reach) if reach >= threshold => 2,
            _ => 0,
        });
        for &unknown in &set[best.left + best.right..] {
            self.separated[unknown as usize] = true;
        }
        Some([best.left, best.right])
    }

    /// Queues a part component by component. Returns the end of a component that splits the queue most
    /// evenly, or `None` if the part is connected.
    fn components(&mut self, set: &[u32]) -> Option<usize> {
        self.queue.clear();
        for &unknown in set {
            self.distances[0][unknown as usize] = NONE;
        }
        let mut best = None;
        for &unknown in set {
            if self.distances[0][unknown as usize] != NONE {
                continue;
            }
            let uneven = |end: usize| end.abs_diff(set.len() - end);
            let end = self.queue.len();
            if end > 0 && best.is_none_or(|best| uneven(end) < uneven(best)) {
                best = Some(end);
            }
            self.spread(0, unknown);
        }
        best
    }

    /// Fills in the distances from a point to all unknowns of a connected part.
    fn measure(&mut self, at: usize, point: u32, set: &[u32]) {
        self.queue.clear();
        for &unknown in set {
            self.distances[at][unknown as usize] = NONE;
        }
        self.spread(at, point);
    }

    /// Breadth-first search from a point within its part.
    fn spread(&mut self, at: usize, point: u32) {
        let distances = &mut self.distances[at];
        let mut head = self.queue.len();
        self.queue.push(point);
        distances[point as usize] = 0;
        while let Some(&unknown) = self.queue.get(head) {
            head += 1;
            let distance = distances[unknown as usize] + 1;
            for &neighbour in self.pattern.row(unknown as usize) {
                let place = neighbour as usize;
                if !self.separated[place] && distances[place] == NONE {
                    distances[place] = distance;
                    self.queue.push(neighbour);
                }
            }
        }
    }

    /// Computes the key of every unknown, shifted so that none is negative; returns the largest.
    fn evaluate(&mut self, (from, less): (usize, Option<usize>), set: &[u32]) -> u32 {
        let mut keys = mem::take(&mut self.key);
        let distance = |at: usize, unknown: u32| self.distances[at][unknown as usize];
        let furthest = less.map_or(0, |at| {
            let distances = set.iter().map(|&unknown| distance(at, unknown));
            distances.max().unwrap_or(0)
        });
        let mut largest = 0;
        for &unknown in set {
            let nearer = less.map_or(0, |at| furthest - distance(at, unknown));
            let key = distance(from, unknown) + nearer;
            keys[unknown as usize] = key;
            largest = largest.max(key);
        }
        self.key = keys;
        largest
    }

    /// The key of an unknown, and the largest key among it and its neighbours.
    fn reach(&self, unknown: u32) -> (u32, u32) {
        let row = self.pattern.row(unknown as usize).iter();
        let inner = row.filter(|&&neighbour| !self.separated[neighbour as usize]);
        let keys = inner.map(|&neighbour| self.key[neighbour as usize]);
        let key = self.key[unknown as usize];
        (key, keys.fold(key, u32::max))
    }

    /// The cut of least cost among all thresholds of a key.
    fn best_cut(&mut self, key: (usize, Option<usize>), set: &[u32]) -> Option<Cut> {
        let levels = self.evaluate(key, set) as usize + 1;
        // By key: how many unknowns have it, and the change of the size of the separator when the
        // threshold reaches it.
        let mut counts = vec![(0_usize, 0_isize); levels + 1];
        for &unknown in set {
            let (key, reach) = self.reach(unknown);
            counts[key as usize].0 += 1;
            counts[key as usize + 1].1 += 1;
            counts[reach as usize + 1].1 -= 1;
        }
        let (mut below, mut separator) = (0, 0);
        let mut best: Option<Cut> = None;
        for threshold in 1..levels {
            below += counts[threshold - 1].0;
            separator = usize::checked_add_signed(separator, counts[threshold].1)?;
            let cut = Cut {
                key,
                threshold: compact(threshold),
                separator,
                left: below - separator,
                right: set.len() - below,
            };
            let is_even = cut.left.min(cut.right) * LARGEST_SHARE >= set.len();
            if is_even && best.is_none_or(|best| cut.compare(&best).is_lt()) {
                best = Some(cut);
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::{Dissection, SMALL, order};
    use crate::pattern::Pattern;

    /// A rectangle of unknowns, each connected with its neighbours in four directions. The corner has the number
    /// `first`, and others follow, row by row, as on a ring.
    fn rectangle([columns, rows]: [usize; 2], first: usize) -> Pattern {
        let count = columns * rows;
        let number = |at: usize| (at + first) % count;
        Pattern::new(count, |pair| {
            for at in 0..count {
                if (at + 1) % columns != 0 {
                    pair(number(at), number(at + 1));
                }
                if at + columns < count {
                    pair(number(at), number(at + columns));
                }
            }
        })
    }

    /// Divides all unknowns. Asserts that they are kept, and that no pair connects the sides; returns the sizes
    /// of the sides.
    fn divided(pattern: &Pattern) -> [usize; 2] {
        let mut dissection = Dissection::new(pattern);
        let mut set: Vec<u32> = (0..).take(pattern.nodes()).collect();
        let [left, right] = dissection.divide(&mut set).unwrap();
        let mut sides = vec![2; set.len()];
        set.iter()
            .take(left + right)
            .for_each(|&at| sides[at as usize] = 1);
        set.iter().take(left).for_each(|&at| sides[at as usize] = 0);
        for (node, &side) in sides.iter().enumerate() {
            assert_eq!(dissection.separated[node], side == 2);
            for &other in pattern.row(node) {
                let other = other as usize;
                assert!(side + sides[other] != 1, "{node} {other}");
            }
        }
        set.sort_unstable();
        assert!((0..).zip(&set).all(|(at, &unknown)| at == unknown));
        [left, right]
    }

    // The shorter line through the middle; in a square, the diagonal of 26 cuts off the smallest corner with a fifth
    // of all unknowns, which costs less: 26² / (325 · 1249) < 40² / 780².
    #[test]
    fn a_rectangle_is_cut_at_the_least_cost() {
        // Where the numbers begin does not matter, be it in the middle.
        for first in [0, 820] {
            assert_eq!(divided(&rectangle([80, 20], first)), [790; 2]);
            assert_eq!(divided(&rectangle([20, 80], first)), [790; 2]);
        }
        let mut square = divided(&rectangle([40; 2], 0));
        square.sort_unstable();
        assert_eq!(square, [325, 1249]);
    }

    #[test]
    fn components_are_divided_as_evenly_as_possible() {
        // Paths of 1, 2, 3 … 9 unknowns.
        let pattern = Pattern::new(45, |pair| {
            let is_first = |at: usize| (1..10).any(|count| at == count * (count - 1) / 2);
            for at in (1..45).filter(|&at| !is_first(at)) {
                pair(at - 1, at);
            }
        });
        assert_eq!(divided(&pattern), [21, 24]);
    }

    #[test]
    fn the_last_unknowns_of_a_square_are_a_line_across_it() {
        let side = 40;
        assert!(side * side > 2 * SMALL);
        let order = order(&rectangle([side; 2], 0)).unwrap();
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!((0..).zip(&sorted).all(|(at, &unknown)| at == unknown));
        // A separator that is left out of the square leaves more than one piece of it.
        let last = &order[order.len() - side..];
        let mut reached = vec![false; order.len()];
        for &at in last {
            reached[at as usize] = true;
        }
        let start = order[0] as usize;
        reached[start] = true;
        let mut path = vec![start];
        let pattern = rectangle([side; 2], 0);
        while let Some(at) = path.pop() {
            for &next in pattern.row(at) {
                if !core::mem::replace(&mut reached[next as usize], true) {
                    path.push(next as usize);
                }
            }
        }
        let alone = reached.iter().filter(|reached| !**reached).count();
        assert!(alone > order.len() / 5, "{alone}");
    }

    #[test]
    fn what_is_not_connected_is_divided_without_a_separator() {
        let unknowns = 3 * SMALL;
        let pattern = Pattern::new(unknowns, |pair| {
            for first in (0..unknowns).step_by(3) {
                pair(first, first + 1);
            }
        });
        assert_eq!(order(&pattern).unwrap().len(), unknowns);
    }
}

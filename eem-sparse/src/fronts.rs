//! Which nodes are eliminated together, and which later nodes each elimination changes.
//!
//! ```text
//! front   own nodes, consecutive in the order of elimination
//!         rows below: later nodes coupled with an own node, by the matrix or by fill-in
//! ```
//!
//! The pattern is symmetric, so the rows below are also the columns to the right. Nodes are ordered by
//! approximate minimum degree (Amestoy, Davis & Duff 1996). If that fills in much, nested dissection is tried
//! as well, and the order with fewer multiplications is taken.

use core::mem;
use core::ops::Range;

use crate::compact::compact;
use crate::dissection;
use crate::pattern::Pattern;
use crate::supernodes::{Ordered, places};

/// Nested dissection is tried if the factors have more than this many times the entries of the matrix.
const WORTH_DISSECTING: usize = 4;

/// The fronts in postorder: each right after the trees of fronts below it.
#[derive(Debug)]
pub(crate) struct Fronts {
    /// The node that is eliminated at each place.
    pub(crate) order: Vec<u32>,
    /// The place of each node in the order of elimination.
    pub(crate) places: Vec<u32>,
    /// Front f has the places `begins[f]..begins[f + 1]`,
    begins: Vec<u32>,
    /// and the rows below `rows[starts[f]..starts[f + 1]]`, as places, ascending.
    starts: Vec<u32>,
    rows: Vec<u32>,
}

/// One front: its own places and those below.
#[derive(Clone, Debug)]
pub(crate) struct Front<'a> {
    pub(crate) own: Range<usize>,
    pub(crate) rows: &'a [u32],
}

/// How much memory consecutive fronts need.
#[derive(Debug, Default)]
pub(crate) struct Extent {
    /// Entries of L with the diagonal blocks, and of U without.
    pub(crate) lower: usize,
    pub(crate) upper: usize,
    /// The most numbers, and the most fronts, on the stack of Schur complements at any time.
    pub(crate) left: usize,
    pub(crate) waiting: usize,
    /// The most own unknowns, and the most unknowns below, of any front.
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl Fronts {
    /// Orders and analyses a pattern; `None` if `amd` finds no order.
    pub(crate) fn new(pattern: &Pattern) -> Option<Self> {
        if pattern.columns().len() == pattern.nodes() {
            return Some(Self::uncoupled(pattern.nodes()));
        }
        let by_degree = Self::ordered(pattern, &dissection::by_degree(pattern)?);
        let length = pattern.block_length();
        let Extent { lower, upper, .. } = by_degree.extent(0..by_degree.len(), length);
        if lower + upper <= WORTH_DISSECTING * pattern.entries() {
            return Some(by_degree);
        }
        let dissected = Self::ordered(pattern, &dissection::order(pattern)?);
        let is_better = dissected.multiplications() < by_degree.multiplications();
        Some(if is_better { dissected } else { by_degree })
    }

    /// A front for each node, none of which has neighbours.
    fn uncoupled(nodes: usize) -> Self {
        let order: Vec<u32> = (0..compact(nodes)).collect();
        Self {
            places: order.clone(),
            begins: (0..=compact(nodes)).collect(),
            starts: vec![0; nodes + 1],
            rows: Vec::new(),
            order,
        }
    }

    /// Analyses a pattern for an order of elimination, or one with the same fill-in.
    fn ordered(pattern: &Pattern, order: &[u32]) -> Self {
        let tree = Ordered::new(pattern, order, &places(order)).tree();
        let sequence = postorder(&tree);
        let moved = places(&sequence);
        let parent = |&place: &u32| moved.get(tree[place as usize] as usize).copied();
        let parents: Vec<Option<u32>> = sequence.iter().map(parent).collect();
        let sequence = sequence.into_iter();
        let order: Vec<u32> = sequence.map(|place| order[place as usize]).collect();
        let places = places(&order);
        let ordered = Ordered::new(pattern, &order, &places);
        let supernodes = ordered.supernodes(&parents);
        let mut fronts = Self {
            begins: Vec::with_capacity(supernodes.len() + 1),
            starts: Vec::with_capacity(supernodes.len() + 1),
            rows: Vec::new(),
            order: Vec::new(),
            places: Vec::new(),
        };
        fronts.begins.push(0);
        fronts.starts.push(0);
        // The latest front that each place is a row of, and fronts whose parent is still to come.
        let mut seen = vec![0; order.len()];
        let mut waiting: Vec<Range<usize>> = Vec::new();
        for (own, front) in supernodes.into_iter().zip(1_u32..) {
            let first = fronts.rows.len();
            let mut add = |rows: &mut Vec<u32>, row: u32| {
                let is_new = mem::replace(&mut seen[row as usize], front) != front;
                if row as usize >= own.end && is_new {
                    rows.push(row);
                }
            };
            for place in own.clone() {
                ordered
                    .row(place)
                    .for_each(|row| add(&mut fronts.rows, row));
            }
            while let Some(child) =
                waiting.pop_if(|child| (fronts.rows[child.start] as usize) < own.end)
            {
                for at in child {
                    let row = fronts.rows[at];
                    add(&mut fronts.rows, row);
                }
            }
            fronts.rows[first..].sort_unstable();
            if first < fronts.rows.len() {
                waiting.push(first..fronts.rows.len());
            }
            fronts.begins.push(compact(own.end));
            fronts.starts.push(compact(fronts.rows.len()));
        }
        fronts.rows.shrink_to_fit();
        Self {
            order,
            places,
            ..fronts
        }
    }

    /// Number of fronts.
    pub(crate) fn len(&self) -> usize {
        self.begins.len() - 1
    }

    /// A front.
    pub(crate) fn front(&self, at: usize) -> Front<'_> {
        Front {
            own: self.begins[at] as usize..self.begins[at + 1] as usize,
            rows: &self.rows[self.starts[at] as usize..self.starts[at + 1] as usize],
        }
    }

    /// The front that takes up the Schur complement of a front.
    pub(crate) fn parent(&self, at: usize) -> Option<usize> {
        let place = self.front(at).rows.first()?;
        Some(self.begins.partition_point(|begin| begin <= place) - 1)
    }

    /// The multiplications of an elimination, counted in blocks.
    fn multiplications(&self) -> u128 {
        let fronts = (0..self.len()).map(|at| self.front(at));
        let counts = fronts.map(|front| {
            let [width, height] = [front.own.len(), front.rows.len()].map(|count| count as u128);
            width * (width * width / 3 + width * height + height * height)
        });
        counts.sum()
    }

    /// The places of the own nodes of consecutive fronts.
    pub(crate) fn places(&self, fronts: &Range<usize>) -> Range<usize> {
        self.begins[fronts.start] as usize..self.begins[fronts.end] as usize
    }

    /// The memory of consecutive fronts, with blocks of this many rows.
    pub(crate) fn extent(&self, fronts: Range<usize>, length: usize) -> Extent {
        let mut extent = Extent::default();
        let mut left = 0;
        let mut waiting: Vec<Front<'_>> = Vec::new();
        for front in fronts.map(|at| self.front(at)) {
            let [width, height] = front.sizes(length);
            extent.lower += width * (width + height);
            extent.upper += width * height;
            extent.width = extent.width.max(width);
            extent.height = extent.height.max(height);
            left += height * height;
            extent.left = extent.left.max(left);
            while let Some(child) = waiting.pop_if(|child| child.contributes_to(&front)) {
                let [_, height] = child.sizes(length);
                left -= height * height;
            }
            if height > 0 {
                waiting.push(front);
            }
            extent.waiting = extent.waiting.max(waiting.len());
        }
        extent
    }
}

impl Front<'_> {
    /// How many unknowns are its own and how many are below, with blocks of this many rows.
    #[inline]
    pub(crate) fn sizes(&self, length: usize) -> [usize; 2] {
        [self.own.len() * length, self.rows.len() * length]
    }

    /// Whether the Schur complement of this front, the latest on the stack, belongs to the given front.
    pub(crate) fn contributes_to(&self, front: &Front<'_>) -> bool {
        (self.rows[0] as usize) < front.own.end
    }
}

/// The nodes of a forest, each right after the trees of its children, which ascend. Numbers that are no node
/// are parents of roots.
fn postorder(parents: &[u32]) -> Vec<u32> {
    let roots = parents.len();
    // The first child of each node and of the forest, and the next child of the same parent.
    let mut first = vec![None; roots + 1];
    let mut next = vec![None; roots];
    for (node, &parent) in (0..compact(roots)).zip(parents).rev() {
        next[node as usize] = first[roots.min(parent as usize)].replace(node);
    }
    let mut sequence = Vec::with_capacity(roots);
    let mut path = Vec::new();
    let mut down = first[roots];
    loop {
        while let Some(node) = down {
            path.push(node);
            down = first[node as usize];
        }
        let Some(node) = path.pop() else {
            return sequence;
        };
        sequence.push(node);
        down = next[node as usize];
    }
}

#[cfg(test)]
mod tests {
    use super::{Fronts, dissection, postorder};
    use crate::pattern::Pattern;

    const NONE: u32 = u32::MAX;

    /// Two nodes above three that are alone afterwards.
    fn two_above_three() -> Fronts {
        Fronts {
            order: vec![4, 3, 2, 1, 0],
            places: vec![4, 3, 2, 1, 0],
            begins: vec![0, 2, 5],
            starts: vec![0, 3, 3],
            rows: vec![2, 3, 4],
        }
    }

    #[test]
    fn multiplications_and_memory_are_those_of_the_formulas() {
        let fronts = two_above_three();
        assert_eq!(fronts.multiplications(), 2 * (1 + 6 + 9) + 3 * 3);
        assert_eq!([fronts.parent(0), fronts.parent(1)], [Some(1), None]);
        let extent = fronts.extent(0..2, 2);
        assert_eq!([extent.lower, extent.upper], [4 * 10 + 6 * 6, 4 * 6]);
        assert_eq!([extent.left, extent.waiting], [6 * 6, 1]);
        assert_eq!([extent.width, extent.height], [6, 6]);
    }

    #[test]
    fn the_stack_is_as_high_as_what_waits_at_the_same_time() {
        let fronts = Fronts {
            order: (0..6).collect(),
            places: (0..6).collect(),
            begins: vec![0, 1, 2, 3, 4, 6],
            starts: vec![0, 1, 3, 4, 6, 6],
            rows: vec![2, 2, 3, 3, 4, 5],
        };
        // The third takes up 1 and 2 · 2 numbers while it finds another, the fourth 1 while it finds 2 · 2.
        let extent = fronts.extent(0..5, 1);
        assert_eq!([extent.left, extent.waiting], [1 + 4 + 1, 2]);
    }

    // Minimum degree takes more on a large lattice.
    #[test]
    fn the_order_with_fewer_multiplications_is_taken() {
        let side = 80;
        let lattice = Pattern::new(side * side, |pair| {
            for at in 0..side * side {
                if at % side > 0 {
                    pair(at - 1, at);
                }
                if at >= side {
                    pair(at - side, at);
                }
            }
        });
        let by_degree = Fronts::ordered(&lattice, &dissection::by_degree(&lattice).unwrap());
        let taken = Fronts::new(&lattice).unwrap();
        assert!(taken.multiplications() < by_degree.multiplications());
    }

    #[test]
    fn children_come_first_and_the_last_of_them_right_before() {
        //    3        parents
        //   / \
        //  0   2      1 alone
        let parents = [3, NONE, 3, NONE];
        assert_eq!(postorder(&parents), [1, 0, 2, 3]);
        assert_eq!(postorder(&[2, NONE, 1]), [0, 2, 1]);
    }

    #[test]
    fn a_chain_fills_in_nowhere() {
        let unknowns = 40;
        let pattern = Pattern::new(unknowns, |pair| (1..unknowns).for_each(|b| pair(b - 1, b)));
        let fronts = Fronts::new(&pattern).unwrap();
        let extent = fronts.extent(0..fronts.len(), 1);
        assert_eq!(extent.lower + extent.upper, pattern.entries());
        for (place, &unknown) in fronts.order.iter().enumerate() {
            assert_eq!(fronts.places[unknown as usize] as usize, place);
        }
    }
}

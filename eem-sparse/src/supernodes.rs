//! The structure of the factors for a given order: which columns of L have the same rows, and which rows.
//!
//! ```text
//! elimination tree   the parent of a column is the first row below its diagonal in L   (Liu 1986)
//! row k of L         the paths in the tree from the neighbours before k, up to k       (Liu 1986)
//! supernode          consecutive columns, each the parent of the one before, of the same structure
//! ```
//!
//! See Davis, Direct Methods for Sparse Linear Systems, 2006, chapter 4. Supernodes are merged with their
//! parents if that stores few zeros (Ashcraft & Grimes 1989).

use core::mem;
use core::ops::Range;

use crate::compact::compact;
use crate::pattern::Pattern;

/// No column.
const NONE: u32 = u32::MAX;

/// Adjacent supernodes are merged if the result has at most so many own unknowns, and at most this share of
/// its entries is zero.
const MERGED: [(usize, f64); 2] = [(48, 0.1), (usize::MAX, 0.05)];

/// The place of each node in an order.
pub(crate) fn places(order: &[u32]) -> Vec<u32> {
    let mut places = vec![0; order.len()];
    for (place, &node) in order.iter().enumerate() {
        places[node as usize] = compact(place);
    }
    places
}

/// A pattern with its rows and columns in an order of elimination.
pub(crate) struct Ordered<'a> {
    pattern: &'a Pattern,
    order: &'a [u32],
    places: &'a [u32],
}

impl<'a> Ordered<'a> {
    pub(crate) fn new(pattern: &'a Pattern, order: &'a [u32], places: &'a [u32]) -> Self {
        Self {
            pattern,
            order,
            places,
        }
    }

    /// The places that share a block with a place, the place itself included.
    pub(crate) fn row(&self, place: usize) -> impl Iterator<Item = u32> {
        let row = self.pattern.row(self.order[place] as usize).iter();
        row.map(|&node| self.places[node as usize])
    }

    /// The parent of each column in the elimination tree, or `NONE`.
    pub(crate) fn tree(&self) -> Vec<u32> {
        let count = self.order.len();
        let mut parents = vec![NONE; count];
        // Some later column on the path from each column to its root.
        let mut ancestors = vec![NONE; count];
        for k in 0..compact(count) {
            for mut at in self.row(k as usize).filter(|&place| place < k) {
                while at != NONE && at != k {
                    let next = mem::replace(&mut ancestors[at as usize], k);
                    if next == NONE {
                        parents[at as usize] = k;
                    }
                    at = next;
                }
            }
        }
        parents
    }

    /// How many rows each column of L has below its diagonal.
    fn heights(&self, parents: &[Option<u32>]) -> Vec<u32> {
        // The latest row that each column was found in, and the number of such rows.
        let mut columns = vec![(NONE, 0); parents.len()];
        for k in 0..compact(parents.len()) {
            for first in self.row(k as usize).filter(|&place| place < k) {
                let mut next = Some(first);
                while let Some(at) = next.filter(|&at| at < k) {
                    let (latest, height) = &mut columns[at as usize];
                    if mem::replace(latest, k) == k {
                        break;
                    }
                    *height += 1;
                    next = parents[at as usize];
                }
            }
        }
        columns.into_iter().map(|(_, height)| height).collect()
    }

    /// The columns of each supernode, for an order that is a postorder of the tree with these parents.
    pub(crate) fn supernodes(&self, parents: &[Option<u32>]) -> Vec<Range<usize>> {
        let parent = |of: &Supernode| parents[of.columns.end - 1].map(|parent| parent as usize);
        let heights = self.heights(parents);
        let mut fundamental: Vec<Supernode> = Vec::new();
        for (column, &height) in heights.iter().enumerate() {
            let height = height as usize;
            match fundamental.last_mut() {
                Some(last) if parent(last) == Some(column) && last.height == height + 1 => {
                    last.columns.end += 1;
                    last.height = height;
                }
                _ => fundamental.push(Supernode {
                    columns: column..column + 1,
                    height,
                    zeros: 0,
                }),
            }
        }
        let mut merged: Vec<Supernode> = Vec::new();
        for mut supernode in fundamental {
            let child = merged.pop_if(|child| {
                let is_parent = parent(child).is_some_and(|place| place < supernode.columns.end);
                is_parent && self.are_worth_merging(child, &supernode)
            });
            if let Some(child) = child {
                supernode.zeros = child.zeros_with(&supernode);
                supernode.columns.start = child.columns.start;
            }
            merged.push(supernode);
        }
        merged.into_iter().map(|of| of.columns).collect()
    }

    /// Whether a supernode may be merged with its parent.
    #[expect(clippy::cast_precision_loss, reason = "shares are rough")]
    fn are_worth_merging(&self, child: &Supernode, parent: &Supernode) -> bool {
        let width = child.columns.len() + parent.columns.len();
        let entries = width * (width + 1) / 2 + width * parent.height;
        let zeros = child.zeros_with(parent);
        zeros == child.zeros + parent.zeros
            || MERGED.iter().any(|(most, share)| {
                width <= most / self.pattern.block_length()
                    && zeros as f64 <= share * entries as f64
            })
    }
}

/// Consecutive columns that are stored with the same rows.
struct Supernode {
    columns: Range<usize>,
    /// Rows below the columns.
    height: usize,
    /// Entries below the diagonal that are stored and zero.
    zeros: usize,
}

impl Supernode {
    /// The entries that are stored and zero after merging with the parent.
    fn zeros_with(&self, parent: &Self) -> usize {
        let rows = parent.columns.len() + parent.height;
        self.zeros + parent.zeros + (rows - self.height) * self.columns.len()
    }
}

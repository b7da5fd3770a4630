//! The factors of a matrix, front by front, and the substitutions that solve with them.

use crate::branch::{Branch, Memory, zeros};
use crate::definite::block_is_positive_definite;
use crate::division::Division;
use crate::fronts::{Front, Fronts};
use crate::gathering::Matrix;
use crate::threads;

/// L and U of all fronts, and the memory in which they are found.
#[derive(Debug)]
pub(crate) struct Factors {
    /// The columns of L of each front with its diagonal block, one front after the other.
    lower: Vec<f64>,
    /// The rows of U of each front to the right of its diagonal block.
    upper: Vec<f64>,
    /// For each row of a factored diagonal block, its row before the exchanges.
    pivots: Vec<u32>,
    /// The working memory of the elimination.
    root: Branch,
    /// Right-hand sides of one front.
    part: Vec<f64>,
}

impl Factors {
    /// Memory for the factors with blocks of this many rows; `None` if it cannot be allocated.
    pub(crate) fn new(fronts: &Fronts, length: usize) -> Option<Self> {
        let extent = fronts.extent(0..fronts.len(), length);
        Some(Self {
            lower: zeros(extent.lower)?,
            upper: zeros(extent.upper)?,
            pivots: vec![0; fronts.order.len() * length],
            root: Branch::new(fronts, Division::new(fronts, length), length)?,
            part: vec![0.0; extent.width.max(extent.height)],
        })
    }

    /// The number of entries of L and U.
    pub(crate) fn entries(&self) -> usize {
        self.lower.len() + self.upper.len()
    }

    /// Factors a matrix.
    pub(crate) fn factor<const L: usize>(&mut self, matrix: Matrix<'_, L>) {
        let memory = Memory {
            lower: &mut self.lower,
            upper: &mut self.upper,
            pivots: &mut self.pivots,
        };
        let root = &mut self.root;
        if root.has_parts() {
            threads::enter(|| root.factor(matrix, memory));
        } else {
            root.factor(matrix, memory);
        }
    }

    /// Whether the last matrix, if symmetric, was positive definite.
    pub(crate) fn are_of_positive_definite(&self, fronts: &Fronts, length: usize) -> bool {
        let (mut lower, mut work) = (0, Vec::new());
        (0..fronts.len()).map(|at| fronts.front(at)).all(|front| {
            let [width, height] = front.sizes(length);
            let columns = &self.lower[lower..][..width * (width + height)];
            let pivots = &self.pivots[front.own.start * length..][..width];
            lower += columns.len();
            block_is_positive_definite(columns, width + height, pivots, &mut work)
        })
    }

    /// Overwrites a right-hand side with the solution, both in the order of elimination.
    pub(crate) fn solve<const L: usize>(&mut self, fronts: &Fronts, x: &mut [[f64; L]]) {
        let (mut lower, mut upper) = (0, 0);
        for front in (0..fronts.len()).map(|at| fronts.front(at)) {
            let [width, height] = front.sizes(L);
            let columns = &self.lower[lower..][..width * (width + height)];
            let pivots = &self.pivots[front.own.start * L..][..width];
            let part = &mut self.part[..width.max(height)];
            forward(&front, (columns, pivots), x, part);
            lower += columns.len();
            upper += width * height;
        }
        for front in (0..fronts.len()).rev().map(|at| fronts.front(at)) {
            let [width, height] = front.sizes(L);
            lower -= width * (width + height);
            upper -= width * height;
            let columns = &self.lower[lower..][..width * (width + height)];
            backward(&front, columns, &self.upper[upper..], x);
        }
    }
}

/// Forward substitution with L of a front.
fn forward<const L: usize>(
    front: &Front<'_>,
    (columns, pivots): (&[f64], &[u32]),
    x: &mut [[f64; L]],
    part: &mut [f64],
) {
    let [width, height] = front.sizes(L);
    let (head, later) = x.split_at_mut(front.own.end);
    let own = head[front.own.start..].as_flattened_mut();
    part[..width].copy_from_slice(own);
    for (x, &pivot) in own.iter_mut().zip(pivots) {
        *x = part[pivot as usize];
    }
    let part = &mut part[..height];
    part.fill(0.0);
    for (k, column) in columns.chunks_exact(width + part.len()).enumerate() {
        let (diagonal, below) = column.split_at(width);
        let solved = own[k];
        for (x, l) in own[k + 1..].iter_mut().zip(&diagonal[k + 1..]) {
            *x -= l * solved;
        }
        for (sum, l) in part.iter_mut().zip(below) {
            *sum += l * solved;
        }
    }
    for (&row, sums) in front.rows.iter().zip(part.as_chunks::<L>().0) {
        let node = &mut later[row as usize - front.own.end];
        for (x, sum) in node.iter_mut().zip(sums) {
            *x -= sum;
        }
    }
}

/// Backward substitution with U of a front.
fn backward<const L: usize>(front: &Front<'_>, columns: &[f64], upper: &[f64], x: &mut [[f64; L]]) {
    let [width, height] = front.sizes(L);
    let tall = width + height;
    let (head, later) = x.split_at_mut(front.own.end);
    let own = head[front.own.start..].as_flattened_mut();
    let columns_of_nodes = upper.chunks_exact(width * L);
    for (&row, columns) in front.rows.iter().zip(columns_of_nodes) {
        let node = &later[row as usize - front.own.end];
        for (&solved, column) in node.iter().zip(columns.chunks_exact(width)) {
            for (x, u) in own.iter_mut().zip(column) {
                *x -= u * solved;
            }
        }
    }
    for (k, column) in columns.chunks_exact(tall).enumerate().rev() {
        let solved = own[k] / column[k];
        own[k] = solved;
        for (x, u) in own[..k].iter_mut().zip(column) {
            *x -= u * solved;
        }
    }
}

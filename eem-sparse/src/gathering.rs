//! The dense blocks of a front before its elimination: entries of the matrix, and the Schur
//! complements of earlier fronts.

use core::ops::Range;

use crate::elimination::Blocks;
use crate::fronts::{Front, Fronts};
use crate::pattern::Pattern;

/// The matrix to factor, with blocks of `L` rows.
#[derive(Clone, Copy)]
pub(crate) struct Matrix<'a, const L: usize> {
    pub(crate) fronts: &'a Fronts,
    pub(crate) pattern: &'a Pattern,
    /// Block by block, each row by row.
    pub(crate) values: &'a [f64],
}

impl<const L: usize> Matrix<'_, L> {
    /// The blocks of a node, each with the node of its columns, ascending.
    #[inline]
    pub(crate) fn blocks_of(&self, node: usize) -> impl Iterator<Item = (usize, &[[f64; L]; L])> {
        let columns = self.pattern.row(node).iter();
        let blocks = self.pattern.blocks(node);
        columns
            .zip(blocks)
            .map(|(&column, at)| (column as usize, self.block(at)))
    }

    /// The block of this number.
    #[inline]
    pub(crate) fn block(&self, at: usize) -> &[[f64; L]; L] {
        &self.values.as_chunks().0.as_chunks().0[at]
    }
}

/// The rows of the current front, counted in nodes, that places of the order of elimination have.
#[derive(Debug)]
pub(crate) struct Rows {
    /// The first place of the branch.
    first: usize,
    /// The row of each place from there on; empty if rows are found by search.
    noted: Vec<u32>,
}

impl Rows {
    /// A table for the own places of a branch. Places outside of it are found by search.
    pub(crate) fn new(places: Range<usize>) -> Self {
        Self {
            first: places.start,
            noted: vec![0; places.len()],
        }
    }

    /// Writes the rows of a front to the table.
    pub(crate) fn note(&mut self, front: &Front<'_>) {
        let places = front
            .own
            .clone()
            .chain(front.rows.iter().map(|&row| row as usize));
        for (row, place) in (0..).zip(places) {
            match self.noted.get_mut(place.wrapping_sub(self.first)) {
                Some(noted) => *noted = row,
                None => break,
            }
        }
    }

    /// The row of a place in the front, by the table or by search.
    #[inline]
    pub(crate) fn of(&self, place: usize, front: &Front<'_>) -> usize {
        match self.noted.get(place.wrapping_sub(self.first)) {
            Some(&row) => row as usize,
            None if place < front.own.end => place - front.own.start,
            None => front.own.len() + front.rows.partition_point(|&row| (row as usize) < place),
        }
    }
}

/// Writes the rows and columns of the own unknowns of a front, as far as they are not eliminated yet.
pub(crate) fn gather<const L: usize>(
    blocks: &mut Blocks<'_>,
    front: &Front<'_>,
    rows: &Rows,
    matrix: &Matrix<'_, L>,
) {
    let Matrix {
        fronts, pattern, ..
    } = *matrix;
    let [width, height] = front.sizes(L);
    let tall = width + height;
    for (own, place) in front.own.clone().enumerate() {
        let (own, node) = (own * L, fronts.order[place] as usize);
        for (other, block) in matrix.blocks_of(node) {
            let place = fronts.places[other] as usize;
            if place < front.own.start {
                continue;
            }
            let row = rows.of(place, front) * L;
            if row < width {
                write::<L>(block, &mut blocks.lower[row * tall..], (own, tall));
                continue;
            }
            let right = &mut blocks.upper[(row - width) * width..];
            write::<L>(block, right, (own, width));
            if let Some(mirror) = pattern.block(other, node) {
                let below = &mut blocks.lower[own * tall..];
                write::<L>(matrix.block(mirror), below, (row, tall));
            }
        }
    }
}

/// Writes a block at the given row of the first `L` columns, which have `tall` rows each.
#[inline]
fn write<const L: usize>(block: &[[f64; L]; L], columns: &mut [f64], (row, tall): (usize, usize)) {
    for (row, entries) in (row..).zip(block) {
        for (column, entry) in entries.iter().enumerate() {
            columns[column * tall + row] = *entry;
        }
    }
}

/// Adds a Schur complement from below; `targets` are its rows and columns in this front, ascending.
pub(crate) fn add(blocks: &mut Blocks<'_>, targets: &[u32], left: &[f64]) {
    let width = blocks.pivots.len();
    let tall = blocks.lower.len() / width;
    let own = targets.partition_point(|&target| (target as usize) < width);
    let (inner, outer) = targets.split_at(own);
    let mut columns = left.chunks_exact(targets.len());
    for (&target, column) in inner.iter().zip(&mut columns) {
        let to = &mut blocks.lower[target as usize * tall..][..tall];
        for (&row, entry) in targets.iter().zip(column) {
            to[row as usize] += entry;
        }
    }
    let height = tall - width;
    for (&target, column) in outer.iter().zip(columns) {
        let target = target as usize - width;
        let to = &mut blocks.upper[target * width..][..width];
        for (&row, entry) in inner.iter().zip(column) {
            to[row as usize] += entry;
        }
        let to = &mut blocks.schur[target * height..][..height];
        for (&row, entry) in outer.iter().zip(&column[own..]) {
            to[row as usize - width] += entry;
        }
    }
}

//! What a front consists of before its elimination: entries of the matrix, and what earlier fronts left.

use core::ops::Range;

use super::elimination::Blocks;
use super::fronts::{Front, Fronts};
use crate::pattern::Pattern;
use crate::scalar::Real;

/// What is factored, in runs of `L` unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Matrix<'a, S, const L: usize> {
    pub(super) fronts: &'a Fronts,
    pub(super) pattern: &'a Pattern,
    /// Block by block, each row by row.
    pub(super) values: &'a [S],
}

impl<S, const L: usize> Matrix<'_, S, L> {
    /// The blocks of a run, each with the run that it shares, ascending.
    #[inline]
    pub(super) fn blocks_of(&self, run: usize) -> impl Iterator<Item = (usize, &[[S; L]; L])> {
        let columns = self.pattern.row(run).iter();
        let blocks = self.pattern.blocks(run);
        columns
            .zip(blocks)
            .map(|(&column, at)| (column as usize, self.block(at)))
    }

    /// A block.
    #[inline]
    fn block(&self, at: usize) -> &[[S; L]; L] {
        &self.values.as_chunks().0.as_chunks().0[at]
    }
}

/// The rows of the front at work, counted in runs.
#[derive(Debug)]
pub(super) struct Rows {
    /// The first place of the branch,
    first: usize,
    /// and the row of each of its places; empty if there are so few fronts that it may be looked for.
    noted: Vec<u32>,
}

impl Rows {
    /// For fronts whose own runs have these places, or any.
    pub(super) fn new(places: Range<usize>) -> Self {
        Self {
            first: places.start,
            noted: vec![0; places.len()],
        }
    }

    pub(super) fn note(&mut self, front: &Front<'_>) {
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

    /// The row of a place in the front.
    #[inline]
    pub(super) fn of(&self, place: usize, front: &Front<'_>) -> usize {
        match self.noted.get(place.wrapping_sub(self.first)) {
            Some(&row) => row as usize,
            None if place < front.own.end => place - front.own.start,
            None => front.own.len() + front.rows.partition_point(|&row| (row as usize) < place),
        }
    }
}

/// Adds the entries of the matrix that belong to the own unknowns of a front.
pub(super) fn gather<S: Real, const L: usize>(
    blocks: &mut Blocks<'_>,
    front: &Front<'_>,
    rows: &Rows,
    matrix: &Matrix<'_, S, L>,
) {
    let Matrix {
        fronts, pattern, ..
    } = *matrix;
    let [width, height] = front.sizes(L);
    let tall = width + height;
    for (own, place) in front.own.clone().enumerate() {
        let (own, run) = (own * L, fronts.order[place] as usize);
        for (other, block) in matrix.blocks_of(run) {
            let place = fronts.places[other] as usize;
            if place < front.own.start {
                continue;
            }
            let row = rows.of(place, front) * L;
            if row < width {
                write(block, &mut blocks.lower[row * tall..], (own, tall));
                continue;
            }
            let right = &mut blocks.upper[(row - width) * width..];
            write(block, right, (own, width));
            if let Some(mirror) = pattern.block(other, run) {
                let below = &mut blocks.lower[own * tall..];
                write(matrix.block(mirror), below, (row, tall));
            }
        }
    }
}

/// Writes a block from the given row of the first columns on, which are so tall.
#[inline]
fn write<S: Real, const L: usize>(
    block: &[[S; L]; L],
    columns: &mut [f64],
    (row, tall): (usize, usize),
) {
    for (row, entries) in (row..).zip(block) {
        for (column, entry) in entries.iter().enumerate() {
            columns[column * tall + row] = entry.to_f64();
        }
    }
}

/// Adds what an earlier front has left to the rows and columns of these numbers.
pub(super) fn add(blocks: &mut Blocks<'_>, targets: &[u32], left: &[f64]) {
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

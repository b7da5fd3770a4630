//! What a front consists of before its elimination: entries of the matrix, and what earlier fronts left.

use core::ops::Range;

use super::elimination::Blocks;
use super::fronts::{Front, Fronts};
use crate::pattern::Pattern;
use crate::scalar::Real;

/// What is factored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Matrix<'a, S> {
    pub(super) fronts: &'a Fronts,
    pub(super) pattern: &'a Pattern,
    /// Unknowns in a run.
    pub(super) length: usize,
    /// Block by block.
    pub(super) values: &'a [S],
}

impl<S> Matrix<'_, S> {
    /// Names the columns and values of the entries of a row, ascending.
    #[inline]
    pub(super) fn each_in_row(&self, row: usize, mut visit: impl FnMut(usize, &S)) {
        let (length, run) = (self.length, row / self.length);
        for (at, &column) in self.pattern.blocks(run).zip(self.pattern.row(run)) {
            let entries = &self.block(at)[row % length * length..][..length];
            for (column, value) in (column as usize * length..).zip(entries) {
                visit(column, value);
            }
        }
    }

    /// A block, row by row.
    #[inline]
    fn block(&self, at: usize) -> &[S] {
        let square = self.length * self.length;
        &self.values[at * square..][..square]
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
pub(super) fn gather<S: Real>(
    blocks: &mut Blocks<'_>,
    front: &Front<'_>,
    rows: &Rows,
    matrix: &Matrix<'_, S>,
) {
    let Matrix {
        fronts,
        pattern,
        length,
        ..
    } = *matrix;
    let [width, height] = front.sizes(length);
    let tall = width + height;
    for (own, place) in front.own.clone().enumerate() {
        let (own, run) = (own * length, fronts.order[place] as usize);
        for (at, &other) in pattern.blocks(run).zip(pattern.row(run)) {
            let place = fronts.places[other as usize] as usize;
            if place < front.own.start {
                continue;
            }
            let row = rows.of(place, front) * length;
            if row < width {
                transpose(matrix.block(at), length, &mut blocks.lower[row * tall..], (own, tall));
                continue;
            }
            let right = &mut blocks.upper[(row - width) * width..];
            transpose(matrix.block(at), length, right, (own, width));
            if let Some(mirror) = pattern.block(other as usize, run) {
                let below = &mut blocks.lower[own * tall..];
                transpose(matrix.block(mirror), length, below, (row, tall));
            }
        }
    }
}

/// Writes a block, row by row, to the given row of the first columns, which are so tall.
#[inline]
fn transpose<S: Real>(
    block: &[S],
    length: usize,
    columns: &mut [f64],
    (row, tall): (usize, usize),
) {
    for (at, entries) in block.chunks_exact(length).enumerate() {
        for (column, entry) in entries.iter().enumerate() {
            columns[column * tall + row + at] = entry.to_f64();
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

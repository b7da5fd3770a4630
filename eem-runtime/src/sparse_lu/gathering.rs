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
    pub(super) values: &'a [S],
}

/// The rows of the front at work.
#[derive(Debug)]
pub(super) struct Rows {
    /// The first place of the branch,
    first: usize,
    /// and the row of each of its places; empty if there are so few fronts that it may be looked for.
    noted: Vec<u32>,
}

impl Rows {
    /// For fronts whose own unknowns have these places, or any.
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
        values,
    } = *matrix;
    let width = front.own.len();
    let tall = width + front.rows.len();
    for (own, place) in front.own.clone().enumerate() {
        let unknown = fronts.order[place] as usize;
        for (&other, value) in pattern
            .row(unknown)
            .iter()
            .zip(&values[pattern.places(unknown)])
        {
            let place = fronts.places[other as usize] as usize;
            if place < front.own.start {
                continue;
            }
            let other_row = rows.of(place, front);
            if other_row < width {
                blocks.lower[other_row * tall + own] = value.to_f64();
                continue;
            }
            blocks.upper[(other_row - width) * width + own] = value.to_f64();
            if let Some(mirror) = pattern.position(other as usize, unknown) {
                blocks.lower[own * tall + other_row] = values[mirror].to_f64();
            }
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

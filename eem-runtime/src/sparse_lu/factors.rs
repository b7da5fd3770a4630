//! Factors of a matrix, front by front, and what solves with them.
//!
//! The multifrontal method (Duff & Reid 1983): a front gathers the entries of its own unknowns and
//! what the fronts that contribute to it have left, eliminates its own unknowns as dense blocks, and
//! leaves the rest to the next one. What is left lies on a stack.

use super::elimination::{Blocks, Scratch};
use super::fronts::{Front, Fronts};
use crate::pattern::{Pattern, index};
use crate::scalar::Real;

/// L and U of all fronts, and the memory in which they are found.
#[derive(Debug)]
pub(super) struct Factors {
    /// The columns of each front, one front after the other.
    lower: Vec<f64>,
    /// Its rows to the right of its diagonal block.
    upper: Vec<f64>,
    /// For each place, the pivot among the own unknowns of its front.
    pivots: Vec<u32>,
    /// What the fronts that wait have left, the last one on top.
    left: Vec<f64>,
    waiting: Vec<u32>,
    /// The row of each place in the front at work.
    local: Vec<u32>,
    /// The same for the rows of a front that contributes.
    targets: Vec<u32>,
    scratch: Scratch,
    /// Part of a solution.
    part: Vec<f64>,
}

impl Factors {
    /// Memory for the factors; `None` if it is missing.
    pub(super) fn new(fronts: &Fronts) -> Option<Self> {
        let unknowns = fronts.order.len();
        let extent = fronts.extent();
        Some(Self {
            lower: zeros(extent.lower)?,
            upper: zeros(extent.upper)?,
            pivots: vec![0; unknowns],
            left: zeros(extent.left)?,
            waiting: Vec::with_capacity(extent.waiting),
            local: vec![0; unknowns],
            targets: vec![0; extent.height],
            scratch: Scratch::new(extent.width)?,
            part: vec![0.0; extent.width.max(extent.height)],
        })
    }

    /// Factors the matrix with these entries.
    pub(super) fn factor<S: Real>(&mut self, fronts: &Fronts, pattern: &Pattern, values: &[S]) {
        let (mut lower, mut upper, mut left) = (0, 0, 0);
        for at in 0..fronts.len() {
            let front = fronts.front(at);
            let (width, height) = (front.own.len(), front.rows.len());
            let places = front.own.clone().map(index);
            for (local, place) in places.chain(front.rows.iter().copied()).enumerate() {
                self.local[place as usize] = index(local);
            }
            let (waiting, free) = self.left.split_at_mut(left);
            let mut blocks = Blocks {
                lower: &mut self.lower[lower..][..width * (width + height)],
                upper: &mut self.upper[upper..][..width * height],
                schur: &mut free[..height * height],
                pivots: &mut self.pivots[front.own.clone()],
            };
            blocks.clear();
            gather(&mut blocks, &front, &self.local, fronts, pattern, values);
            let mut bottom = left;
            while let Some(child) = self
                .waiting
                .last()
                .map(|&child| fronts.front(child as usize))
                && child.contributes_to(&front)
            {
                self.waiting.pop();
                let targets = &mut self.targets[..child.rows.len()];
                for (target, &place) in targets.iter_mut().zip(child.rows) {
                    *target = self.local[place as usize];
                }
                bottom -= targets.len() * targets.len();
                add(&mut blocks, targets, &waiting[bottom..]);
            }
            blocks.eliminate(&mut self.scratch);
            if height > 0 {
                self.waiting.push(index(at));
            }
            if bottom < left {
                self.left.copy_within(left..left + height * height, bottom);
            }
            left = bottom + height * height;
            lower += width * (width + height);
            upper += width * height;
        }
    }

    /// Overwrites a right-hand side, in the order of elimination, with the solution.
    pub(super) fn solve(&mut self, fronts: &Fronts, x: &mut [f64]) {
        let (mut lower, mut upper) = (0, 0);
        for front in (0..fronts.len()).map(|at| fronts.front(at)) {
            let (width, height) = (front.own.len(), front.rows.len());
            let columns = &self.lower[lower..][..width * (width + height)];
            let pivots = &self.pivots[front.own.clone()];
            forward(&front, columns, pivots, x, &mut self.part);
            lower += columns.len();
            upper += width * height;
        }
        for front in (0..fronts.len()).rev().map(|at| fronts.front(at)) {
            let (width, height) = (front.own.len(), front.rows.len());
            lower -= width * (width + height);
            upper -= width * height;
            let columns = &self.lower[lower..][..width * (width + height)];
            backward(&front, columns, &self.upper[upper..], x);
        }
    }
}

/// Adds the entries of the matrix that belong to the own unknowns of a front.
fn gather<S: Real>(
    blocks: &mut Blocks<'_>,
    front: &Front<'_>,
    local: &[u32],
    fronts: &Fronts,
    pattern: &Pattern,
    values: &[S],
) {
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
            let other_row = local[place] as usize;
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
fn add(blocks: &mut Blocks<'_>, targets: &[u32], left: &[f64]) {
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

/// Solves with L of a front.
fn forward(front: &Front<'_>, columns: &[f64], pivots: &[u32], x: &mut [f64], part: &mut [f64]) {
    let width = front.own.len();
    let (head, later) = x.split_at_mut(front.own.end);
    let own = &mut head[front.own.start..];
    let part = &mut part[..width.max(front.rows.len())];
    part[..width].copy_from_slice(own);
    for (x, &pivot) in own.iter_mut().zip(pivots) {
        *x = part[pivot as usize];
    }
    let part = &mut part[..front.rows.len()];
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
    for (&row, sum) in front.rows.iter().zip(part) {
        later[row as usize - front.own.end] -= *sum;
    }
}

/// Solves with U of a front.
fn backward(front: &Front<'_>, columns: &[f64], upper: &[f64], x: &mut [f64]) {
    let width = front.own.len();
    let tall = width + front.rows.len();
    let (head, later) = x.split_at_mut(front.own.end);
    let own = &mut head[front.own.start..];
    for (&row, column) in front.rows.iter().zip(upper.chunks_exact(width)) {
        let solved = later[row as usize - front.own.end];
        for (x, u) in own.iter_mut().zip(column) {
            *x -= u * solved;
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

/// That many zeros, if there is memory.
fn zeros(count: usize) -> Option<Vec<f64>> {
    let mut zeros = Vec::new();
    zeros.try_reserve_exact(count).ok()?;
    zeros.resize(count, 0.0);
    Some(zeros)
}

//! Matrices with known solutions: all entries and unknowns are small integers, so that right-hand
//! sides have no rounding error.

#![allow(dead_code, reason = "every test file uses its own part of this module")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use eem_sparse::{Error, Pattern, Report, Solver};

/// Small integers that depend on the seed alone (xorshift; Marsaglia 2003).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// An integer between 0 and `most`.
    pub(crate) fn up_to(&mut self, most: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        u32::try_from(self.0 >> 33).unwrap() % (most + 1)
    }

    /// An integer between −4 and 4.
    pub(crate) fn digit(&mut self) -> f64 {
        f64::from(self.up_to(8)) - 4.0
    }
}

/// A pattern with values.
pub(crate) struct Matrix {
    pub(crate) pattern: Pattern,
    /// Row, column, entry.
    pub(crate) entries: Vec<(usize, usize, f64)>,
}

impl Matrix {
    /// Fills a pattern: `entry` is asked for every place in the order of rows and columns of blocks.
    pub(crate) fn new(
        pattern: Pattern,
        neighbours: impl Fn(usize) -> Vec<usize>,
        mut entry: impl FnMut(usize, usize) -> f64,
    ) -> Self {
        let length = pattern.block_length();
        let mut entries = Vec::with_capacity(pattern.entries());
        for row in 0..pattern.unknowns() {
            for node in neighbours(row / length) {
                for column in node * length..(node + 1) * length {
                    entries.push((row, column, entry(row, column)));
                }
            }
        }
        Self { pattern, entries }
    }

    /// Makes each diagonal entry the sum of the magnitudes of its row, plus 1: then the largest row sum of
    /// the inverse is at most 1 (Varah 1975).
    pub(crate) fn dominant(mut self) -> Self {
        let mut sums = vec![1.0; self.pattern.unknowns()];
        for (row, column, entry) in &self.entries {
            if row != column {
                sums[*row] += entry.abs();
            }
        }
        for (row, column, entry) in &mut self.entries {
            if row == column {
                *entry = sums[*row];
            }
        }
        self
    }

    pub(crate) fn values(&self) -> Vec<f64> {
        let mut values = vec![0.0; self.pattern.entries()];
        for &(row, column, entry) in &self.entries {
            values[self.pattern.position(row, column).unwrap()] = entry;
        }
        values
    }

    /// `A x`.
    pub(crate) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut b = vec![0.0; x.len()];
        for &(row, column, entry) in &self.entries {
            b[row] += entry * x[column];
        }
        b
    }

    /// `|A| |x| + |b|`.
    pub(crate) fn sizes(&self, x: &[f64], b: &[f64]) -> Vec<f64> {
        let mut sizes: Vec<f64> = b.iter().map(|b| b.abs()).collect();
        for &(row, column, entry) in &self.entries {
            sizes[row] += (entry * x[column]).abs();
        }
        sizes
    }

    /// The solution for a right-hand side.
    pub(crate) fn solve(&self, b: &[f64]) -> Result<(Vec<f64>, Report), Error> {
        let mut right: Vec<[f64; 1]> = b.iter().map(|&b| [b]).collect();
        let values = self.values();
        let report = Solver::new(&self.pattern)?
            .factor(&values)?
            .solve(&mut right)?;
        Ok((right.into_iter().flatten().collect(), report))
    }

    /// The largest error of a solution of integers, and what the solver did.
    pub(crate) fn error(&self, seed: u64) -> (f64, Report) {
        let mut random = Random::new(seed);
        let exact: Vec<f64> = (0..self.pattern.unknowns())
            .map(|_| random.digit())
            .collect();
        let (x, report) = self.solve(&self.times(&exact)).unwrap();
        let errors = x.iter().zip(&exact).map(|(x, exact)| (x - exact).abs());
        (errors.fold(0.0, f64::max), report)
    }
}

/// The nodes of a box within a distance of one in every direction: 9 in the plane, 27 in space.
pub(crate) fn stencil([a, b, c]: [usize; 3]) -> impl Fn(usize) -> Vec<usize> + Clone {
    let around = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
    move |node| {
        let mut near = Vec::new();
        for k in around(node / (a * b), c) {
            for j in around(node / a % b, b) {
                near.extend(around(node % a, a).map(|i| (k * b + j) * a + i));
            }
        }
        near
    }
}

/// The pattern in which every node has blocks with its neighbours.
pub(crate) fn pattern(
    nodes: usize,
    length: usize,
    neighbours: impl Fn(usize) -> Vec<usize>,
) -> Pattern {
    let pattern = Pattern::new(nodes, |pair| {
        for node in 0..nodes {
            for other in neighbours(node) {
                pair(node, other);
            }
        }
    });
    pattern.in_blocks(length).unwrap()
}

/// A box of nodes with random unsymmetric entries, diagonally dominant.
pub(crate) fn lattice(sides: [usize; 3], length: usize) -> Matrix {
    let near = stencil(sides);
    let pattern = pattern(sides.iter().product(), length, near.clone());
    let mut random = Random::new(pattern.unknowns() as u64);
    Matrix::new(pattern, near, |_, _| random.digit()).dominant()
}

/// Random pairs of nodes, `degree` for each, as a symmetric list of neighbours.
pub(crate) fn random_graph(nodes: usize, degree: usize, seed: u64) -> Vec<Vec<usize>> {
    let mut random = Random::new(seed);
    let mut graph: Vec<Vec<usize>> = (0..nodes).map(|node| vec![node]).collect();
    for node in 0..nodes {
        for _ in 0..degree {
            let other = random.up_to(u32::try_from(nodes - 1).unwrap()) as usize;
            if !graph[node].contains(&other) {
                graph[node].push(other);
                graph[other].push(node);
            }
        }
    }
    for near in &mut graph {
        near.sort_unstable();
    }
    graph
}

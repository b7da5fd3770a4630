//! The numbers of the elimination on fronts that are far larger than what loops eliminate.
//!
//! Refinement would repair an elimination with a small mistake, so every test asserts that there was
//! none.

#![allow(clippy::float_cmp, reason = "numbers that are compared are exact")]

use crate::support::{Matrix, Random, lattice, pattern, random_graph, stencil};
use eem_sparse::{Report, Solver};
use nalgebra::{DMatrix, DVector};

/// The backward error that the solver grants to rows with at most 255 entries.
const BACKWARD_ERROR: f64 = 256.0 * f64::EPSILON;

/// `|x − exact| ≤ ‖A⁻¹‖ max |b − A x|`, where the inverse of a dominant matrix is at most 1 and the
/// residual is a backward error times `|A| |x| + |b| ≤ 2 · 4 · (2 · row sum)`.
fn tolerance(matrix: &Matrix) -> f64 {
    let largest = matrix.entries.iter().map(|(.., entry)| entry.abs());
    BACKWARD_ERROR * 16.0 * largest.fold(0.0, f64::max)
}

fn is_solved_without_help(matrix: &Matrix) {
    let (error, report) = matrix.error(7);
    assert_eq!(report, Report::default());
    assert!(error <= tolerance(matrix), "{error:e}");
}

#[test]
fn lattices_in_the_plane_need_no_refinement() {
    is_solved_without_help(&lattice([60, 60, 1], 1));
    is_solved_without_help(&lattice([40, 30, 1], 2));
    is_solved_without_help(&lattice([20, 25, 1], 3));
}

#[test]
fn lattices_in_space_need_no_refinement() {
    is_solved_without_help(&lattice([12, 12, 12], 1));
    is_solved_without_help(&lattice([7, 8, 9], 2));
    is_solved_without_help(&lattice([8, 7, 8], 3));
}

#[test]
fn random_patterns_need_no_refinement() {
    for seed in 1..=3 {
        let graph = random_graph(700, 3, seed);
        let neighbours = |node: usize| graph[node].clone();
        let mut random = Random::new(seed);
        let pattern = pattern(700, 1, neighbours);
        let matrix = Matrix::new(pattern, neighbours, |_, _| random.digit()).dominant();
        is_solved_without_help(&matrix);
    }
}

// A full matrix is a single front, whose pivots may be anywhere.
#[test]
fn a_full_matrix_is_solved_as_by_dense_elimination() {
    let nodes = 150;
    let all = move |_| (0..nodes).collect::<Vec<_>>();
    let mut random = Random::new(3);
    let matrix = Matrix::new(pattern(nodes, 1, all), all, |_, _| random.digit() + 0.5);
    let dense = DMatrix::from_fn(nodes, nodes, |row, column| {
        matrix.entries[row * nodes + column].2
    });
    let b: Vec<f64> = (0..nodes).map(|_| random.digit()).collect();
    let expected = dense.lu().solve(&DVector::from_column_slice(&b)).unwrap();
    let (x, report) = matrix.solve(&b).unwrap();
    assert_eq!(report, Report::default());
    let size = x.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (row, x) in x.iter().enumerate() {
        // Condition number some hundreds.
        assert!((x - expected[row]).abs() <= 1e4 * f64::EPSILON * size);
    }
}

// Every diagonal entry is zero; the pivots are beside them in the same block.
#[test]
fn zero_diagonals_within_blocks_need_no_refinement() {
    let sides = [25, 25, 1];
    let near = stencil(sides);
    let mut random = Random::new(5);
    let entry = |row: usize, column: usize| match (row / 2 == column / 2, row == column) {
        (true, true) => 0.0,
        (true, false) => 90.0 + random.digit(),
        _ => random.digit(),
    };
    let matrix = Matrix::new(pattern(625, 2, near.clone()), near, entry);
    is_solved_without_help(&matrix);
}

#[test]
fn columns_of_x_and_later_matrices_are_independent() {
    let matrix = lattice([20, 20, 2], 1);
    let mut values = matrix.values();
    let mut solver = Solver::new(&matrix.pattern).unwrap();
    let x: Vec<f64> = (0..800).map(|row| f64::from(row % 7) - 3.0).collect();
    let y: Vec<f64> = (0..800).map(|row| f64::from(row % 5) - 1.0).collect();
    for scale in [1.0, 2.0] {
        let b = matrix.times(&x).into_iter().zip(matrix.times(&y));
        let mut right: Vec<[f64; 2]> = b.map(|(b, c)| [b * scale, c * scale]).collect();
        let report = solver.factor(&values).unwrap().solve(&mut right);
        assert_eq!(report, Ok(Report::default()));
        for (row, found) in right.iter().enumerate() {
            assert!((found[0] - x[row]).abs() <= tolerance(&matrix));
            assert!((found[1] - y[row]).abs() <= tolerance(&matrix));
        }
        for value in &mut values {
            *value *= 2.0;
        }
    }
}

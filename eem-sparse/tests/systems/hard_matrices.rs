//! Matrices that the elimination alone does not solve: each is solved within the bound by refinement or
//! pivoting, or it is an error.

#![allow(clippy::float_cmp, reason = "numbers that are compared are exact")]

use std::cmp::Ordering;

use crate::support::{Matrix, Random, lattice, pattern, random_graph, stencil};
use eem_sparse::{Error, Operand, Pattern, Report, Solver};

/// For condition numbers below 100.
const TOLERANCE: f64 = 1e4 * f64::EPSILON;

/// A cycle of unknowns with these entries on the diagonal and in both directions around it.
fn cycle(unknowns: usize, [diagonal, forth, back]: [f64; 3]) -> Matrix {
    let near = move |node: usize| {
        vec![
            (node + unknowns - 1) % unknowns,
            node,
            (node + 1) % unknowns,
        ]
    };
    Matrix::new(pattern(unknowns, 1, near), near, |row, column| {
        if row == column {
            diagonal
        } else if column == (row + 1) % unknowns {
            forth
        } else {
            back
        }
    })
}

/// A cycle of blocks, those on the diagonal scaled. Without its largest entry a row has at most a sum of
/// 0.7 and the scale, so the condition number is below 10.
fn cycle_of_blocks(nodes: usize, length: usize, scale: f64) -> Matrix {
    let near = move |node: usize| vec![(node + nodes - 1) % nodes, node, (node + 1) % nodes];
    Matrix::new(pattern(nodes, length, near), near, |row, column| {
        let forth = (row / length + 1) % nodes == column / length;
        let order = (row % length).cmp(&(column % length));
        match (row / length == column / length, forth, order) {
            (true, _, Ordering::Equal) => scale,
            (true, ..) => 0.3 * scale,
            (_, true, Ordering::Equal) => 1.0,
            (_, true, Ordering::Less) => -0.1,
            (_, true, Ordering::Greater) => 0.2,
            _ => 0.1,
        }
    })
}

#[test]
fn pivots_near_the_diagonal_need_no_others() {
    let (error, report) = cycle(100, [4.0, -1.0, 2.0]).error(1);
    assert!(error <= TOLERANCE);
    assert_eq!(report, Report::default());
}

// Nearly a permutation: every pivot that the pattern expects is tiny.
#[test]
fn pivots_far_from_the_diagonal_are_found() {
    let (error, report) = cycle(101, [1e-30, 1.0, 0.1]).error(1);
    assert!(error <= TOLERANCE);
    assert_eq!(report.fallbacks, 1);
}

// The same for blocks, whose entries pivoting takes one by one.
#[test]
fn pivots_in_blocks_far_from_the_diagonal_are_found() {
    for length in [2, 3] {
        let (error, report) = cycle_of_blocks(41, length, 1e-30).error(1);
        assert!(error <= TOLERANCE, "{error:e}");
        assert_eq!(report.fallbacks, 1);
    }
}

#[test]
fn a_matrix_after_a_hard_one_is_eliminated_by_fronts_again() {
    let (hard, easy) = (cycle(101, [1e-30, 1.0, 0.1]), cycle(101, [4.0, -1.0, 2.0]));
    let mut solver = Solver::new(&hard.pattern).unwrap();
    for (matrix, fallbacks) in [(&hard, 2), (&easy, 0), (&hard, 2)] {
        let values = matrix.values();
        let mut right = vec![[1.0, 3.0]; 101];
        let report = solver.factor(&values).unwrap().solve(&mut right).unwrap();
        assert_eq!(report.fallbacks, fallbacks);
        let x: Vec<f64> = right.iter().map(|x| x[0]).collect();
        assert!(
            matrix
                .times(&x)
                .iter()
                .all(|b| (b - 1.0).abs() <= TOLERANCE)
        );
    }
}

// Pivots are 100,000 times smaller than the entries beside them, but the cycle is short.
#[test]
fn lost_digits_are_refined() {
    for (nodes, length) in [(8, 1), (8, 2), (5, 3)] {
        let (error, report) = cycle_of_blocks(nodes, length, 1e-5).error(2);
        assert!(error <= TOLERANCE, "{error:e}");
        assert!(report.refinements > 0, "{report:?}");
        assert_eq!(report.fallbacks, 0);
    }
}

#[test]
fn refinements_of_all_columns_are_counted() {
    let matrix = cycle_of_blocks(5, 1, 1e-5);
    let mut solver = Solver::new(&matrix.pattern).unwrap();
    let values = matrix.values();
    let mut factored = solver.factor(&values).unwrap();
    let b = [1.0, -3.0, 2.0, 4.0, 0.0];
    let one = factored.solve(&mut b.map(|b| [b])).unwrap();
    let three = factored.solve(&mut b.map(|b| [b; 3])).unwrap();
    assert!(one.refinements > 0);
    assert_eq!(three.refinements, 3 * one.refinements);
}

// The cycle needs pivots far from the diagonal. The triangle below a full last column needs none, but its
// factors grow by nearly 2 in each column, which costs eight digits (Wilkinson 1963); its condition number is
// some 30.
#[test]
fn what_pivoting_solves_is_refined_too() {
    let (corner, nodes) = (30, 131);
    let near = move |node: usize| match node.checked_sub(corner) {
        None => (0..corner).collect(),
        Some(at) => vec![(at + 100) % 101 + corner, node, (at + 1) % 101 + corner],
    };
    let entry = |row: usize, column: usize| match row.checked_sub(corner) {
        None if row == column => 1.0,
        None if column == corner - 1 => 0.7,
        None => [0.0, -0.97][usize::from(row > column)],
        Some(_) if row == column => 1e-30,
        Some(at) => [0.1, 1.0][usize::from((at + 1) % 101 == column - corner)],
    };
    let (error, report) = Matrix::new(pattern(nodes, 1, near), near, entry).error(2);
    assert!(error <= TOLERANCE, "{error:e}");
    assert_eq!(report.fallbacks, 1);
    assert!(report.refinements > 0);
}

// Neighbours exchange their rows, so every pivot is beside the diagonal; some become pivots after several fronts.
#[test]
fn pivots_of_large_fronts_are_found() {
    for (sides, length) in [([40, 30, 1], 2), ([9, 8, 9], 3)] {
        let nodes: usize = sides.iter().product();
        let near = stencil(sides);
        let mut random = Random::new(4);
        let matrix = Matrix::new(pattern(nodes, length, near.clone()), near, |row, column| {
            let [node, other] = [row, column].map(|at| at / length);
            match (node ^ 1 == other, row % length == column % length) {
                (true, true) => 900.0,
                (false, true) if node == other => 1e-30,
                _ => random.digit(),
            }
        });
        let (error, report) = matrix.error(3);
        assert!(error <= TOLERANCE, "{error:e}");
        assert_eq!(report.fallbacks, 1);
    }
}

#[test]
fn zero_diagonals_are_solved() {
    for seed in 1..=5 {
        let graph = random_graph(300, 2, seed);
        let neighbours = |node: usize| graph[node].clone();
        let mut random = Random::new(seed);
        let entry = |row: usize, column: usize| match row.abs_diff(column) {
            0 => 0.0,
            _ => random.digit() + 0.5,
        };
        let matrix = Matrix::new(pattern(300, 1, neighbours), neighbours, entry);
        is_solved_or_refused(&matrix, seed);
    }
}

/// Asserts the bound for a solution, by a residual that is formed here. Columns are of similar size, so tiny
/// unknowns count as a rounding of the largest.
fn is_solved_or_refused(matrix: &Matrix, seed: u64) -> bool {
    let mut random = Random::new(seed);
    let exact: Vec<f64> = (0..matrix.pattern.unknowns())
        .map(|_| random.digit())
        .collect();
    let b = matrix.times(&exact);
    match matrix.solve(&b) {
        Ok((x, _)) => {
            let largest = x.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
            let floored = x.iter().map(|x| x.abs() + f64::EPSILON * largest);
            let sizes = matrix.sizes(&floored.collect::<Vec<_>>(), &b);
            for ((found, b), size) in matrix.times(&x).iter().zip(&b).zip(sizes) {
                assert!(
                    (found - b).abs() <= 257.0 * f64::EPSILON * size,
                    "{found} {b}"
                );
            }
            true
        }
        Err(Error::Unsolved {
            backward_error,
            bound,
            ..
        }) => {
            assert!(backward_error > bound);
            false
        }
        Err(error) => panic!("{error}"),
    }
}

// Powers of two near 1e±150, so that scaling rounds nothing.
fn scales(count: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    let exponents = (0..count).map(|_| [-498, 0, 498][random.up_to(2) as usize]);
    exponents.map(|exponent| 2.0_f64.powi(exponent)).collect()
}

/// Solves a lattice with scaled rows and columns; the solution is known.
fn scaled_lattice_is_solved(rows: u64, columns: u64) {
    let mut matrix = lattice([12, 12, 2], 1);
    let unknowns = matrix.pattern.unknowns();
    let unscaled = |seed| {
        if seed == 0 {
            vec![1.0; unknowns]
        } else {
            scales(unknowns, seed)
        }
    };
    let (rows, columns) = (unscaled(rows), unscaled(columns));
    let mut random = Random::new(9);
    let exact: Vec<f64> = (0..unknowns).map(|_| random.digit()).collect();
    let b = matrix.times(&exact);
    let b: Vec<f64> = b.iter().zip(&rows).map(|(b, scale)| b * scale).collect();
    for (row, column, entry) in &mut matrix.entries {
        *entry *= rows[*row] * columns[*column];
    }
    let (x, _) = matrix.solve(&b).unwrap();
    for ((x, exact), scale) in x.iter().zip(&exact).zip(&columns) {
        assert!(
            (x * scale - exact).abs() <= TOLERANCE,
            "{} {exact}",
            x * scale
        );
    }
}

#[test]
fn rows_of_any_scale_are_solved() {
    scaled_lattice_is_solved(3, 0);
}

#[test]
fn columns_of_any_scale_are_solved() {
    scaled_lattice_is_solved(0, 4);
}

#[test]
fn rows_and_columns_of_any_scale_are_solved() {
    scaled_lattice_is_solved(5, 6);
}

#[test]
fn a_singular_matrix_is_an_error() {
    let zero = cycle(50, [0.0; 3]).solve(&[1.0; 50]);
    assert!(matches!(zero, Err(Error::Unsolved { .. })), "{zero:?}");
    let ones = Matrix::new(pattern(2, 1, |_| vec![0, 1]), |_| vec![0, 1], |_, _| 1.0);
    let ones = ones.solve(&[1.0, 2.0]);
    assert!(matches!(ones, Err(Error::Unsolved { .. })), "{ones:?}");
}

// The sum of all rows is zero and that of the right-hand side is not. Rounding makes the last pivot
// tiny instead of zero, and x is exact for a matrix that differs by a rounding.
#[test]
fn a_matrix_that_is_singular_but_for_rounding_has_a_huge_solution_or_none() {
    match cycle(50, [2.0, -1.0, -1.0]).solve(&[1.0; 50]) {
        Ok((x, _)) => assert!(x.iter().all(|x| x.abs() > 1e13)),
        Err(error) => assert!(matches!(error, Error::Unsolved { .. })),
    }
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    let matrix = lattice([6, 6, 1], 2);
    let mut values = matrix.values();
    let mut solver = Solver::new(&matrix.pattern).unwrap();
    let mut right = vec![[1.0]; 72];
    right[17] = [f64::INFINITY];
    let refused = solver.factor(&values).unwrap().solve(&mut right);
    let (what, position) = (Operand::Right, 17);
    assert_eq!(refused, Err(Error::NotFinite { what, position }));
    right[17] = [1.0];
    values[5] = f64::NAN;
    let refused = solver.factor(&values).unwrap().solve(&mut right);
    let (what, position) = (Operand::Matrix, 5);
    assert_eq!(refused, Err(Error::NotFinite { what, position }));
    assert!(right.iter().all(|x| x == &[1.0]));
}

#[test]
fn an_unchecked_solution_that_overflows_is_an_error() {
    let mut solver = Solver::new(&Pattern::new(3, |_| {})).unwrap();
    let mut right = [[1.0], [1e300], [1.0]];
    solver.factor(&[1.0, 1e-300, 1.0]).unwrap();
    let refused = solver.solve_again(&mut right);
    let (what, position) = (Operand::Solution, 1);
    assert_eq!(refused, Err(Error::NotFinite { what, position }));
}

#[test]
fn a_block_of_an_unchecked_solution_that_overflows_is_named() {
    let pattern = Pattern::new(5, |_| {}).in_blocks(2).unwrap();
    let mut solver = Solver::new(&pattern).unwrap();
    for row in [0, 5, 8] {
        let mut values = vec![0.0; pattern.entries()];
        for row in 0..10 {
            values[pattern.position(row, row).unwrap()] = 1.0;
        }
        values[pattern.position(row, row).unwrap()] = 1e-300;
        solver.factor(&values).unwrap();
        let refused = solver.solve_again(&mut [[1e300]; 10]);
        let Err(Error::NotFinite { what, position }) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!((what, position / 2), (Operand::Solution, row / 2));
    }
}

#[test]
fn arrays_of_another_length_are_refused() {
    let mut solver = Solver::new(&Pattern::new(3, |_| {})).unwrap();
    let refused = solver.factor(&[1.0; 4]).err();
    assert_eq!(
        refused,
        Some(Error::Count {
            expected: 3,
            found: 4
        })
    );
    let refused = solver.factor(&[1.0; 3]).unwrap().solve(&mut [[1.0]; 2]);
    assert_eq!(
        refused,
        Err(Error::Count {
            expected: 3,
            found: 2
        })
    );
    let refused = Pattern::new(1, |_| {}).in_blocks(4).err();
    assert_eq!(refused, Some(Error::BlockLength { length: 4 }));
}

// A response that decays by a digit per unknown, to zero.
#[test]
fn unknowns_that_underflow_are_solved() {
    let matrix = cycle(2_000, [1.0, 0.1, 0.1]);
    let mut b = vec![0.0; 2_000];
    b[0] = 1.0;
    let (x, report) = matrix.solve(&b).unwrap();
    assert_eq!(report.fallbacks, 0);
    assert!((x[0] - 1.0 / 0.96_f64.sqrt()).abs() <= TOLERANCE);
}

// A hub: rows of thousands of entries have a larger bound than short ones.
#[test]
fn a_row_with_many_entries_is_solved() {
    let nodes = 5_000;
    let near = move |node: usize| match node {
        0 => (0..nodes).collect(),
        _ => vec![0, node],
    };
    let mut random = Random::new(2);
    let matrix = Matrix::new(pattern(nodes, 1, near), near, |_, _| random.digit()).dominant();
    let (error, report) = matrix.error(3);
    assert_eq!(report.fallbacks, 0);
    // The sum of the hub's row has 5,000 roundings; the inverse is at most 1.
    let size = matrix.sizes(&vec![4.0; nodes], &vec![0.0; nodes])[0];
    assert!(error <= f64::from(5_001) * f64::EPSILON * 2.0 * size);
}

#[test]
fn blocks_without_neighbours_are_solved() {
    let near = |node: usize| vec![node];
    let mut random = Random::new(4);
    let matrix = Matrix::new(pattern(40, 3, near), near, |_, _| random.digit()).dominant();
    let (error, report) = matrix.error(6);
    assert!(error <= TOLERANCE);
    assert_eq!(report, Report::default());
}

#[test]
fn no_unknowns_are_solved_at_once() {
    let mut solver = Solver::new(&Pattern::new(0, |_| {})).unwrap();
    let report = solver.factor(&[]).unwrap().solve::<1>(&mut []);
    assert_eq!(report, Ok(Report::default()));
}

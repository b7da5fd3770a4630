//! The check whether a solution is accurate to rounding, and iterative refinement of those that are not.
//!
//! The measure is the componentwise backward error (Arioli, Demmel & Duff 1989)
//!
//! ```text
//! ωᵢ = |b − A x|ᵢ / (|A| |x| + |b|)ᵢ
//! ```
//!
//! the smallest relative change of the entries of row i, and of bᵢ, that makes x exact. If all columns
//! of A are of similar size, unknowns below `ε max |x|` count as `ε max |x|`: far away from a local
//! load, a solution decays to numbers without a correct digit.
//!
//! Solutions are in the order of elimination, right-hand sides in that of the unknowns.

use crate::columns::Column;
use crate::gathering::Matrix;

/// The backward error of rows with at most 255 entries that counts as rounding, in units of the last
/// place.
///
/// A sum of k products is computed with an error of at most `(k + 1) ε / 2` times the sum of their
/// magnitudes, and refinement in the same precision brings ω to twice that (Higham 2002, theorem 12.3):
/// `(k + 1) ε`, which is 256 ε for 255 entries.
const BACKWARD_ERROR: usize = 256;

/// How often a solution is refined before its factors are given up. Each time gains as many digits as the
/// factors have, so three are enough if they have six.
const REFINEMENTS: usize = 3;

/// Columns are of similar size if their largest entries differ by less than this factor: then the unknowns
/// have comparable units, and one that is ε times the largest is no more than its rounding error.
const SIMILAR: f64 = 1.0 / f64::EPSILON;

/// The largest backward error that counts as rounding, for a row with this many entries.
pub(crate) fn bound(entries: usize) -> f64 {
    let units = BACKWARD_ERROR.max(entries + 1);
    f64::from(u32::try_from(units).unwrap_or(u32::MAX)) * f64::EPSILON
}

/// A row that fails the check.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Failure {
    pub(crate) row: usize,
    pub(crate) backward_error: f64,
    pub(crate) bound: f64,
}

/// A matrix and a right-hand side.
#[derive(Clone, Copy)]
pub(crate) struct Equations<'a, const L: usize> {
    pub(crate) matrix: Matrix<'a, L>,
    pub(crate) b: Column<'a>,
}

impl<const L: usize> Equations<'_, L> {
    /// `b − A x` and `|b| + |A| (|x| + floor)` in the rows of a node.
    ///
    /// Numbers below the smallest normal one have an absolute error instead of a relative one, so
    /// this number is added to the size of a row, and is the smallest floor.
    #[expect(clippy::inline_always, reason = "a few numbers in registers")]
    #[inline(always)]
    fn residual(&self, node: usize, x: &[[f64; L]], floor: f64) -> ([f64; L], [f64; L]) {
        let mut residual = self.b.of(node);
        let mut size = residual.map(|b| b.abs() + f64::MIN_POSITIVE);
        for (column, block) in self.matrix.blocks_of(node) {
            let x = &x[self.matrix.fronts.places[column] as usize];
            for (row, entries) in block.iter().enumerate() {
                for (&value, x) in entries.iter().zip(x) {
                    residual[row] -= value * x;
                    size[row] += value.abs() * (x.abs() + floor);
                }
            }
        }
        (residual, size)
    }

    /// The bound for the rows of a node.
    fn bound(&self, node: usize) -> f64 {
        bound(self.matrix.pattern.row(node).len() * L)
    }

    /// Whether the backward error of every row is within its bound. False if any number is NaN or
    /// infinite.
    pub(crate) fn are_solved(&self, x: &[[f64; L]], memory: &mut Vec<f64>) -> bool {
        self.are_solved_above(f64::MIN_POSITIVE, x) || self.are_solved_but_for_tiny(x, memory)
    }

    /// Whether every row is within its bound if unknowns below a floor count as the floor.
    fn are_solved_above(&self, floor: f64, x: &[[f64; L]]) -> bool {
        let mut are_solved = true;
        for node in 0..x.len() {
            let (residual, size) = self.residual(node, x, floor);
            let bound = self.bound(node);
            for (residual, size) in residual.iter().zip(size) {
                are_solved &= residual.abs() <= bound * size && size <= f64::MAX;
            }
        }
        are_solved
    }

    /// The same if tiny unknowns count as a rounding of the largest; false unless columns are of similar size.
    #[cold]
    fn are_solved_but_for_tiny(&self, x: &[[f64; L]], memory: &mut Vec<f64>) -> bool {
        let unknowns = x.as_flattened();
        memory.resize(unknowns.len(), 0.0);
        memory.fill(0.0);
        for node in 0..x.len() {
            for (column, block) in self.matrix.blocks_of(node) {
                let columns = &mut memory[column * L..][..L];
                for entries in block {
                    for (largest, &entry) in columns.iter_mut().zip(entries) {
                        *largest = largest.max(entry.abs());
                    }
                }
            }
        }
        let extremes = |(least, most): (f64, f64), &size: &f64| (least.min(size), most.max(size));
        let (least, most) = memory.iter().fold((f64::MAX, 0.0), extremes);
        let largest = unknowns
            .iter()
            .fold(0.0, |largest: f64, x| largest.max(x.abs()));
        let floor = f64::MIN_POSITIVE.max(f64::EPSILON * largest);
        most < SIMILAR * least && largest <= f64::MAX && self.are_solved_above(floor, x)
    }

    /// The row that misses its bound by the largest factor.
    #[cold]
    pub(crate) fn worst(&self, x: &[[f64; L]]) -> Failure {
        let mut worst = Failure {
            row: 0,
            backward_error: f64::INFINITY,
            bound: bound(0),
        };
        let mut largest = 0.0;
        for node in 0..x.len() {
            let (residual, size) = self.residual(node, x, f64::MIN_POSITIVE);
            let bound = self.bound(node);
            for at in 0..L {
                let ratio = residual[at].abs() / size[at];
                let is_number = ratio.is_finite();
                let backward_error = if is_number { ratio } else { f64::INFINITY };
                let excess = backward_error / bound;
                if excess >= largest {
                    largest = excess;
                    worst = Failure {
                        row: node * L + at,
                        backward_error,
                        bound,
                    };
                }
            }
        }
        worst
    }

    /// Adds corrections to a solution until it passes the check; returns how many that took, or `None`
    /// if it still fails after the last one.
    ///
    /// `correct` overwrites a residual in the order of elimination with the correction.
    #[cold]
    pub(crate) fn refine(
        &self,
        x: &mut [[f64; L]],
        memory: &mut Vec<f64>,
        correct: &mut dyn FnMut(&mut [[f64; L]]),
    ) -> Option<usize> {
        for refinement in 1..=REFINEMENTS {
            memory.resize(x.as_flattened().len(), 0.0);
            let rest = memory.as_chunks_mut::<L>().0;
            for (rest, &node) in rest.iter_mut().zip(&self.matrix.fronts.order) {
                (*rest, _) = self.residual(node as usize, x, 0.0);
            }
            correct(rest);
            for (x, correction) in x.as_flattened_mut().iter_mut().zip(rest.as_flattened()) {
                *x += correction;
            }
            if self.are_solved(x, memory) {
                return Some(refinement);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fronts::Fronts;
    use crate::pattern::Pattern;

    const EPSILON: f64 = f64::EPSILON;

    /// The only column of right-hand sides.
    fn column(rows: &[f64]) -> Column<'_> {
        let (width, at) = (1, 0);
        Column { rows, width, at }
    }

    /// Calls `ask` with the equations `diagonal[i] x[i] = b[i]`.
    fn ask<R>([diagonal, b]: [[f64; 2]; 2], ask: impl FnOnce(&Equations<'_, 1>) -> R) -> R {
        let pattern = Pattern::new(2, |_| {});
        let matrix = Matrix {
            fronts: &Fronts::new(&pattern).unwrap(),
            pattern: &pattern,
            values: &diagonal,
        };
        let b = column(&b);
        ask(&Equations { matrix, b })
    }

    fn is_solved(diagonal: [f64; 2], x: [f64; 2], b: [f64; 2]) -> bool {
        let mut memory = Vec::new();
        ask([diagonal, b], |equations| {
            equations.are_solved(&x.map(|x| [x]), &mut memory)
        })
    }

    #[test]
    fn long_rows_have_a_larger_bound() {
        assert!((bound(3) - 256.0 * EPSILON).abs() <= 0.0);
        assert!((bound(255) - 256.0 * EPSILON).abs() <= 0.0);
        assert!((bound(999) - 1000.0 * EPSILON).abs() <= 0.0);
    }

    // The size of the row is 2.
    #[test]
    fn a_solution_is_accepted_up_to_the_bound() {
        assert!(is_solved([1.0; 2], [1.0 + 511.0 * EPSILON, 1.0], [1.0; 2]));
        assert!(!is_solved([1.0; 2], [1.0 + 514.0 * EPSILON, 1.0], [1.0; 2]));
        assert!(!is_solved([1.0; 2], [1.0, 1.0 - 514.0 * EPSILON], [1.0; 2]));
        assert!(!is_solved([1.0; 2], [1.0, f64::NAN], [1.0; 2]));
        assert!(!is_solved([1.0; 2], [1.0, f64::INFINITY], [1.0; 2]));
        // The sizes overflow, the residual does not.
        assert!(!is_solved([1.0; 2], [1.0, f64::MAX], [1.0, f64::MAX]));
    }

    #[test]
    fn tiny_unknowns_count_as_a_rounding_of_the_largest_among_similar_columns() {
        let x = [1.0, 1e-30];
        assert!(is_solved([1.0; 2], x, [1.0, 2e-30]));
        assert!(is_solved([1.0, 1e15], x, [1.0, 2e-15]));
        assert!(!is_solved([1.0, 1e16], x, [1.0, 2e-14]));
        assert!(!is_solved([1.0, SIMILAR], x, [1.0, 2e-30 * SIMILAR]));
        assert!(!is_solved([1.0, 1e-16], x, [1.0, 2e-46]));
        assert!(!is_solved([1.0; 2], [1.0, 1e-10], [1.0, 2e-10]));
        // ε · 256 ε is 1.3e-29.
        assert!(is_solved([1.0; 2], [1.0, 1e-35], [1.0, 1.2e-29]));
        assert!(!is_solved([1.0; 2], [1.0, 1e-35], [1.0, 1.4e-29]));
        assert!(is_solved([1.0; 2], [1e3, 1e-35], [1e3, 1.2e-26]));
        assert!(!is_solved([1.0; 2], [1e3, 1e-35], [1e3, 1.4e-26]));
    }

    #[test]
    fn numbers_below_the_normal_ones_are_rounded_absolutely() {
        let least = f64::from_bits(1);
        assert!(is_solved([1e-300; 2], [0.0; 2], [100.0 * least; 2]));
        assert!(!is_solved([1e-300; 2], [0.0; 2], [1000.0 * least; 2]));
    }

    #[test]
    fn the_worst_row_is_named() {
        let worst = ask([[1.0; 2], [3.0; 2]], |equations| {
            equations.worst(&[[3.0], [1.0]])
        });
        assert_eq!(worst.row, 1);
        assert!((worst.backward_error - 0.5).abs() <= EPSILON);
        assert!((worst.bound - 256.0 * EPSILON).abs() <= 0.0);
        let worst = ask([[1.0; 2], [3.0; 2]], |equations| {
            equations.worst(&[[f64::NAN], [1.0]])
        });
        assert_eq!((worst.row, worst.backward_error), (0, f64::INFINITY));
    }

    /// Calls `ask` with the equations `x[i] = b[i]` of a star of nodes with two rows each; all blocks with
    /// the first node are there, and zero.
    fn ask_star<R>(
        nodes: usize,
        b: &dyn Fn(usize) -> [f64; 2],
        ask: impl FnOnce(&Equations<'_, 2>) -> R,
    ) -> R {
        let star = Pattern::new(nodes, |pair| (1..nodes).for_each(|node| pair(0, node)));
        let pattern = star.in_blocks(2).unwrap();
        let mut values = vec![0.0; pattern.entries()];
        for row in 0..pattern.unknowns() {
            values[pattern.position(row, row).unwrap()] = 1.0;
        }
        let matrix = Matrix {
            fronts: &Fronts::new(&pattern).unwrap(),
            pattern: &pattern,
            values: &values,
        };
        let right: Vec<f64> = (0..nodes).flat_map(b).collect();
        let b = column(&right);
        ask(&Equations { matrix, b })
    }

    #[test]
    fn the_bound_of_a_block_counts_entries_and_the_worst_row_is_one_of_its_rows() {
        let b = |node| [0.0, f64::from(u8::from(node == 3))];
        ask_star(200, &b, |equations| {
            assert!((equations.bound(0) - 401.0 * EPSILON).abs() <= 0.0);
            assert!((equations.bound(3) - 256.0 * EPSILON).abs() <= 0.0);
            let worst = equations.worst(&[[0.0; 2]; 200]);
            assert_eq!(worst.row, 7);
            assert!((worst.bound - 256.0 * EPSILON).abs() <= 0.0);
        });
        // Backward errors 0.5 and 0.4, bounds 401 ε and 256 ε.
        let b = |node| match node {
            0 => [3.0, 1.0],
            3 => [1.0, 7.0 / 3.0],
            _ => [1.0; 2],
        };
        let worst = ask_star(200, &b, |equations| equations.worst(&[[1.0; 2]; 200]));
        assert_eq!(worst.row, 7);
    }

    #[test]
    fn tiny_unknowns_of_a_block_count_as_a_rounding_of_the_largest() {
        for node in 0..5 {
            for (right, expected) in [(1.2e-29, true), (1.4e-29, false)] {
                let b = |at: usize| [1.0, if at == node { right } else { 1.0 }];
                let is_solved = ask_star(5, &b, |equations| {
                    let mut x = [[1.0; 2]; 5];
                    x[equations.matrix.fronts.places[node] as usize][1] = 1e-35;
                    equations.are_solved(&x, &mut Vec::new())
                });
                assert_eq!(is_solved, expected);
            }
        }
    }

    // Each correction leaves this share of the error.
    #[test]
    fn refinement_stops_when_the_solution_is_accepted_or_after_three_steps() {
        let steps = |share: f64| {
            ask([[2.0; 2], [6.0; 2]], |equations| {
                let mut x = [[0.0_f64]; 2];
                let mut correct = |rest: &mut [[f64; 1]]| {
                    for [rest] in rest {
                        *rest *= 0.5 * (1.0 - share);
                    }
                };
                let steps = equations.refine(&mut x, &mut Vec::new(), &mut correct);
                (steps, x.map(|[x]| (x - 3.0).abs() <= 1e3 * EPSILON))
            })
        };
        assert_eq!(steps(0.0), (Some(1), [true; 2]));
        assert_eq!(steps(1e-8), (Some(2), [true; 2]));
        assert_eq!(steps(1e-5), (Some(3), [true; 2]));
        assert_eq!(steps(1e-4), (None, [false; 2]));
    }
}

//! Why a linear system was not solved, with the numbers.

use core::fmt;

/// Why a pattern, a matrix or a right-hand side was refused, or a solution withheld.
///
/// ```
/// use eem_sparse::{Error, Pattern, Solver};
///
/// let mut solver = Solver::new(&Pattern::new(2, |_| {}))?;
/// let refused = solver.factor(&[1.0; 5]).err();
/// assert_eq!(refused, Some(Error::Count { expected: 2, found: 5 }));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The memory for the factors cannot be allocated.
    #[error("not enough memory for the factors")]
    OutOfMemory,
    /// Blocks of this size are not supported.
    #[error("a block has one to three rows, not {length}")]
    BlockLength {
        /// The size that was asked for.
        length: usize,
    },
    /// Too few or too many entries of the matrix, or rows of the right-hand side.
    #[error("expected {expected} numbers, found {found}")]
    Count {
        /// The number that the pattern has.
        expected: usize,
        /// The number given.
        found: usize,
    },
    /// A number that is infinite or NaN, before or after the elimination.
    #[error("{what} {position} is not finite")]
    NotFinite {
        /// The array with the number.
        what: Operand,
        /// Its position in the array.
        position: usize,
    },
    /// No solution fits all equations, as the matrix is singular or has a condition number beyond the
    /// precision. A matrix that is singular but for its rounding errors can have a huge solution instead.
    #[error("no solution: backward error {backward_error:e} exceeds {bound:e} in row {row}")]
    Unsolved {
        /// The row whose residual is the largest, relative to its bound.
        row: usize,
        /// The componentwise backward error of that row; infinite if there was no solution at all.
        backward_error: f64,
        /// The largest backward error that counts as rounding.
        bound: f64,
    },
}

/// One of the three arrays of `A x = b`.
///
/// ```
/// assert_eq!(eem_sparse::Operand::Solution.to_string(), "unknown");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// The entries of A.
    Matrix,
    /// The rows of b.
    Right,
    /// The rows of x.
    Solution,
}

impl fmt::Display for Operand {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Matrix => "entry",
            Self::Right => "row of the right-hand side",
            Self::Solution => "unknown",
        })
    }
}

//! Repeated solution of `A x = b` for sparse square matrices with a symmetric structure.
//!
//! The structure is analysed once. Each new set of values then takes an elimination in dense blocks, in memory
//! that was reserved, and every solution is checked before it is returned.
//!
//! ```text
//! Pattern ─▶ order of elimination ─▶ fronts        once
//! values  ─▶ L and U of each front                 Solver::factor
//! b       ─▶ x ─▶ check ─▶ refinement ─▶ pivoting  Factored::solve
//! ```
//!
//! The elimination searches for pivots only inside the diagonal block of a front. This keeps the fill-in small and is
//! enough for most matrices with large entries near the diagonal. For the others there are refinement and pivots in
//! later fronts. Every solution has a componentwise backward error of a few roundings, see [`Factored::solve`], or is an
//! [`Error`].
//!
//! ```
//! use eem_sparse::{Pattern, Solver};
//!
//! // ⎡ 2 1 0 ⎤     ⎡ 3 ⎤
//! // ⎢ 1 2 1 ⎥ x = ⎢ 4 ⎥
//! // ⎣ 0 1 2 ⎦     ⎣ 3 ⎦
//! let pattern = Pattern::new(3, |pair| {
//!     pair(0, 1);
//!     pair(1, 2);
//! });
//! let mut values = vec![1.0; pattern.entries()];
//! for row in 0..3 {
//!     values[pattern.position(row, row).unwrap()] = 2.0;
//! }
//! let mut solver = Solver::new(&pattern)?;
//! let mut x = [[3.0], [4.0], [3.0]];
//! let report = solver.factor(&values)?.solve(&mut x)?;
//! for [x] in x {
//!     assert!((x - 1.0).abs() < 1e-15);
//! }
//! assert_eq!((report.refinements, report.fallbacks), (0, 0));
//! # Ok::<(), eem_sparse::Error>(())
//! ```
//!
//! With the feature `parallel`, large matrices are factored on all threads of the current rayon pool;
//! every bit of the result is the same on any number of them.
//!
//! # Where to change what
//!
//! | to | look in |
//! |---|---|
//! | change the order of elimination | `dissection.rs`, `supernodes.rs`, `fronts.rs` |
//! | change the factors | `branch.rs`, `gathering.rs`, `elimination.rs`, `dense.rs` |
//! | change what counts as a solution | `refinement.rs`; `pivoting.rs` for the fallback |
//! | change the memory of factors | `analysis.rs` |
//! | change the threads | `threads.rs`, `division.rs` |

// Each module imports only from those above it.
mod compact;
mod error;

mod columns;
mod threads;

mod pattern;

mod dissection;
mod fronts;
mod supernodes;

mod dense;
mod division;
mod elimination;
mod gathering;

mod branch;
mod definite;
mod factors;

mod analysis;

mod pivoting;
mod refinement;

mod fallback;
mod solver;

pub use analysis::Analysis;
pub use error::{Error, Operand};
pub use pattern::{LARGEST_BLOCK, Pattern};
pub use solver::{Factored, Report, Solver};

/// The example of the README is part of the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

//! The equations are those of the library, the solvers solve them, and the tables say what was measured.

mod agreement;
mod convergence;
mod tables;

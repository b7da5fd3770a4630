//! The equations are those of the library, the solvers solve them, the tables say what was
//! measured, and the prototype is the library's explicit scheme.

mod agreement;
mod convergence;
mod prototype;
mod tables;

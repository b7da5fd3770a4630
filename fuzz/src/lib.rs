//! Fuzz targets, as functions of bytes: they return, or panic with what is wrong.
//!
//! This file is the root of two crates: of the library behind `fuzz_targets`, which `cargo fuzz`
//! runs, and of a test of the package `eem`, which feeds the saved corpora to the same functions
//! with a stable compiler.

#![allow(unreachable_pub, reason = "a test exports nothing")]

#[path = "expression.rs"]
mod expressions;
#[path = "../../tests/random_expressions/kernels.rs"]
mod kernels;
mod laws;
mod recipe;
#[cfg(test)]
mod replay;
#[path = "text.rs"]
mod texts;

pub use expressions::expression;
pub use laws::laws;
pub use texts::text;

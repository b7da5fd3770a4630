//! A zoo of free energies, from published models to bonds, rubber, gases and materials that change
//! phase: generated code against the interpreter, against dual numbers and against 96 digits, and
//! the laws along a short run of each.
//!
//! A formula is written once (`zoo/families`) and read twice, by the derive and by Rust itself as
//! a function of any number. Tests go over all specimens; with `--nocapture` each prints a table.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "zoo/against_digits.rs"]
mod against_digits;
#[path = "zoo/against_duals.rs"]
mod against_duals;
#[path = "zoo/against_interpreter.rs"]
mod against_interpreter;
#[path = "zoo/bounds.rs"]
mod bounds;
#[path = "zoo/digits.rs"]
mod digits;
#[path = "zoo/dual.rs"]
mod dual;
#[path = "zoo/expression.rs"]
mod expression;
#[path = "zoo/families/mod.rs"]
mod families;
#[path = "zoo/homes.rs"]
mod homes;
#[path = "zoo/number.rs"]
mod number;
#[path = "zoo/precise.rs"]
mod precise;
#[path = "zoo/runs.rs"]
mod runs;
#[path = "zoo/specimen.rs"]
mod specimen;
#[path = "zoo/states.rs"]
mod states;

//! A zoo of free energies, from published models to bonds, rubber, gases and materials that change
//! phase: generated code against the interpreter, against dual numbers and against 96 digits, and
//! the laws along a short run of each.
//!
//! A formula is written once (`zoo/families`) and read twice, by the derive and by Rust itself as
//! a function of any number. Tests go over all specimens; with `--nocapture` each prints a table.

mod against_digits;
mod against_duals;
mod against_interpreter;
#[cfg(feature = "typed")]
mod against_typed;
mod behind_table;
mod bounds;
mod digits;
mod dual;
mod expression;
mod families;
mod homes;
mod number;
#[cfg(feature = "gradients")]
mod parameters;
mod precise;
mod properties;
mod rest;
mod runs;
mod specimen;
mod states;

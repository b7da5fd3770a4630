//! Fuzz targets, as functions of bytes: they return, or panic with what is wrong.
//!
//! This file is the root of two crates: of the library behind `fuzz_targets`, which `cargo fuzz`
//! runs, and of a test of the package `eem`, which feeds the saved corpora to the same functions
//! with a stable compiler.

#![allow(
    dead_code,
    unreachable_pub,
    reason = "the entry of the macro is not among these files"
)]

// For modules that ask whether a compiler runs them.
extern crate proc_macro;

/// The front end of the derive, which a procedural macro cannot export.
#[path = "../../eem-derive/src"]
mod front_end {
    pub(crate) mod ast;
    pub(crate) mod attr;
    pub(crate) mod check;
    pub(crate) mod checked;
    pub(crate) mod ctxt;
    pub(crate) mod derive;
    pub(crate) mod expand;
    pub(crate) mod fallback;
    pub(crate) mod message;
    pub(crate) mod model;
    pub(crate) mod nearest;
    pub(crate) mod parse;
    pub(crate) mod physics;
    pub(crate) mod unit;
    pub(crate) mod units;
    pub(crate) mod warnings;
}
// Its files name each other from the root of their crate.
use front_end::{
    ast, attr, check, checked, ctxt, derive, expand, fallback, message, model, nearest, parse,
    physics, unit, units, warnings,
};

#[path = "expression.rs"]
mod expressions;
#[path = "../../tests/random_expressions/kernels.rs"]
mod kernels;
mod laws;
mod recipe;
#[cfg(test)]
mod replay;

pub use expressions::expression;
pub use laws::laws;

//! Linear systems of all kinds through the solver, with known solutions; and the order of elimination.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../support/mod.rs"]
mod support;

mod hard_matrices;
mod large_fronts;
mod order;

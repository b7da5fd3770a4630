//! Code that tests of several packages share, compiled once.
//!
//! [`precise`] has numbers with any number of digits, for oracles; [`random`] has random expressions that are the same in
//! every run; `scenes` has the published cases with their reference data, and models for many tests. Functions of
//! `scenes` have few type parameters, so that the solver they need is compiled here, once.

#![allow(missing_docs, reason = "fields are named as in the formulas")]
#![allow(
    clippy::missing_errors_doc,
    clippy::missing_panics_doc,
    clippy::unwrap_used,
    reason = "a test fails by panicking"
)]
#![allow(
    clippy::must_use_candidate,
    reason = "a result that a test ignores is seen in the test"
)]
#![allow(
    clippy::should_implement_trait,
    reason = "a source of random numbers is not an iterator"
)]

// With optimisation, programs do not use generic code that another crate has compiled.
#[cfg(all(feature = "scenes", debug_assertions))]
pub mod compiled;
pub mod length;
pub mod precise;
pub mod random;
#[cfg(feature = "scenes")]
pub mod scenes;
pub mod secant;
#[cfg(feature = "scenes")]
pub mod table;

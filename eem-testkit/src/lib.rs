//! What tests of several packages share, compiled once.
//!
//! [`precise`] has numbers with any number of digits, which every oracle computes with; [`random`] random expressions that
//! are always the same; `scenes` the published cases with their reference data, and models for many tests. A function
//! of `scenes` has no type parameters where a test does not need them, so that the solver behind it is compiled here.

#![allow(missing_docs, reason = "fields are named as in the formulas")]
#![allow(
    clippy::missing_errors_doc,
    clippy::missing_panics_doc,
    clippy::unwrap_used,
    reason = "a test fails by panicking"
)]
#![allow(
    clippy::must_use_candidate,
    reason = "a test that does not look is seen in the test"
)]
#![allow(
    clippy::should_implement_trait,
    reason = "random numbers are no iterator"
)]

#[cfg(feature = "scenes")]
pub mod compiled;
pub mod length;
pub mod precise;
pub mod random;
#[cfg(feature = "scenes")]
pub mod scenes;
#[cfg(feature = "scenes")]
pub mod table;

//! Gradients of runs: what is differentiated, by what, and the results.

pub(crate) mod error;
pub(crate) mod history;
pub(crate) mod objective;
pub(crate) mod result;
pub(crate) mod snapshots;

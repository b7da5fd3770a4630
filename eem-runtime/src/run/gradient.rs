//! Gradients and tangents of runs: what is differentiated, by what, and the results.

pub(crate) mod error;
pub(crate) mod history;
pub(crate) mod input;
pub(crate) mod result;
pub(crate) mod series;
pub(crate) mod snapshots;
pub(crate) mod times;

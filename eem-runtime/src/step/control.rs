//! How accurate steps have to be, and how large the next one is.

mod controller;
mod statistics;
mod tolerance;

pub(crate) use controller::{AFTER_FAILURE, Controller, Verdict};
pub use statistics::StepStatistics;
pub use tolerance::Tolerance;
pub(crate) use tolerance::{Accuracy, Scales, norm};

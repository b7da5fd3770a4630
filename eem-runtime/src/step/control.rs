//! How accurate steps have to be, and how large the next one is.

mod accuracy;
mod controller;
mod statistics;
mod tolerance;

pub(crate) use accuracy::{Accuracy, Estimate};
pub(crate) use controller::{AFTER_FAILURE, Controller};
pub use statistics::StepStatistics;
pub use tolerance::Tolerance;
pub(crate) use tolerance::{Kinds, Scales, norm};

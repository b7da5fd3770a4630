//! Step control: tolerances, error estimates and the size of the next step.

mod controller;
mod statistics;
mod tolerance;

pub(crate) use controller::{AFTER_FAILURE, Accuracy, Controller, Estimate};
pub use statistics::StepStatistics;
pub use tolerance::Tolerance;
pub(crate) use tolerance::{Kinds, Scales, norm};

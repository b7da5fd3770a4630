//! Step control: tolerances, error estimates and the size of the next step.

mod accuracy;
mod controller;
mod statistics;
mod tolerance;

pub(crate) use accuracy::{Accuracy, Estimate};
pub(crate) use controller::{AFTER_FAILURE, Controller};
pub use statistics::StepStatistics;
pub use tolerance::Tolerance;
pub(crate) use tolerance::{Kinds, Scales, norm};

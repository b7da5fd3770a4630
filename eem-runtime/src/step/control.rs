//! Step control: tolerances, error estimates and the size of the next step.

mod controller;
mod least;
mod rounding;
mod statistics;
mod tolerance;
mod worst;

pub(crate) use crate::algebra::{length, norm};
pub(crate) use controller::{AFTER_FAILURE, Accuracy, Controller, Estimate, ROUNDINGS};
pub(crate) use least::{LeastScales, Step};
pub(crate) use rounding::LoadRounding;
pub use statistics::StepStatistics;
pub use tolerance::Tolerance;
pub(crate) use tolerance::{Kinds, Scales};
pub(crate) use worst::{Unknown, UnknownError, see_worst};

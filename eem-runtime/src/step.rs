//! Steps: the schemes as data, Newton's method, the end of a step and its certificate; the explicit scheme.

#[cfg(feature = "gradients")]
pub(crate) mod adjoint;
pub(crate) mod automatic;
pub(crate) mod certificate;
pub(crate) mod control;
pub(crate) mod error;
pub(crate) mod explicit;
pub(crate) mod features;
pub(crate) mod law;
#[cfg(feature = "gradients")]
mod line;
pub(crate) mod load_rule;
pub(crate) mod loads;
pub(crate) mod newton;
pub(crate) mod outcome;
pub(crate) mod rule;
pub(crate) mod samples;
pub(crate) mod scheme;
pub(crate) mod solver;
pub(crate) mod systems;
pub(crate) mod timed;

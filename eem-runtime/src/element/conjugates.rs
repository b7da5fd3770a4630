//! Forces, temperature and change of entropy of an element in a step.
//!
//! A family defines at which configuration of the step the deformation is measured, and turns old and new variables of a
//! point into algorithmic quantities `f*`, `g*`, `θ*`, `Δs` with their exact tangent. It knows nothing of
//! nodes, neighbours or solvers.

mod corners;
mod exact;
mod family;
mod fitting;
mod infeasible;
mod point;
mod start;
mod temperature;

use crate::element::tableau::Tableau;

pub(crate) use corners::find_corners_together;
pub(crate) use exact::check_stable;
#[cfg(feature = "gradients")]
pub(crate) use exact::exchanged;
pub(crate) use family::{Any, Exact, ExactForm, Family, OneSet, Placement, PointRule};
pub(crate) use fitting::{end_weight, end_weight_over};
pub(crate) use infeasible::Infeasible;
pub(crate) use start::{Form, Start};
pub(crate) use temperature::{recovered_at, temperature_at};

/// How the conjugates of a scheme are found.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Conjugates {
    /// One set of forces in a step.
    One(OneSet),
    /// Values at the stages of a rule.
    Stages(&'static Tableau),
}

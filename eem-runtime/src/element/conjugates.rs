//! Forces, temperature and change of entropy of an element in a step.
//!
//! A family defines at which configuration of the step the deformation is measured, and turns old and new variables of a
//! point into algorithmic quantities `f*`, `g*`, `θ*`, `Δs` with their exact tangent. It knows nothing of
//! nodes, neighbours or solvers.

mod corners;
mod element;
mod exact;
mod fitting;
mod point;
mod temperature;

use crate::element::tableau::Tableau;

pub(crate) use element::{ElementScheme, Form, Infeasible, Placement, Start};
pub(crate) use exact::{Exact, ExactForm};
pub(crate) use fitting::{end_weight, end_weight_over};
pub(crate) use point::PointRule;
pub(crate) use temperature::{recovered_at, temperature_at};

/// The families of conjugates.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Conjugates {
    /// Discrete derivatives.
    Exact(ExactForm),
    /// Those in temperature form, damped towards the end of the step.
    Damped,
    /// Values at one point of the step.
    Point(PointRule),
    /// Values at the stages of a rule.
    Stages(&'static Tableau),
}

//! Forces, temperature and change of entropy of an element in a step.
//!
//! A family defines at which configuration of the step the deformation is measured, and turns old and new variables of a
//! point into algorithmic quantities `f*`, `g*`, `θ*`, `Δs` with their exact tangent. It knows nothing of
//! nodes, neighbours or solvers.

mod eem_entropy;
mod eem_temperature;
mod element;
mod fitting;
mod point;
mod temperature;

use crate::element::tableau::Tableau;

pub(crate) use eem_entropy::EemEntropy;
pub(crate) use eem_temperature::EemTemperature;
pub(crate) use element::{ElementScheme, Form, Infeasible, Placement, Start};
pub(crate) use fitting::{end_weight, end_weight_over};
pub(crate) use point::PointRule;
pub(crate) use temperature::{recovered_at, temperature_at};

/// The families of conjugates.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Conjugates {
    /// [`EemEntropy`].
    EntropyForm,
    /// [`EemTemperature`].
    TemperatureForm,
    /// The same, damped towards the end of the step.
    DampedTemperatureForm,
    /// Values at one point of the step.
    Point(PointRule),
    /// Values at the stages of a rule.
    Stages(&'static Tableau),
}

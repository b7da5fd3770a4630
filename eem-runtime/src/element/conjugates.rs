//! What follows from the path of an element through a step: forces, temperature and change of entropy.
//!
//! A family says where along the step the deformation is measured and turns old and new variables of a
//! point into algorithmic quantities `f*`, `g*`, `θ*`, `Δs` with their exact tangent. It knows nothing of
//! nodes, neighbours or solvers.

mod eem_entropy;
mod eem_temperature;
mod element;
mod midpoint;
mod midpoint_temperature;
mod point;
mod temperature;
mod trapezoidal;
mod trapezoidal_temperature;
mod variational;

use crate::element::tableau::Tableau;

pub(crate) use eem_entropy::EemEntropy;
pub(crate) use eem_temperature::EemTemperature;
pub(crate) use element::{ElementScheme, Form, Infeasible, Placement, Start};
pub(crate) use midpoint::Midpoint;
pub(crate) use midpoint_temperature::MidpointTemperature;
pub(crate) use temperature::{settled_at, temperature_at};
pub(crate) use trapezoidal::Trapezoidal;
pub(crate) use trapezoidal_temperature::TrapezoidalTemperature;
pub(crate) use variational::Variational;

/// The families.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Conjugates {
    /// [`EemEntropy`].
    EntropyForm,
    /// [`EemTemperature`].
    TemperatureForm,
    /// [`Variational`].
    MeanMeasures,
    /// [`Midpoint`].
    Midpoint,
    /// [`MidpointTemperature`].
    MidpointTemperature,
    /// [`Trapezoidal`].
    End,
    /// [`TrapezoidalTemperature`].
    EndTemperature,
    /// Values at the stages of a rule.
    Stages(&'static Tableau),
}

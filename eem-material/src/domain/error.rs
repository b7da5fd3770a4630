//! Errors of a check of a domain.

use thiserror::Error;

use crate::domain::state::DomainPoint;
use crate::number::readable::Readable;

/// Why a model is not valid in a box of states, or cannot be checked there.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DomainError {
    /// The box does not have the variables of the model.
    #[error("the model has {expected} of role `{role}`, the domain {given}")]
    Variables {
        /// `Stretch`, `Viscous` or `Temperature`; `Strain…` stands for all roles of strains.
        role: &'static str,
        /// How many the model has.
        expected: usize,
        /// How many the domain has.
        given: usize,
    },
    /// An interval is empty, not finite, or of negative lengths or temperatures.
    #[error("the {variable} from {low} to {high} is no interval of {kind} numbers", low = Readable(*low), high = Readable(*high))]
    Range {
        /// The variable.
        variable: String,
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
        /// The requirement: finite, or positive and finite.
        kind: &'static str,
    },
    /// The free energy or a derivative of it is not finite.
    #[error("the {quantity} is {value} at {point}, it must be finite", value = Readable(*value))]
    NotFinite {
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// The state.
        point: DomainPoint,
    },
    /// The heat capacity is not positive and finite: entropy does not determine the temperature.
    #[error("the heat capacity is {value} {unit} at {point}, it must be positive and finite", value = Readable(*value), unit = point.kind.heat_capacity())]
    HeatCapacity {
        /// The heat capacity `θ ∂s/∂θ`, J/K; J/(K m³) in a solid.
        value: f64,
        /// The state.
        point: DomainPoint,
    },
    /// A viscosity is not positive and finite.
    #[error(
        "the viscosity of dashpot {dashpot} is {value} {unit} at {point}, it must be positive and finite", value = Readable(*value), unit = point.kind.viscosity())]
    Viscosity {
        /// The dashpot, from 0.
        dashpot: usize,
        /// The viscosity, N s/m; Pa s in a solid.
        value: f64,
        /// The state.
        point: DomainPoint,
    },
    /// The viscosity of the dashpot in parallel with the spring is not positive and finite.
    #[error(
        "the viscosity of the stretch is {value} {unit} at {point}, it must be positive and finite", value = Readable(*value), unit = point.kind.viscosity())]
    Drag {
        /// The viscosity, N s/m.
        value: f64,
        /// The state.
        point: DomainPoint,
    },
}

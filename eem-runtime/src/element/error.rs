//! Why an element cannot be in a state.

use thiserror::Error;

use crate::element::handle::{Element, Node};
use eem_material::inversion::InversionError;
use eem_material::number::readable::Readable;

/// Why an element cannot be in a state.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StateError {
    /// The nodes of an element coincide, or are so near or far that the square of their distance underflows or
    /// overflows.
    #[error(
        "the stretch of {element} is {value} m, it must lie between {:.1e} m and {:.1e} m, so that its square neither underflows nor overflows",
        least, most, value = Readable(*value)
    )]
    Stretch {
        /// The element.
        element: Element,
        /// The stretch, m.
        value: f64,
        /// The smallest stretch, m.
        least: f64,
        /// The largest stretch, m.
        most: f64,
    },
    /// A solid is inverted at a point, or its deformation is not finite.
    #[error(
        "det F of the solid at {element} is {value}, it must be positive and finite, and so must the squares of its strains: a smaller step or a finer mesh may help",
        value = Readable(*value)
    )]
    InsideOut {
        /// The point.
        element: Element,
        /// `det F`.
        value: f64,
    },
    /// The line of a rocket has no direction: its ends coincide, or are so near or far that the square of their
    /// distance underflows or overflows.
    #[error(
        "the rocket at {node} has no direction: {tail} and {head} are {value} m apart in the mean of the step, a smaller step may help",
        value = Readable(*value)
    )]
    NoDirection {
        /// The node that it pushes.
        node: Node,
        /// The beginning of the line.
        tail: Node,
        /// The end of the line.
        head: Node,
        /// The distance, m.
        value: f64,
    },
    /// A viscous stretch is not finite.
    #[error(
        "the viscous stretch of dashpot {dashpot} of {element} is {value}{unit}, it must be finite",
        value = Readable(*value), unit = spaced(unit)
    )]
    ViscousStretch {
        /// The element.
        element: Element,
        /// The dashpot, from 0.
        dashpot: usize,
        /// The viscous stretch.
        value: f64,
        /// Its unit: m for a spring, empty for a solid.
        unit: &'static str,
    },
    /// A temperature is not positive and finite.
    #[error("the temperature of {element} is {value} K, it must be positive and finite", value = Readable(*value))]
    Temperature {
        /// The element.
        element: Element,
        /// The temperature, K.
        value: f64,
    },
    /// The mean temperature in a stage of a step is not positive and finite: the temperature of the element changes
    /// too much in the step.
    #[error("the mean temperature of {element} at a stage of the step is {value} K, it must be positive and finite; a smaller step may do", value = Readable(*value))]
    MeanTemperature {
        /// The element.
        element: Element,
        /// The temperature, K.
        value: f64,
    },
    /// The squared stretch of a spring, or the squared volume ratio of a solid, is not positive and finite along the path
    /// of an element through a step.
    #[error("the {quantity} of {element} within the step is {value}{}, it must be positive and finite; a smaller step may do", spaced(unit), value = Readable(*value))]
    Path {
        /// The element.
        element: Element,
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its unit: m² for a spring, empty for a solid.
        unit: &'static str,
    },
    /// A heat capacity is not positive and finite.
    #[error(
        "the heat capacity of {element} is {value} J/K at {temperature} K, it must be positive and finite", value = Readable(*value), temperature = Readable(*temperature))]
    HeatCapacity {
        /// The element.
        element: Element,
        /// The heat capacity `θ ∂s/∂θ`, J/K.
        value: f64,
        /// The temperature, K.
        temperature: f64,
    },
    /// A viscosity is not positive and finite.
    #[error(
        "the viscosity of dashpot {dashpot} of {element} is {value} {unit}{}, it must be positive and finite",
        temperature.as_ref().map_or_else(String::new, |theta| format!(" at {} K", Readable(*theta))), value = Readable(*value))]
    Viscosity {
        /// The element.
        element: Element,
        /// The dashpot, from 0.
        dashpot: usize,
        /// The viscosity.
        value: f64,
        /// Its unit: N s/m for a spring, J s for a point of a solid.
        unit: &'static str,
        /// The temperature, K, if the model has one.
        temperature: Option<f64>,
    },
    /// The viscosity of a dashpot in parallel with a spring is not positive and finite.
    #[error(
        "the viscosity of the stretch of {element} is {value} {unit}{}, it must be positive and finite",
        temperature.as_ref().map_or_else(String::new, |theta| format!(" at {} K", Readable(*theta))), value = Readable(*value))]
    Drag {
        /// The element.
        element: Element,
        /// The viscosity.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// The temperature, K, if the model has one.
        temperature: Option<f64>,
    },
    /// No temperature has the required entropy.
    #[error("{element}: {source}")]
    NoSuchTemperature {
        /// The element.
        element: Element,
        /// The entropy, J/K.
        entropy: f64,
        /// The error of the inversion.
        r#source: InversionError,
    },
    /// A quantity that a model computes is not finite.
    #[error("the {quantity} of {element} is {value}, it must be finite", value = Readable(*value))]
    NotFinite {
        /// The element.
        element: Element,
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
}

/// A unit behind its number.
fn spaced(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    }
}

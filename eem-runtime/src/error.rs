//! What can be wrong with a scene, with a state, and with a step.
//!
//! Every error names the thing, the value and, once time runs, the time. Values are given in `f64`
//! whatever the scalar of the scene.

use thiserror::Error;

use crate::handle::{Element, HeatPartner, Node, Reservoir};
use crate::inversion::InversionError;

/// Why a scene cannot be simulated.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A handle comes from another scene.
    #[error("{handle} belongs to another scene")]
    ForeignHandle {
        /// The handle as text.
        handle: String,
    },
    /// A coordinate is not finite.
    #[error("coordinate {axis} of the position of {node} is {value} m, it must be finite")]
    Position {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The coordinate, m.
        value: f64,
    },
    /// An anchor was given what only a mass can have, or the other way round.
    #[error("{node} cannot be given {quantity}: it is {kind}")]
    WrongKind {
        /// The node.
        node: Node,
        /// What it was given.
        quantity: &'static str,
        /// What it is.
        kind: &'static str,
    },
    /// The acceleration of gravity is not finite.
    #[error("component {axis} of gravity is {value} m/s², it must be finite")]
    Gravity {
        /// The axis, from 0.
        axis: usize,
        /// The component, m/s².
        value: f64,
    },
    /// A velocity is not finite.
    #[error("component {axis} of the velocity of {node} is {value} m/s, it must be finite")]
    Velocity {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The component, m/s.
        value: f64,
    },
    /// A mass is not positive and finite.
    #[error("the mass of {node} is {value} kg, it must be positive and finite")]
    Mass {
        /// The node.
        node: Node,
        /// The mass, kg.
        value: f64,
    },
    /// A parameter of a model is not finite.
    #[error("parameter `{parameter}` of {element} is {value}, it must be finite")]
    Parameter {
        /// The element.
        element: Element,
        /// The name of the field.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// The temperature of a reservoir is not positive and finite.
    #[error("the temperature of {reservoir} is {value} K, it must be positive and finite")]
    ReservoirTemperature {
        /// The reservoir.
        reservoir: Reservoir,
        /// The temperature, K.
        value: f64,
    },
    /// A conductance is negative or not finite.
    #[error(
        "the conductance between {element} and {partner} is {value} W/K, it must be finite and not negative"
    )]
    Conductance {
        /// The element.
        element: Element,
        /// What it exchanges heat with.
        partner: HeatPartner,
        /// The conductance, W/K.
        value: f64,
    },
    /// An element conducts heat to itself.
    #[error("{element} conducts heat to itself")]
    SelfConduction {
        /// The element.
        element: Element,
    },
    /// Something thermal was asked of an element whose model has no temperature.
    #[error("{element} has no temperature: its free energy has no `Temperature` argument")]
    NotThermal {
        /// The element.
        element: Element,
    },
    /// An element was never given a temperature.
    #[error("{element} was never given a temperature, call `set_temperature`")]
    MissingTemperature {
        /// The element.
        element: Element,
    },
    /// A viscous stretch was given for a dashpot that the model does not have.
    #[error("{element} has {dashpots} dashpots, there is no dashpot {dashpot}")]
    NoSuchDashpot {
        /// The element.
        element: Element,
        /// The dashpot asked for, from 0.
        dashpot: usize,
        /// How many there are.
        dashpots: usize,
    },
    /// The time step is not positive and finite.
    #[error("the time step is {value} s, it must be positive and finite")]
    Step {
        /// The step, s.
        value: f64,
    },
    /// Settings with which no step can succeed, or every step would.
    #[error(
        "{max_iterations} iterations to a tolerance of {tolerance}: at least one iteration and a tolerance between 0 and 1 are needed"
    )]
    NewtonSettings {
        /// The number of iterations.
        max_iterations: usize,
        /// The tolerance.
        tolerance: f64,
    },
    /// The momentum of a mass is not finite.
    #[error("component {axis} of the momentum of {node} is {value} kg m/s, it must be finite")]
    Momentum {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The component, kg m/s.
        value: f64,
    },
    /// The same thing is prescribed twice.
    #[error("{quantity} of {handle} is prescribed twice")]
    PrescribedTwice {
        /// The handle as text.
        handle: String,
        /// What is prescribed.
        quantity: &'static str,
    },
    /// The initial state of an element is outside the domain of its model.
    #[error("at t = 0 s: {0}")]
    State(#[from] StateError),
}

/// Why an element cannot be in a state.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StateError {
    /// The nodes of an element coincide, or their distance is not finite.
    #[error("the stretch of {element} is {value} m, it must be positive and finite")]
    Stretch {
        /// The element.
        element: Element,
        /// The stretch, m.
        value: f64,
    },
    /// A viscous stretch is not finite.
    #[error(
        "the viscous stretch of dashpot {dashpot} of {element} is {value} m, it must be finite"
    )]
    ViscousStretch {
        /// The element.
        element: Element,
        /// The dashpot, from 0.
        dashpot: usize,
        /// The viscous stretch, m.
        value: f64,
    },
    /// A temperature is not positive and finite.
    #[error("the temperature of {element} is {value} K, it must be positive and finite")]
    Temperature {
        /// The element.
        element: Element,
        /// The temperature, K.
        value: f64,
    },
    /// A heat capacity is not positive and finite.
    #[error(
        "the heat capacity of {element} is {value} J/K at {temperature} K, it must be positive and finite"
    )]
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
        "the viscosity of dashpot {dashpot} of {element} is {value} N s/m{}, it must be positive and finite",
        temperature.map_or_else(String::new, |theta| format!(" at {theta} K"))
    )]
    Viscosity {
        /// The element.
        element: Element,
        /// The dashpot, from 0.
        dashpot: usize,
        /// The viscosity, N s/m.
        value: f64,
        /// The temperature, K, if the model has one.
        temperature: Option<f64>,
    },
    /// No temperature has the entropy that the element must have.
    #[error("{element}: {source}")]
    NoSuchTemperature {
        /// The element.
        element: Element,
        /// The entropy, J/K.
        entropy: f64,
        /// What the inversion says.
        source: InversionError,
    },
    /// A quantity that a model computes is not finite.
    #[error("the {quantity} of {element} is {value}, it must be finite")]
    NotFinite {
        /// The element.
        element: Element,
        /// The quantity.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
}

/// A law that an exact scheme keeps in every step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Law {
    /// `ΔE = work + heat`, J.
    Energy,
    /// The balance of linear momentum of the scene, kg m/s.
    LinearMomentum,
    /// The balance of angular momentum of the scene, kg m²/s.
    AngularMomentum,
    /// Every dashpot and every path of heat produces entropy, J/K.
    Production,
    /// The entropy that is kept is that of the temperature, `s = s(λ, γ, θ)`, J/K.
    KeptEntropy,
}

impl Law {
    /// The unit of its defect.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Energy => "J",
            Self::LinearMomentum => "kg m/s",
            Self::AngularMomentum => "kg m²/s",
            Self::Production | Self::KeptEntropy => "J/K",
        }
    }
}

impl core::fmt::Display for Law {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Energy => "the energy",
            Self::LinearMomentum => "the linear momentum",
            Self::AngularMomentum => "the angular momentum",
            Self::Production => "the production of entropy",
            Self::KeptEntropy => "the entropy",
        })
    }
}

/// Why a step found no new state.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StepFailure {
    /// The motion of a mass is not finite.
    #[error("coordinate {axis} of the new {quantity} of node {node} is {value}, it must be finite")]
    Unbounded {
        /// The index of the node.
        node: usize,
        /// The axis, from 0.
        axis: usize,
        /// Position or momentum.
        quantity: &'static str,
        /// The value, m or kg m/s.
        value: f64,
    },
    /// Newton's method used up its iterations.
    #[error("Newton's method did not converge, its last scaled update was {update:.1e}")]
    NotConverged {
        /// The largest scaled update of the last iteration.
        update: f64,
    },
    /// The step that was found breaks a law of its scheme by more than rounding can.
    #[error(
        "{law} at t = {time:e} s is off by {defect:.3e} {unit}, where rounding explains {bound:.1e} {unit}{}; a smaller step may do",
        element.map_or_else(String::new, |element| format!(" (most of it in {element})")),
        unit = law.unit()
    )]
    LawNotKept {
        /// The law.
        law: Law,
        /// By how much it is broken, in the unit of the law.
        defect: f64,
        /// What rounding explains, in the same unit.
        bound: f64,
        /// The element that contributes most, if the law holds element by element.
        element: Option<Element>,
        /// The time at the end of the step, s.
        time: f64,
    },
    /// The tangent is singular.
    #[error("the tangent matrix is singular")]
    SingularTangent,
    /// A load is not finite.
    #[error(
        "component {axis} of the load on {node} is {value} N at t = {time} s, it must be finite"
    )]
    Load {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The component, N.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// The prescribed position of an anchor is not finite.
    #[error(
        "coordinate {axis} of the motion of {node} is {value} m at t = {time} s, it must be finite"
    )]
    Motion {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The coordinate, m.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// A prescribed temperature is not positive and finite.
    #[error(
        "the temperature prescribed on {element} is {value} K at t = {time} s, it must be positive and finite"
    )]
    PrescribedTemperature {
        /// The element.
        element: Element,
        /// The temperature, K.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// A run cannot end then.
    #[error("the end time is {end} s, it must be a number and not lie before the present time")]
    End {
        /// The end time, s.
        end: f64,
    },
    /// An event cannot be located so sharply.
    #[error("the tolerance of the event is {value} s, it must not be negative")]
    EventTolerance {
        /// The tolerance, s.
        value: f64,
    },
    /// The function whose change of sign is an event has no sign.
    #[error("the function of the event is not a number")]
    EventFunction,
    /// A trial state has the wrong number of unknowns.
    #[error("{given} unknowns were given, the scene has {expected}")]
    Unknowns {
        /// How many were given.
        given: usize,
        /// How many there are.
        expected: usize,
    },
    /// An element has no admissible state where Newton's method leads.
    #[error(transparent)]
    State(#[from] StateError),
}

/// A step that failed. The simulation is as it was before.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("step from t = {time} s by {step} s failed after {} iterations: {failure}", history.len())]
pub struct StepError {
    /// The time at which the step began, s.
    pub time: f64,
    /// The time step, s.
    pub step: f64,
    /// Why it failed.
    #[source]
    pub failure: StepFailure,
    /// What each iteration did.
    pub history: Box<[NewtonIteration]>,
}

/// One iteration of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonIteration {
    /// The largest residual of the momentum balances before the update, N s.
    pub residual: f64,
    /// The largest update, in units of the longest stretch and of the temperatures.
    pub update: f64,
}

//! Errors of scenes and rockets.

use crate::element::error::StateError;
use crate::element::handle::{Element, Handle, HeatPartner, Node, Reservoir};
use crate::element::lineage::Lineage;
use crate::scene::solid_error::SolidError;
use eem_material::number::readable::Readable;
use thiserror::Error;

/// Why a scene is rejected.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// A handle comes from another scene.
    #[error("{handle} belongs to another scene")]
    ForeignHandle {
        /// The handle as text.
        handle: String,
    },
    /// The scheme cannot step solids.
    #[error(
        "{scheme} is not for solids: their masses couple nodes, {why}; use eem-entropy or eem-temperature"
    )]
    NotForSolids {
        /// The name of the scheme.
        scheme: &'static str,
        /// The reason.
        why: &'static str,
    },
    /// A rocket is invalid, or the scheme does not support rockets.
    #[error(transparent)]
    Rocket(#[from] RocketError),
    /// The scheme does not support a dashpot in parallel with a spring.
    #[error(
        "{scheme} does not step the viscosity of the stretch that {element} has; use eem-entropy or eem-temperature"
    )]
    NoDrag {
        /// The name of the scheme.
        scheme: &'static str,
        /// The first such element.
        element: Element,
    },
    /// The matrix of Newton's method and its factors do not fit in memory.
    #[error(transparent)]
    TooLarge(#[from] crate::algebra::memory::TooLarge),
    /// A solid is invalid.
    #[error(transparent)]
    Solid(#[from] SolidError),
    /// A node of a solid does not have a property of point masses.
    #[error(
        "{node} belongs to a solid, whose mass couples nodes, and cannot have {quantity}; {instead}"
    )]
    NodeOfSolid {
        /// The node.
        node: Node,
        /// The requested property.
        quantity: &'static str,
        /// The remedy.
        instead: &'static str,
    },
    /// A point of a solid has no stretch and no force.
    #[error("{element} is a point of a solid, which has no {quantity}")]
    NotASpring {
        /// The point.
        element: Element,
        /// The requested quantity.
        quantity: &'static str,
    },
    /// A coordinate is not finite.
    #[error("coordinate {axis} of the position of {node} is {value} m, it must be finite", value = Readable(*value))]
    Position {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The coordinate, m.
        value: f64,
    },
    /// An anchor cannot have a property of masses, or the other way round.
    #[error("{node} cannot be given {quantity}: it is {kind}")]
    WrongKind {
        /// The node.
        node: Node,
        /// The property.
        quantity: &'static str,
        /// The kind of the node.
        kind: &'static str,
    },
    /// The acceleration of gravity is not finite.
    #[error("component {axis} of gravity is {value} m/s², it must be finite", value = Readable(*value))]
    Gravity {
        /// The axis, from 0.
        axis: usize,
        /// The component, m/s².
        value: f64,
    },
    /// A velocity is not finite.
    #[error("component {axis} of the velocity of {node} is {value} m/s, it must be finite", value = Readable(*value))]
    Velocity {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The component, m/s.
        value: f64,
    },
    /// A mass is not positive and finite.
    #[error("the mass of {node} is {value} kg, it must be positive and finite{}",
        if *value == 0.0 { ", or the node one of a solid" } else { "" }, value = Readable(*value))]
    Mass {
        /// The node.
        node: Node,
        /// The mass, kg.
        value: f64,
    },
    /// A parameter of a model is not finite.
    #[error("parameter `{parameter}` of {element} is {value}, it must be finite", value = Readable(*value))]
    Parameter {
        /// The element.
        element: Element,
        /// The name of the field.
        parameter: &'static str,
        /// Its value.
        value: f64,
    },
    /// The temperature of a reservoir is not positive and finite.
    #[error("the temperature of {reservoir} is {value} K, it must be positive and finite", value = Readable(*value))]
    ReservoirTemperature {
        /// The reservoir.
        reservoir: Reservoir,
        /// The temperature, K.
        value: f64,
    },
    /// A conductance is negative or not finite.
    #[error(
        "the conductance between {element} and {partner} is {value} W/K, it must be finite and not negative", value = Readable(*value))]
    Conductance {
        /// The element.
        element: Element,
        /// The other end of the path of heat.
        partner: HeatPartner,
        /// The conductance, W/K.
        value: f64,
    },
    /// Both ends of a spring are the same node.
    #[error("{element} connects {node} with itself")]
    SelfSpring {
        /// The spring.
        element: Element,
        /// The node.
        node: Node,
    },
    /// A constant force is not finite.
    #[error("component {axis} of the constant force on {node} is {value} N, it must be finite", value = Readable(*value))]
    DeadLoad {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The component, N.
        value: f64,
    },
    /// An element conducts heat to itself.
    #[error("{element} conducts heat to itself")]
    SelfConduction {
        /// The element.
        element: Element,
    },
    /// An element has no temperature.
    #[error("{element} has no temperature: its free energy has no `Temperature` argument")]
    NotThermal {
        /// The element.
        element: Element,
    },
    /// Heat or entropy of an oven is requested: the ledger and the paths of the oven count what it gives.
    #[error(
        "{reservoir} is an oven and keeps no heat: see the heat of the ledger, or `conducted_heat` of its paths"
    )]
    Oven {
        /// The oven.
        reservoir: Reservoir,
    },
    /// A controller sets a load that the scene prescribes.
    #[error(
        "the {quantity} of {handle} is given by the scene: leave it out there to set it in a run"
    )]
    GivenLoad {
        /// The node or the element.
        handle: String,
        /// The quantity.
        quantity: &'static str,
    },
    /// A controller sets the temperature of an element without a thermostat.
    #[error(
        "{element} has no thermostat: call `hold_temperature` for it in the scene to set its temperature in a run"
    )]
    NoThermostat {
        /// The element.
        element: Element,
    },
    /// Dissipation or heat is requested from a scheme without exact balances.
    #[error(
        "{scheme} has no exact balances, by which dissipation and heat are defined; take a scheme that keeps the laws"
    )]
    NotMetered {
        /// The name of the scheme.
        scheme: &'static str,
    },
    /// The quantities of a sum have several components or different units.
    #[error("a sum needs quantities with one component and one unit")]
    MixedSum,
    /// An element has no initial temperature.
    #[error("{element} was never given a temperature, call `set_temperature`")]
    MissingTemperature {
        /// The element.
        element: Element,
    },
    /// The model does not have this dashpot.
    #[error("{element} has {dashpots} dashpot{}, there is no dashpot {dashpot}", if *dashpots == 1 { "" } else { "s" })]
    NoSuchDashpot {
        /// The element.
        element: Element,
        /// The dashpot asked for, from 0.
        dashpot: usize,
        /// How many there are.
        dashpots: usize,
    },
    /// The time step is not finite, or below 2⁻⁵¹¹ s, the square of which is no normal number.
    #[error("the time step is {value} s, it must be finite and at least 1.5e-154 s", value = Readable(*value))]
    Step {
        /// The step, s.
        value: f64,
    },
    /// The start time is not finite.
    #[error("the start time is {value} s, it must be finite", value = Readable(*value))]
    StartTime {
        /// The time, s.
        value: f64,
    },
    /// A relative tolerance is outside (0, 1), or below the rounding floor of the scheme.
    #[error("the relative tolerance is {relative}, it must be less than 1 and, for this scheme, at least {floor:.0e}", relative = Readable(*relative))]
    Tolerance {
        /// The tolerance.
        relative: f64,
        /// The smallest tolerance of the scheme.
        floor: f64,
    },
    /// An absolute tolerance is negative or not finite.
    #[error("the absolute tolerance of {quantity} is {value} {unit}, it must be finite and not negative", value = Readable(*value))]
    AbsoluteTolerance {
        /// The quantity.
        quantity: &'static str,
        /// The tolerance.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// The time of a tolerance is not positive and finite.
    #[error("the errors of all steps in {} s are to be within the tolerance; that time must be positive and finite", Readable(*time))]
    ToleranceTime {
        /// The time, s.
        time: f64,
    },
    /// Limits of steps are invalid, or step control is off.
    #[error("steps from {smallest} to {largest} s: the smallest must be positive, the largest finite and not below it{}",
        if *is_controlled { "" } else { ", and steps must be controlled: call `control_steps` first" },
        smallest = Readable(*smallest), largest = Readable(*largest))]
    StepLimits {
        /// The smallest step, s.
        smallest: f64,
        /// The largest step, s.
        largest: f64,
        /// Whether step control is on.
        is_controlled: bool,
    },
    /// A time at which steps are to end is not finite.
    #[error("steps cannot end at {} s, the time must be finite", Readable(*time))]
    StopTime {
        /// The time, s.
        time: f64,
    },
    /// The duration of the shortest load is not positive and finite.
    #[error("the shortest load lasts {} s, which must be positive and finite", Readable(*duration))]
    ShortestLoad {
        /// The duration, s.
        duration: f64,
    },
    /// The scheme does not support step control.
    #[error(
        "the steps of {scheme} must have one size: its energy stays near its value only then; eem-entropy and eem-temperature keep it with any"
    )]
    FixedSteps {
        /// The scheme.
        scheme: &'static str,
    },
    /// Newton settings are invalid.
    #[error(
        "{max_iterations} iterations to a tolerance of {tolerance}: at least one iteration and a tolerance between 0 and 1 are needed", tolerance = Readable(*tolerance))]
    NewtonSettings {
        /// The number of iterations.
        max_iterations: usize,
        /// The tolerance.
        tolerance: f64,
    },
    /// The momentum of a mass is not finite.
    #[error("component {axis} of the momentum of {node} is {value} kg m/s, it must be finite", value = Readable(*value))]
    Momentum {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The component, kg m/s.
        value: f64,
    },
    /// The kinetic energy of a mass is not finite.
    #[error(
        "the kinetic energy p²/2m of {node} is {value} J, it must be finite: its momentum is {momentum} kg m/s, its mass {mass} kg",
        value = Readable(*value), momentum = Readable(*momentum), mass = Readable(*mass)
    )]
    KineticEnergy {
        /// The node.
        node: Node,
        /// The kinetic energy, J.
        value: f64,
        /// The magnitude of the momentum, kg m/s.
        momentum: f64,
        /// The mass, kg.
        mass: f64,
    },
    /// The weight of a mass is not finite.
    #[error("component {axis} of the weight m g of {node} is {value} N, it must be finite", value = Readable(*value))]
    Weight {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The component, N.
        value: f64,
    },
    /// The initial heat flow or entropy flow of a conductance, or the sum at an element, is not finite.
    #[error(
        "the {quantity} from {partner} to {element} at the start is {value} {unit}, it must be finite, and so must the sum of all flows to an element",
        value = Readable(*value)
    )]
    HeatFlow {
        /// The element.
        element: Element,
        /// The other end of the path of heat.
        partner: HeatPartner,
        /// Heat flow `Q = κ (θ_partner − θ)`, or flow of entropy `Q/θ` at the colder end.
        quantity: &'static str,
        /// The flow along this path, W or W/K.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// A sum over the scene in its initial state is not finite, although each term is.
    #[error(
        "the {quantity} of the scene at the start is {value} {unit}, it must be finite: the terms of its sum are too large",
        value = Readable(*value)
    )]
    Total {
        /// An entry of the ledger.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// The prescribed motion of an anchor does not begin where the anchor was created.
    #[error(
        "coordinate {axis} of the motion of {node} is {prescribed} m at the start, but the anchor was created at {created} m: create it where its motion begins",
        created = Readable(*created), prescribed = Readable(*prescribed)
    )]
    AnchorJump {
        /// The anchor.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The coordinate given to [`Scene::anchor`](crate::Scene::anchor), m.
        created: f64,
        /// The coordinate that the motion has at the start, m.
        prescribed: f64,
    },
    /// A prescribed temperature does not begin at the initial one.
    #[error(
        "the temperature prescribed on {element} is {prescribed} K at the start, but its initial temperature is {initial} K: set the temperature with which the thermostat begins",
        initial = Readable(*initial), prescribed = Readable(*prescribed)
    )]
    TemperatureJump {
        /// The element.
        element: Element,
        /// The temperature given to [`Scene::set_temperature`](crate::Scene::set_temperature), K.
        initial: f64,
        /// The temperature that is prescribed at the start, K.
        prescribed: f64,
    },
    /// Something is prescribed twice.
    #[error("{quantity} of {handle} is prescribed twice")]
    PrescribedTwice {
        /// The handle as text.
        handle: String,
        /// The prescribed quantity.
        quantity: &'static str,
    },
    /// The initial state of an element is outside the domain of its model.
    #[error("at the start: {0}")]
    State(StateError),
}

impl SceneError {
    /// An error unless an element has a dashpot with this number, from 0.
    pub(crate) fn expect_dashpot(
        element: Element,
        dashpot: usize,
        dashpots: usize,
    ) -> Result<(), Self> {
        if dashpot < dashpots {
            return Ok(());
        }
        Err(Self::NoSuchDashpot {
            element,
            dashpot,
            dashpots,
        })
    }

    /// An error unless a node is a mass or an anchor, as required for a quantity.
    pub(crate) fn expect_kind(
        node: Node,
        [is_mass, required]: [bool; 2],
        quantity: &'static str,
    ) -> Result<(), Self> {
        if is_mass == required {
            return Ok(());
        }
        Err(Self::WrongKind {
            node,
            quantity,
            kind: if is_mass { "a mass" } else { "an anchor" },
        })
    }
}

impl From<StateError> for SceneError {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}

impl Lineage {
    /// An error unless a handle is valid in the scene.
    pub(crate) fn expect<H: Handle>(&self, handle: &H) -> Result<(), SceneError> {
        if self.owns(handle) {
            return Ok(());
        }
        let handle = handle.to_string();
        Err(SceneError::ForeignHandle { handle })
    }
}

/// Why a [rocket](crate::Scene::rocket) is rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RocketError {
    /// The scheme does not support forces that turn within a step.
    #[error(
        "{scheme} does not step the rocket at {node}, whose force turns within a step; use eem-entropy or eem-temperature"
    )]
    Scheme {
        /// The name of the scheme.
        scheme: &'static str,
        /// The node with the first rocket.
        node: Node,
    },
    /// The line goes from a node to itself.
    #[error(
        "the rocket at {node} pushes along a line from {end} to itself, which has no direction"
    )]
    NoLine {
        /// The node that it pushes.
        node: Node,
        /// The only node of the line.
        end: Node,
    },
    /// The line joins two anchors at the same position.
    #[error(
        "the rocket at {node} pushes along a line from {tail} to {head}, which are anchors in the same place, so that it has no direction; put one of them elsewhere"
    )]
    NoLength {
        /// The node that it pushes.
        node: Node,
        /// The beginning of the line.
        tail: Node,
        /// The end of the line.
        head: Node,
    },
}

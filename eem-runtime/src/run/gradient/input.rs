//! What is differentiated, by what: objectives, inputs, and loads whose values in the course of time are inputs.

use core::fmt;
use core::ops::Add;
use std::sync::Arc;

use crate::element::handle::{Element, HeatPath, Node, Reservoir};
use crate::element::kinematics::Shape;
use crate::element::lineage::Lineage;
use crate::run::gradient::error::GradientError;
use crate::run::recorder::{Quantity, axis_name};
use crate::scene::bulk::Body;
use crate::scene::error::SceneError;
use crate::scene::loads::ScalarOfTime;
use nalgebra::SVector;

/// A vector as a function of time in s.
pub(crate) type OfTime<const D: usize> = Arc<dyn Fn(f64) -> SVector<f64, D> + Send + Sync>;

/// An input of a run, for [`Simulation::sensitivities`](crate::Simulation::sensitivities).
///
/// | | |
/// |---|---|
/// | [`parameter`](Self::parameter), [`parameter_of`](Self::parameter_of) | of the material of an element, or of several |
/// | [`mass`](Self::mass), [`density`](Self::density), [`gravity`](Self::gravity) | |
/// | [`conductance`](Self::conductance), [`reservoir_temperature`](Self::reservoir_temperature) | of conduction |
/// | [`position`](Self::position), [`velocity`](Self::velocity), [`temperature`](Self::temperature), [`viscous_stretch`](Self::viscous_stretch) | at the start |
/// | [`force`](Self::force), [`thrust`](Self::thrust), [`motion`](Self::motion), [`thermostat`](Self::thermostat), [`oven`](Self::oven) | a parameter α of a function of time, given its derivative by α |
#[derive(Clone)]
pub struct Input<const D: usize> {
    pub(crate) of: InputOf<D>,
    /// The name and the unit that were given.
    pub(crate) named: Option<[String; 2]>,
}

/// The kinds of inputs.
#[derive(Clone)]
pub(crate) enum InputOf<const D: usize> {
    Parameter(Vec<Element>, String),
    Mass(Node),
    /// A node of the body, and the masses of pairs of nodes per density.
    Density(Node, Vec<([usize; 2], f64)>),
    Gravity(usize),
    Conductance(HeatPath),
    Reservoir(Reservoir),
    Position(Node, usize),
    Velocity(Node, usize),
    Temperature(Element),
    ViscousStretch(Element, usize),
    /// A parameter of a force or a motion.
    Vector(Timed, OfTime<D>),
    /// A parameter of a thrust or a temperature.
    Number(Timed, ScalarOfTime),
}

impl<const D: usize> Input<D> {
    const fn new(of: InputOf<D>) -> Self {
        Self { of, named: None }
    }

    /// A parameter of an element, with the name that its struct gives it: `stiffness`, or `mu[2]` in an array.
    pub fn parameter(element: Element, name: impl Into<String>) -> Self {
        Self::parameter_of([element], name)
    }

    /// A parameter that several elements of one model have in common, such as the points of a body.
    pub fn parameter_of(
        elements: impl IntoIterator<Item = Element>,
        name: impl Into<String>,
    ) -> Self {
        let elements = elements.into_iter().collect();
        Self::new(InputOf::Parameter(elements, name.into()))
    }

    /// A mass, kg; its velocity at the start is kept.
    #[must_use]
    pub const fn mass(node: Node) -> Self {
        Self::new(InputOf::Mass(node))
    }

    /// The density of a body, with its velocities at the start kept, kg/m³.
    #[must_use]
    pub fn density<H: Shape<D>>(body: &Body<H, D>) -> Self {
        Self::new(InputOf::Density(
            body.nodes()[0],
            body.pair_masses().collect(),
        ))
    }

    /// A component, from 0, of the acceleration of free fall, m/s².
    #[must_use]
    pub const fn gravity(axis: usize) -> Self {
        Self::new(InputOf::Gravity(axis))
    }

    /// The conductance of a path of heat, W/K.
    #[must_use]
    pub const fn conductance(path: HeatPath) -> Self {
        Self::new(InputOf::Conductance(path))
    }

    /// The temperature of a reservoir, K; for an oven, a constant that is added to its function.
    #[must_use]
    pub const fn reservoir_temperature(reservoir: Reservoir) -> Self {
        Self::new(InputOf::Reservoir(reservoir))
    }

    /// A component, from 0, of the position of a node at the start, m; for an anchor, of a shift of its position at all times.
    #[must_use]
    pub const fn position(node: Node, axis: usize) -> Self {
        Self::new(InputOf::Position(node, axis))
    }

    /// A component, from 0, of the velocity of a node at the start, m/s. Of all anchors, only moved ones next to solids have one.
    #[must_use]
    pub const fn velocity(node: Node, axis: usize) -> Self {
        Self::new(InputOf::Velocity(node, axis))
    }

    /// The temperature of an element at the start, K.
    #[must_use]
    pub const fn temperature(element: Element) -> Self {
        Self::new(InputOf::Temperature(element))
    }

    /// A viscous stretch, from 0, of an element at the start.
    #[must_use]
    pub const fn viscous_stretch(element: Element, dashpot: usize) -> Self {
        Self::new(InputOf::ViscousStretch(element, dashpot))
    }

    /// A parameter α of the force on a mass, given `∂f/∂α` as a function of time.
    pub fn force<V: Into<SVector<f64, D>>>(
        node: Node,
        by: impl Fn(f64) -> V + Send + Sync + 'static,
    ) -> Self {
        Self::vector(Timed::Force(node), by)
    }

    /// A parameter of a thrust, given `∂F/∂α`. `rocket` counts the rockets of the node in the order of their creation, from 0.
    pub fn thrust(
        node: Node,
        rocket: usize,
        by: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self::number(Timed::Thrust(node, rocket), by)
    }

    /// A parameter of the position of a moved anchor, given `∂X/∂α`. Next to a solid, its velocity at the start is an input
    /// of its own, [`velocity`](Self::velocity).
    pub fn motion<V: Into<SVector<f64, D>>>(
        anchor: Node,
        by: impl Fn(f64) -> V + Send + Sync + 'static,
    ) -> Self {
        Self::vector(Timed::Motion(anchor), by)
    }

    /// A parameter of the temperature of a thermostat, given `∂θ/∂α`.
    pub fn thermostat(element: Element, by: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::number(Timed::Thermostat(element), by)
    }

    /// A parameter of the temperature of an oven, given `∂θ/∂α`.
    pub fn oven(oven: Reservoir, by: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::number(Timed::Oven(oven), by)
    }

    fn vector<V: Into<SVector<f64, D>>>(
        load: Timed,
        by: impl Fn(f64) -> V + Send + Sync + 'static,
    ) -> Self {
        Self::new(InputOf::Vector(load, Arc::new(move |t| by(t).into())))
    }

    fn number(load: Timed, by: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self::new(InputOf::Number(load, Arc::new(by)))
    }

    /// The load of which it is a parameter.
    pub(super) const fn load(&self) -> Option<Timed> {
        match self.of {
            InputOf::Vector(load, _) | InputOf::Number(load, _) => Some(load),
            _ => None,
        }
    }

    /// Gives it a name and a unit, for the columns of results; a parameter of a function of time has no unit otherwise.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>, unit: impl Into<String>) -> Self {
        self.named = Some([name.into(), unit.into()]);
        self
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> String {
        if let Some([name, _]) = &self.named {
            return name.clone();
        }
        match &self.of {
            InputOf::Parameter(elements, name) => match elements[..] {
                [first] => format!("{name} of {first}"),
                [first, ..] => format!("{name} of {first} and {} others", elements.len() - 1),
                [] => format!("{name} of no element"),
            },
            InputOf::Mass(node) => format!("mass of {node}"),
            InputOf::Density(..) => "density".to_owned(),
            InputOf::Gravity(axis) => format!("gravity {}", axis_name(*axis)),
            InputOf::Conductance(path) => format!("conductance of {path}"),
            InputOf::Reservoir(reservoir) => format!("temperature of {reservoir}"),
            InputOf::Position(node, axis) => format!("position {} of {node}", axis_name(*axis)),
            InputOf::Velocity(node, axis) => format!("velocity {} of {node}", axis_name(*axis)),
            InputOf::Temperature(element) => format!("temperature of {element}"),
            InputOf::ViscousStretch(element, dashpot) => {
                format!("viscous stretch {dashpot} of {element}")
            }
            InputOf::Vector(load, _) | InputOf::Number(load, _) => load.name(),
        }
    }

    /// Its unit; empty if it depends on a material or only the user knows it.
    pub(crate) const fn unit(&self) -> &'static str {
        match &self.of {
            InputOf::Mass(_) => "kg",
            InputOf::Density(..) => "kg/m³",
            InputOf::Gravity(_) => "m/s²",
            InputOf::Conductance(_) => "W/K",
            InputOf::Reservoir(_) | InputOf::Temperature(_) => "K",
            InputOf::Position(..) => "m",
            InputOf::Velocity(..) => "m/s",
            InputOf::Parameter(..)
            | InputOf::ViscousStretch(..)
            | InputOf::Vector(..)
            | InputOf::Number(..) => "",
        }
    }
}

impl<const D: usize> fmt::Debug for Input<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Input").field(&self.name()).finish()
    }
}

/// A load whose values in the course of time are inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Timed {
    Force(Node),
    Motion(Node),
    /// A rocket by its number among those of its node.
    Thrust(Node, usize),
    Thermostat(Element),
    Oven(Reservoir),
}

impl Timed {
    /// What tells it from the other loads of its scene: its kind, the index of its handle, and its number there.
    pub(crate) fn key(self) -> [usize; 3] {
        match self {
            Self::Force(node) => [0, node.index, 0],
            Self::Motion(node) => [1, node.index, 0],
            Self::Thrust(node, rocket) => [2, node.index, rocket],
            Self::Thermostat(element) => [3, element.index(), 0],
            Self::Oven(oven) => [4, oven.index, 0],
        }
    }

    /// An error unless its handle is valid in a scene.
    pub(crate) fn expect_in(self, scene: &Lineage) -> Result<(), SceneError> {
        match self {
            Self::Force(node) | Self::Motion(node) | Self::Thrust(node, _) => scene.expect(&node),
            Self::Thermostat(element) => scene.expect(&element),
            Self::Oven(oven) => scene.expect(&oven),
        }
    }

    /// Its name as an input.
    pub(crate) fn name(self) -> String {
        match self {
            Self::Force(node) => format!("force on {node}"),
            Self::Motion(node) => format!("motion of {node}"),
            Self::Thrust(node, rocket) => format!("thrust {rocket} on {node}"),
            Self::Thermostat(element) => format!("temperature of {element}"),
            Self::Oven(oven) => format!("temperature of {oven}"),
        }
    }

    /// The error that the scene has no such load.
    #[cold]
    pub(crate) fn missing(self) -> GradientError {
        let why = match self {
            Self::Force(node) => format!("{node} has no force"),
            Self::Motion(node) => format!("{node} is not moved"),
            Self::Thrust(node, rocket) => format!("{node} has no rocket {rocket}"),
            Self::Thermostat(element) => format!("{element} has no thermostat"),
            Self::Oven(oven) => format!("{oven} is not an oven"),
        };
        GradientError::NoSeries { why }
    }
}

/// A number that follows from the states of a run, see [`Simulation::gradient`](crate::Simulation::gradient).
///
/// | | |
/// |---|---|
/// | [`at_end`](Self::at_end), [`at`](Self::at) | a quantity at the end, or at the end of another step |
/// | [`integral`](Self::integral) | `Σ ½h (g⁰ + g¹)` over the steps |
/// | [`misfit`](Self::misfit) | `½ Σ ((g(tᵢ) − dᵢ)/σᵢ)²` |
/// | [`time`](Self::time) | the time at the end, s |
/// | [`component`](Self::component), [`times`](Self::times), `+` | one component of a vector; a factor; sums |
#[derive(Debug)]
pub struct Objective<const D: usize> {
    pub(crate) terms: Vec<Term<D>>,
    /// The factor of the time at the end.
    pub(crate) time: f64,
}

/// A quantity with the way in which it counts.
#[derive(Debug)]
pub(crate) struct Term<const D: usize> {
    pub(crate) factor: f64,
    pub(crate) quantity: Quantity<D>,
    pub(crate) component: usize,
    pub(crate) when: When,
}

/// The times at which a quantity counts.
#[derive(Clone, Debug)]
pub(crate) enum When {
    End,
    /// At this time, s.
    At(f64),
    Integral,
    /// Times, data and their standard deviations.
    Misfit(Vec<[f64; 3]>),
}

impl<const D: usize> Objective<D> {
    fn new(quantity: Quantity<D>, when: When) -> Self {
        let term = Term {
            factor: 1.0,
            quantity,
            component: 0,
            when,
        };
        Self {
            terms: vec![term],
            time: 0.0,
        }
    }

    /// A quantity at the end of the run; of a vector the first component.
    #[must_use]
    pub fn at_end(quantity: Quantity<D>) -> Self {
        Self::new(quantity, When::End)
    }

    /// A quantity at a time at which a step ends, s.
    #[must_use]
    pub fn at(time: f64, quantity: Quantity<D>) -> Self {
        Self::new(quantity, When::At(time))
    }

    /// The integral of a quantity over the time of the history, by the trapezoidal rule over its steps.
    #[must_use]
    pub fn integral(quantity: Quantity<D>) -> Self {
        Self::new(quantity, When::Integral)
    }

    /// Half the sum of the squares of `(g(t) − d)/σ` over records (t, d, σ); steps must end at the times, s, and σ be
    /// positive.
    #[must_use]
    pub fn misfit(quantity: Quantity<D>, records: impl IntoIterator<Item = [f64; 3]>) -> Self {
        Self::new(quantity, When::Misfit(records.into_iter().collect()))
    }

    /// The time at the end of the run, s. If an event ends it, [`gradient_at_event`](crate::Simulation::gradient_at_event) finds
    /// the derivatives; otherwise only those by the sizes of steps are not zero.
    #[must_use]
    pub const fn time() -> Self {
        Self {
            terms: Vec::new(),
            time: 1.0,
        }
    }

    /// Takes this component, from 0, of all its vector quantities.
    #[must_use]
    pub fn component(mut self, component: usize) -> Self {
        for term in &mut self.terms {
            term.component = component;
        }
        self
    }

    /// Multiplies it by a factor.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        for term in &mut self.terms {
            term.factor *= factor;
        }
        self.time *= factor;
        self
    }

    /// Its unit; empty if it is not known, or terms have different ones.
    pub(crate) fn unit(&self) -> String {
        let of_time = (self.time != 0.0).then(|| "s".to_owned());
        let units = self.terms.iter().map(|term| match term.when {
            When::End | When::At(_) => term.quantity.unit().to_owned(),
            When::Integral if term.quantity.unit().is_empty() => String::new(),
            When::Integral => format!("{} s", term.quantity.unit()),
            When::Misfit(_) => "1".to_owned(),
        });
        let mut units = units.chain(of_time);
        let first = units.next().unwrap_or_default();
        if units.all(|unit| unit == first) {
            first
        } else {
            String::new()
        }
    }
}

impl<const D: usize> Add for Objective<D> {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self.terms.extend(other.terms);
        self.time += other.time;
        self
    }
}

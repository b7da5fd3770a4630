//! Inputs, with respect to which a run is differentiated.

use core::fmt;
use std::sync::Arc;

use nalgebra::SVector;

use crate::element::handle::{Element, HeatPath, Node, Reservoir};
use crate::element::kinematics::Shape;
use crate::run::gradient::timed::Timed;
use crate::run::recorder::axis_name;
use crate::scene::body::Body;
use crate::scene::loads::{OfTime, ScalarOfTime};

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

//! The gradient of an objective.

use core::fmt;
use std::collections::BTreeSet;

use super::error::GradientError;
use super::input::{Input, Timed};
use super::series::Series;
use crate::element::handle::{Element, HeatPath, Node, Reservoir};
use crate::element::kinematics::Shape;
use crate::element::layout::Slots;
use crate::element::lineage::Lineage;
use crate::element::loads::point;
use crate::scene::bulk::Body;
use crate::scene::error::SceneError;
use crate::step::adjoint::PerVariable;
use eem_material::number::scalar::Scalar;
use nalgebra::SVector;

/// The value of an [`Objective`](crate::Objective) and its derivatives with respect to all inputs of a run, each in the unit of
/// the objective over that of the input.
///
/// `Display` prints the value and the derivatives by the parameters of every element, a line each with the unit, and a note if
/// derivatives grow by more than a million; [`iter`](Self::iter) has the derivatives by all inputs that are numbers.
#[derive(Clone, Debug)]
pub struct Gradient<const D: usize> {
    pub(crate) scene: Lineage,
    pub(crate) value: f64,
    /// The unit of the objective.
    pub(crate) unit: String,
    pub(crate) growth: f64,
    pub(crate) start: PerVariable,
    /// The nodes with a mass.
    pub(crate) moving: Vec<usize>,
    pub(crate) masses: Vec<f64>,
    /// By the masses that two nodes have in common, and by those of solids at anchors, in order.
    pub(crate) pairs: Vec<([usize; 2], f64)>,
    pub(crate) gravity: SVector<f64, D>,
    pub(crate) conductances: Vec<f64>,
    pub(crate) reservoirs: Vec<f64>,
    pub(crate) elements: Vec<OfElement>,
    /// By the sizes of steps, with the times at their ends, s, and with the values of functions of time kept.
    pub(crate) sizes: Vec<(f64, f64)>,
    /// The time at the start, s, and the loads that are functions of time.
    pub(crate) started: f64,
    pub(crate) timed: Vec<Timed>,
    /// By forces in the middle of each step, and by positions of moved anchors at its ends.
    pub(crate) vectors: Vec<(Timed, Series<SVector<f64, D>>)>,
    /// By thrusts of rockets and temperatures of ovens in the middle of each step, and by temperatures of thermostats at its end.
    pub(crate) numbers: Vec<(Timed, Series<f64>)>,
}

/// The name of an input, the derivative by it, and its unit.
type Derivative = (String, f64, String);

/// The growth above which `Display` adds a note.
const NOTED: f64 = 1e6;

/// The derivatives by the parameters of an element.
#[derive(Clone, Debug)]
pub(crate) struct OfElement {
    pub(crate) element: Element,
    pub(crate) slots: Slots,
    pub(crate) dashpots: usize,
    pub(crate) names: &'static [&'static str],
    /// Empty for a model without units.
    pub(crate) units: &'static [&'static str],
    pub(crate) viscous_unit: &'static str,
    pub(crate) values: Vec<f64>,
}

impl<const D: usize> Gradient<D> {
    /// The value of the objective.
    #[must_use]
    pub const fn value(&self) -> f64 {
        self.value
    }

    /// The largest effect of a relative change of a state on the objective, over the effect of the same change of the last state.
    /// It grows without limit along chaotic motions. Errors of the gradient are about ε times the growth.
    #[must_use]
    pub const fn growth(&self) -> f64 {
        self.growth
    }

    /// Names, derivatives and their units of all inputs that are numbers: parameters of elements, masses, gravity, conductances,
    /// temperatures of reservoirs, and positions, velocities, temperatures and viscous stretches at the start. Where a unit is not
    /// known, it is empty.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{History, Objective};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let stone = scene.mass(2.0, [0.0], [3.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.25)?;
    /// run.keep_history(History::default());
    /// run.run_until(1.0)?;
    /// let gradient = run.gradient(&Objective::at_end(Quantity::Position(stone)))?;
    /// let found = gradient.iter().find(|(name, ..)| name == "velocity x of node 0");
    /// assert_eq!(found, Some(("velocity x of node 0".to_owned(), 1.0, "m/(m/s)".to_owned())));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn iter(&self) -> impl Iterator<Item = Derivative> + '_ {
        let mut all = self.parameters();
        let by_input = |input: Input<D>, by: f64| self.named(input.name(), by, input.unit());
        let (scene, start) = (&self.scene, &self.start);
        // Masses of solids are no inputs.
        let of_solids: BTreeSet<usize> = self.pairs.iter().flat_map(|(nodes, _)| *nodes).collect();
        for &node in self.moving.iter().filter(|node| !of_solids.contains(node)) {
            all.push(by_input(Input::mass(scene.node(node)), self.masses[node]));
        }
        for (axis, &by) in self.gravity.iter().enumerate() {
            all.push(by_input(Input::gravity(axis), by));
        }
        for (index, &by) in self.conductances.iter().enumerate() {
            let scene = scene.scene();
            all.push(by_input(Input::conductance(HeatPath { scene, index }), by));
        }
        for (index, &by) in self.reservoirs.iter().enumerate() {
            let reservoir = scene.reservoir(index);
            all.push(by_input(Input::reservoir_temperature(reservoir), by));
        }
        for (at, &by) in start.positions.iter().enumerate() {
            all.push(by_input(Input::position(scene.node(at / D), at % D), by));
        }
        for (at, &by) in start.velocities.iter().enumerate() {
            all.push(by_input(Input::velocity(scene.node(at / D), at % D), by));
        }
        for own in &self.elements {
            let element = own.element;
            if let Some(slot) = own.slots.thermal {
                all.push(by_input(
                    Input::temperature(element),
                    start.temperatures[slot],
                ));
            }
            let viscous = &start.viscous[own.slots.viscous..][..own.dashpots];
            for (dashpot, &by) in viscous.iter().enumerate() {
                let name = Input::<D>::viscous_stretch(element, dashpot).name();
                all.push(self.named(name, by, own.viscous_unit));
            }
        }
        all.into_iter()
    }

    fn named(&self, name: String, by: f64, unit: &str) -> Derivative {
        (name, by, quotient(&self.unit, unit))
    }

    fn parameters(&self) -> Vec<Derivative> {
        let mut all = Vec::new();
        for own in &self.elements {
            for (at, (name, &by)) in own.names.iter().zip(&own.values).enumerate() {
                let unit = own.units.get(at).copied().unwrap_or_default();
                all.push(self.named(format!("{name} of {}", own.element), by, unit));
            }
        }
        all
    }

    /// The derivative by a parameter of an element, with the name that its struct gives it: `stiffness`, or `mu[2]` in an
    /// array.
    ///
    /// # Errors
    ///
    /// [`GradientError::UnknownParameter`], [`GradientError::NoParameterDerivatives`], [`GradientError::Scene`].
    pub fn by_parameter(&self, element: Element, name: &str) -> Result<f64, GradientError> {
        let own = self.of(element)?;
        let Some(at) = own.names.iter().position(|own| *own == name) else {
            return Err(GradientError::no_parameter(&element, name, own.names));
        };
        let value = own.values[at];
        if value.is_finite() {
            return Ok(value);
        }
        let model = element.model();
        Err(GradientError::NoParameterDerivatives { model })
    }

    /// The derivative by the position of a node at the start; for an anchor, by a shift of its position at all times.
    ///
    /// # Errors
    ///
    /// [`GradientError::Scene`] if the node is of another scene; the same for all below.
    pub fn by_position(&self, node: Node) -> Result<SVector<f64, D>, GradientError> {
        self.scene.expect(&node)?;
        Ok(point(&self.start.positions, node.index).into())
    }

    /// The derivative by the velocity of a node at the start. Of all anchors, only moved ones next to solids have one, that of
    /// their motion at the start. Its effect is not part of [`by_motion`](Self::by_motion).
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position).
    pub fn by_velocity(&self, node: Node) -> Result<SVector<f64, D>, GradientError> {
        self.scene.expect(&node)?;
        Ok(point(&self.start.velocities, node.index).into())
    }

    /// The derivative by a mass, with its velocity kept; zero for an anchor. For solids use
    /// [`by_density`](Self::by_density).
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position).
    pub fn by_mass(&self, node: Node) -> Result<f64, GradientError> {
        self.scene.expect(&node)?;
        Ok(self.masses[node.index])
    }

    /// The derivative by the density of a body, with the velocities kept.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position).
    pub fn by_density<H: Shape<D>>(&self, body: &Body<H, D>) -> Result<f64, GradientError> {
        let mut sum = 0.0;
        for node in body.nodes() {
            self.scene.expect(node)?;
        }
        for (nodes, mass) in body.pair_masses() {
            let pair = self.pairs.binary_search_by_key(&nodes, |&(nodes, _)| nodes);
            sum += mass * pair.map_or(0.0, |at| self.pairs[at].1);
            let [i, j] = nodes;
            if i == j {
                sum += mass * self.masses[i];
            }
        }
        Ok(sum)
    }

    /// The derivative by the temperature of an element at the start.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position); [`SceneError::NotThermal`] if it has none.
    pub fn by_temperature(&self, element: Element) -> Result<f64, GradientError> {
        let own = self.of(element)?;
        let Some(slot) = own.slots.thermal else {
            return Err(SceneError::NotThermal { element }.into());
        };
        Ok(self.start.temperatures[slot])
    }

    /// The derivative by a viscous stretch, from 0, of an element at the start.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position); [`GradientError::Component`] if there is no such dashpot.
    pub fn by_viscous_stretch(
        &self,
        element: Element,
        dashpot: usize,
    ) -> Result<f64, GradientError> {
        let own = self.of(element)?;
        let quantity = || format!("the viscous stretch of {element}");
        GradientError::expect_component(quantity, dashpot, own.dashpots)?;
        Ok(self.start.viscous[own.slots.viscous + dashpot])
    }

    /// The derivative by the conductance of a path of heat.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position).
    pub fn by_conductance(&self, path: HeatPath) -> Result<f64, GradientError> {
        self.scene.expect(&path)?;
        Ok(self.conductances[path.index])
    }

    /// The derivative by the temperature of a reservoir; for an oven, by a constant that is added to its function.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position).
    pub fn by_reservoir_temperature(&self, reservoir: Reservoir) -> Result<f64, GradientError> {
        self.scene.expect(&reservoir)?;
        Ok(self.reservoirs[reservoir.index])
    }

    /// The derivative by the acceleration of free fall.
    #[must_use]
    pub const fn by_gravity(&self) -> SVector<f64, D> {
        self.gravity
    }

    /// The derivatives by the force on a mass in each step, with the time in its middle, s. [`Series::contract`] gives the
    /// derivative by a parameter of the force.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position); [`GradientError::NoSeries`] if no force acts on it.
    pub fn by_force(&self, node: Node) -> Result<&Series<SVector<f64, D>>, GradientError> {
        self.vectors_by(Timed::Force(node))
    }

    /// The derivatives by the thrust of a rocket in each step, with the time in its middle, s. `rocket` counts the rockets of the
    /// node in the order of their creation, from 0.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position); [`GradientError::NoSeries`] if there is no such rocket.
    pub fn by_thrust(&self, node: Node, rocket: usize) -> Result<&Series<f64>, GradientError> {
        self.numbers_by(Timed::Thrust(node, rocket))
    }

    /// The derivatives by the temperature of an oven in each step, with the time in its middle, s.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position); [`GradientError::NoSeries`] if the temperature is not a function of time.
    pub fn by_oven(&self, oven: Reservoir) -> Result<&Series<f64>, GradientError> {
        self.numbers_by(Timed::Oven(oven))
    }

    /// The derivatives by the position of a moved anchor at the ends of all steps, with their times, s. Their sum is
    /// [`by_position`](Self::by_position). Next to solids there are also positions at the thirds of steps, from which the
    /// velocity of the anchor follows; for that at the start see [`by_velocity`](Self::by_velocity).
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position); [`GradientError::NoSeries`] if it is not moved.
    pub fn by_motion(&self, anchor: Node) -> Result<&Series<SVector<f64, D>>, GradientError> {
        self.vectors_by(Timed::Motion(anchor))
    }

    /// The derivatives by the temperature that a thermostat reaches at the end of each step, with its time, s.
    ///
    /// # Errors
    ///
    /// As [`by_position`](Self::by_position); [`GradientError::NoSeries`] without a thermostat.
    pub fn by_thermostat(&self, element: Element) -> Result<&Series<f64>, GradientError> {
        self.numbers_by(Timed::Thermostat(element))
    }

    pub(super) fn vectors_by(
        &self,
        load: Timed,
    ) -> Result<&Series<SVector<f64, D>>, GradientError> {
        load.expect_in(&self.scene)?;
        series(&self.vectors, load)
    }

    pub(super) fn numbers_by(&self, load: Timed) -> Result<&Series<f64>, GradientError> {
        load.expect_in(&self.scene)?;
        series(&self.numbers, load)
    }

    /// All derivatives: state, masses, gravity, conductances, reservoirs, parameters, sizes of steps.
    #[doc(hidden)]
    #[must_use]
    pub fn numbers(&self) -> Vec<f64> {
        let others = [&self.masses, &self.conductances, &self.reservoirs];
        let others = others.into_iter().flatten().chain(self.gravity.iter());
        let parameters = self.elements.iter().flat_map(|element| &element.values);
        let pairs = self.pairs.iter().map(|(_, by)| by);
        let sizes = self.sizes.iter().map(|(_, by)| by);
        let others = others.chain(parameters).chain(pairs).chain(sizes);
        self.start.numbers().chain(others.copied()).collect()
    }

    fn of(&self, element: Element) -> Result<&OfElement, GradientError> {
        self.scene.expect(&element)?;
        Ok(&self.elements[element.index()])
    }
}

/// The series of a load.
fn series<T>(all: &[(Timed, Series<T>)], load: Timed) -> Result<&Series<T>, GradientError> {
    let mut own = all.iter().filter(|(own, _)| own.key() == load.key());
    let (_, series) = own.next().ok_or_else(|| load.missing())?;
    Ok(series)
}

impl<const D: usize> fmt::Display for Gradient<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut lines = self.parameters();
        lines.insert(0, ("value".to_owned(), self.value, self.unit.clone()));
        let widest = |of: fn(&Derivative) -> &String| {
            let widths = lines.iter().map(|line| of(line).chars().count());
            widths.max().unwrap_or(0)
        };
        let [width, unit_width] = [widest(|(name, ..)| name), widest(|(.., unit)| unit)];
        for (name, value, unit) in &lines {
            let value = format!("{value:.15e}");
            writeln!(f, "| {name:<width$} | {value:<22} | {unit:<unit_width$} |")?;
        }
        if self.growth > NOTED {
            let digits = -Scalar::log10(f64::EPSILON * self.growth);
            let digits = digits.floor().max(0.0);
            let growth = self.growth;
            writeln!(
                f,
                "Derivatives grow by {growth:.0e}: the motion is sensitive, and about {digits} digits are left."
            )?;
        }
        Ok(())
    }
}

/// The unit of the derivative of a number by another, given their units; empty where one of them is unknown. The unit of a
/// number without unit is `1`.
///
/// It is the quotient as it stands: `m/(N/m)` and not `m²/N`.
pub(crate) fn quotient(of: &str, by: &str) -> String {
    match (of, by) {
        ("", _) | (_, "") => String::new(),
        (of, "1") => of.to_owned(),
        (of, by) if of == by => "1".to_owned(),
        (of, by) => format!(
            "{}/{}",
            grouped(of, &['/']),
            grouped(by, &['/', ' ', '*', '·'])
        ),
    }
}

/// A unit in parentheses if it has one of these signs.
fn grouped(unit: &str, signs: &[char]) -> String {
    if unit.contains(signs) {
        format!("({unit})")
    } else {
        unit.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::quotient;

    #[test]
    fn quotients_can_be_read_one_way() {
        for (of, by, expected) in [
            ("K", "N m", "K/(N m)"),
            ("m", "N/m", "m/(N/m)"),
            ("J/K", "kg", "(J/K)/kg"),
            ("m", "m", "1"),
            ("m", "1", "m"),
            ("1", "kg", "1/kg"),
            ("", "kg", ""),
            ("m", "", ""),
        ] {
            assert_eq!(quotient(of, by), expected);
        }
    }
}

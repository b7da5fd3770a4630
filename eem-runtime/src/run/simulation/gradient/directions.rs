//! Directions in which inputs change: from the inputs that users name to what changes in a step.

use super::derivatives::{Of, Passage, viscous_unit};
use super::inputs::{CUBIC, Made};
use crate::element::handle::Element;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::input::OfTime;
use crate::run::gradient::input::{Input, InputOf, Timed};
use crate::run::simulation::Simulation;
use crate::scene::loads::ScalarOfTime;
use crate::step::adjoint::{Direction, HeatChange, PerVariable, Tangents};
use nalgebra::SVector;

/// The changes of all inputs along which a run is differentiated. A list is empty if no input of its kind changes.
pub(super) struct Change<const D: usize> {
    /// The state at the start, without functions of time.
    pub(super) start: PerVariable,
    pub(super) parameters: Vec<Vec<f64>>,
    pub(super) masses: Vec<f64>,
    pub(super) pairs: Vec<f64>,
    pub(super) gravity: SVector<f64, D>,
    pub(super) heat: HeatChange,
    /// Forces and motions, and thrusts and temperatures, as functions of time.
    pub(super) vectors: Vec<(Timed, OfTime<D>)>,
    pub(super) numbers: Vec<(Timed, ScalarOfTime)>,
}

/// The way forward through a history.
pub(super) struct Forward<const D: usize> {
    pub(super) passage: Passage<D>,
    pub(super) anchors: Vec<usize>,
    /// The directions: all their inputs, their heat in the present step, and the changes of the state.
    pub(super) changes: Vec<Change<D>>,
    pub(super) heats: Vec<HeatChange>,
    pub(super) directions: Vec<Direction>,
    pub(super) tangents: Tangents<D>,
}

impl<const D: usize> Change<D> {
    /// The change of the state at the start, including that of prescribed motions at this time.
    pub(super) fn start_at(&self, time: f64) -> PerVariable {
        let mut start = self.start.clone();
        for (anchor, by) in self.motions() {
            add_at(&mut start.positions, anchor, by(time));
        }
        start
    }

    /// The changes of the positions of anchors, by node.
    fn motions(&self) -> impl Iterator<Item = (usize, &OfTime<D>)> {
        self.vectors.iter().filter_map(|(load, by)| match load {
            Timed::Motion(anchor) => Some((anchor.index, by)),
            _ => None,
        })
    }
}

/// Adds a vector to that of a node.
fn add_at<const D: usize>(all: &mut [f64], node: usize, by: SVector<f64, D>) {
    for (own, by) in all[node * D..][..D].iter_mut().zip(&by) {
        *own += by;
    }
}

/// The derivative `by`, taken with respect to `of`, times the change of `of` in a direction.
pub(super) fn along<const D: usize>(
    (change, state): (&Change<D>, &PerVariable),
    of: Of<'_>,
    by: f64,
) -> f64 {
    let input = |all: &[f64], at: usize| all.get(at).copied().unwrap_or(0.0);
    by * (match of {
        Of::Position(at) => state.positions[at],
        Of::Velocity(at) => state.velocities[at],
        Of::Viscous(slot) => state.viscous[slot],
        Of::Temperature(slot) => state.temperatures[slot],
        Of::Entropy(index) => state.reservoirs[index],
        Of::Mass(node) => input(&change.masses, node),
        Of::Pair(place) => input(&change.pairs, place),
        Of::Gravity(axis) => change.gravity[axis],
        Of::Reservoir(index) => input(&change.heat.reservoirs, index),
        Of::Parameters(element, values) => {
            let own = change.parameters.get(element).into_iter().flatten();
            own.zip(values).fold(0.0, |sum, (&a, &b)| sum + a * b)
        }
    })
}

/// A list of zeros, with a one at this place.
fn one_of(count: usize, place: usize) -> Vec<f64> {
    let mut all = vec![0.0; count];
    if let Some(own) = all.get_mut(place) {
        *own = 1.0;
    }
    all
}

impl<const D: usize> Simulation<D> {
    /// The change in which no input changes.
    pub(super) fn no_change(&self, passage: &Passage<D>) -> Change<D> {
        let reservoirs = self.run.conduction.reservoirs.len();
        Change {
            start: PerVariable::zero(self.run.masses.len() * D, &passage.layout, reservoirs),
            parameters: Vec::new(),
            masses: Vec::new(),
            pairs: Vec::new(),
            gravity: SVector::from_element(0.0),
            heat: HeatChange {
                conductances: Vec::new(),
                reservoirs: Vec::new(),
            },
            vectors: Vec::new(),
            numbers: Vec::new(),
        }
    }

    /// The change in which one input changes by one.
    pub(super) fn change_by(
        &self,
        input: &Input<D>,
        passage: &Passage<D>,
    ) -> Result<Change<D>, GradientError> {
        let mut change = self.no_change(passage);
        let reservoirs = self.run.conduction.reservoirs.len();
        match &input.of {
            InputOf::Parameter(elements, name) => {
                change.parameters = vec![Vec::new(); self.run.places.len()];
                for &element in elements {
                    change.parameters[element.index()] = self.parameter_of(element, name)?;
                }
            }
            InputOf::Mass(node) => {
                self.run.expect_own(node)?;
                change.masses = one_of(self.run.masses.len(), node.index);
            }
            InputOf::Density(node, masses) => {
                self.run.expect_own(node)?;
                change.masses = vec![0.0; self.run.masses.len()];
                change.pairs = vec![0.0; passage.pairs.len()];
                for &([i, j], mass) in masses {
                    if let Ok(place) = passage.pairs.binary_search(&[i, j]) {
                        change.pairs[place] += mass;
                    }
                    if i == j {
                        change.masses[i] += mass;
                    }
                }
            }
            &InputOf::Gravity(axis) => {
                GradientError::expect_component(|| "gravity".to_owned(), axis, D)?;
                change.gravity[axis] = 1.0;
            }
            InputOf::Conductance(path) => {
                self.run.expect_own(path)?;
                let paths = self.run.conduction.path_ends().len();
                change.heat.conductances = one_of(paths, path.index);
            }
            InputOf::Reservoir(reservoir) => {
                self.run.expect_own(reservoir)?;
                change.heat.reservoirs = one_of(reservoirs, reservoir.index);
            }
            &InputOf::Position(node, axis) => {
                self.run.expect_own(&node)?;
                let quantity = || format!("the position of {node}");
                GradientError::expect_component(quantity, axis, D)?;
                change.start.positions[node.index * D + axis] = 1.0;
            }
            &InputOf::Velocity(node, axis) => {
                self.run.expect_own(&node)?;
                let quantity = || format!("the velocity of {node}");
                GradientError::expect_component(quantity, axis, D)?;
                change.start.velocities[node.index * D + axis] = 1.0;
                self.drop_velocities(&mut change);
            }
            &InputOf::Temperature(element) => {
                let slot = self.run.thermal_slot(element)?;
                change.start.temperatures[slot] = 1.0;
            }
            &InputOf::ViscousStretch(element, dashpot) => {
                self.run.expect_own(&element)?;
                let dashpots = self.run.shape(element).dashpots;
                let quantity = || format!("the viscous stretch of {element}");
                GradientError::expect_component(quantity, dashpot, dashpots)?;
                let first = self.run.slots(element).viscous;
                change.start.viscous[first + dashpot] = 1.0;
            }
            InputOf::Vector(load, by) => {
                self.expect_load(*load)?;
                change.vectors.push((*load, by.clone()));
            }
            InputOf::Number(load, by) => {
                self.expect_load(*load)?;
                if let Timed::Oven(_) = load {
                    change.heat.reservoirs = vec![0.0; reservoirs];
                }
                change.numbers.push((*load, by.clone()));
            }
        }
        Ok(change)
    }

    /// An error unless the scene has this load.
    fn expect_load(&self, load: Timed) -> Result<(), GradientError> {
        load.expect_in(&self.run.scene)?;
        if let Timed::Thermostat(element) = load {
            self.run.thermal_slot(element)?;
        }
        let all = self.timed_loads();
        if all.iter().any(|(own, _)| own.key() == load.key()) {
            Ok(())
        } else {
            Err(load.missing())
        }
    }

    /// Drops changes of initial velocities that anchors do not have: only moved ones that masses couple with other nodes have one.
    pub(super) fn drop_velocities(&self, change: &mut Change<D>) {
        let are_moved = self.run.are_moved();
        for node in self.run.masses.anchors() {
            if !(self.run.masses.are_coupled() && are_moved[node]) {
                change.start.velocities[node * D..][..D].fill(0.0);
            }
        }
    }

    /// The changes of the parameters of an element if one of them changes by one.
    fn parameter_of(&self, element: Element, name: &str) -> Result<Vec<f64>, GradientError> {
        self.run.expect_own(&element)?;
        let [group, _] = self.run.place(element);
        let group = self.run.stepper.elements(group);
        let known = group.parameters();
        let Some(place) = known.iter().position(|own| *own == name) else {
            return Err(GradientError::no_parameter(&element, name, known));
        };
        if !group.has_parameter_derivatives() {
            let model = element.model();
            return Err(GradientError::NoParameterDerivatives { model });
        }
        Ok(one_of(known.len(), place))
    }

    /// The unit of an input; empty if it is not known.
    pub(super) fn unit_of(&self, input: &Input<D>) -> String {
        if let Some([_, unit]) = &input.named {
            return unit.clone();
        }
        let own = |element: &Element| self.run.scene.owns(element);
        let unit = match &input.of {
            InputOf::Parameter(elements, name) => elements.first().and_then(|&element| {
                let [group, _] = own(&element).then(|| self.run.place(element))?;
                let group = self.run.stepper.elements(group);
                let place = group.parameters().iter().position(|own| *own == name)?;
                group.parameter_units().get(place).copied()
            }),
            &InputOf::ViscousStretch(element, _) => {
                own(&element).then(|| viscous_unit(&self.run.shape(element)))
            }
            _ => Some(input.unit()),
        };
        unit.unwrap_or_default().to_owned()
    }

    /// Sets what changes in a step from outside: the new state of anchors and of prescribed temperatures, the conduction of heat,
    /// and the momentum balances of masses with their loads.
    pub(super) fn enter(&self, made: Made<'_>, way: &mut Forward<D>) {
        let (h, [old, new]) = made;
        let middle = old.time.value + 0.5 * h;
        let passage = &way.passage;
        let all = way.changes.iter().zip(&mut way.directions);
        for ((change, direction), heat) in all.zip(&mut way.heats) {
            direction.right.fill([0.0]);
            let (from, to) = (&direction.old, &mut direction.new);
            to.positions.copy_from_slice(&from.positions);
            to.reservoirs.copy_from_slice(&from.reservoirs);
            for &node in &way.anchors {
                to.velocities[node * D..][..D].fill(0.0);
            }
            self.move_anchors(made, change, to);
            for (slot, is_held) in passage.held.iter().enumerate() {
                if *is_held {
                    to.temperatures[slot] = 0.0;
                }
            }
            heat.clone_from(&change.heat);
            let mut push = |node: usize, force: SVector<f64, D>| {
                if let Some(row) = passage.layout.nodes[node] {
                    add_at(direction.right[row..].as_flattened_mut(), 0, force);
                }
            };
            for (load, by) in &change.vectors {
                if let Timed::Force(node) = load {
                    push(node.index, by(middle) * h);
                }
            }
            for (load, by) in &change.numbers {
                match *load {
                    Timed::Thrust(node, number) => {
                        let own = self.run.loads.rockets.iter().zip(&passage.rockets);
                        let mut own = own.filter(|(rocket, _)| rocket.line.node == node);
                        if let Some((_, rocket)) = own.nth(number) {
                            let along: SVector<f64, D> = rocket.direction.into();
                            push(node.index, along * (h * by(middle)));
                        }
                    }
                    Timed::Thermostat(element) => {
                        if let Some(slot) = self.run.slots(element).thermal {
                            direction.new.temperatures[slot] += by(new.time.value);
                        }
                    }
                    Timed::Oven(oven) => heat.reservoirs[oven.index] += by(middle),
                    Timed::Force(_) | Timed::Motion(_) => {}
                }
            }
            if change.gravity.iter().any(|&axis| axis != 0.0) {
                for (node, &sum) in passage.sums.iter().enumerate() {
                    push(node, change.gravity * (h * sum));
                }
            }
            for (node, &by) in change.masses.iter().enumerate() {
                if let Some(mass) = self.run.masses.get(node) {
                    push(node, self.pushed(made, node, mass) * -by);
                }
            }
            for (&[i, j], &by) in passage.pairs.iter().zip(&change.pairs) {
                push(i, self.pushed(made, j, 1.0) * -by);
                push(j, self.pushed(made, i, 1.0) * -by);
            }
        }
    }

    /// Sets the changes of new positions and velocities for anchors whose motion changes.
    fn move_anchors(&self, (h, [old, new]): Made<'_>, change: &Change<D>, to: &mut PerVariable) {
        for (node, _) in change.motions() {
            let own = node * D..(node + 1) * D;
            to.positions[own.clone()].copy_from_slice(&change.start.positions[own]);
        }
        let start = old.time.value;
        for (node, by) in change.motions() {
            let end = by(new.time.value);
            let mut speed = SVector::<f64, D>::from_element(0.0);
            if self.run.masses.are_coupled() {
                for (thirds, weight) in CUBIC {
                    let at = start + thirds * (h / 3.0);
                    speed += (end - by(at)) * (0.5 * weight / h);
                }
            }
            add_at(&mut to.positions, node, end);
            add_at(&mut to.velocities, node, speed);
        }
    }
}

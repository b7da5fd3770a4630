//! Directions in which inputs change: from the inputs that users name to what changes in a step.

use super::change::Change;
use super::derivatives::Outline;
use super::forward::Forward;
use super::inputs::{CUBIC, Made};
use crate::element::handle::{Element, Handle};
use crate::run::gradient::error::GradientError;
use crate::run::gradient::input::{Input, InputOf};
use crate::run::simulation::Simulation;
use crate::scene::error::SceneError;
use crate::step::adjoint::{Direction, HeatChange, PerVariable};
use nalgebra::SVector;

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
    pub(super) fn no_change(&self, outline: &Outline) -> Change<D> {
        let reservoirs = self.conduction.reservoirs.len();
        Change {
            start: PerVariable::zero(self.masses.len() * D, &outline.layout, reservoirs),
            parameters: Vec::new(),
            masses: Vec::new(),
            pairs: Vec::new(),
            gravity: SVector::from_element(0.0),
            heat: HeatChange {
                conductances: Vec::new(),
                reservoirs: Vec::new(),
            },
            forces: Vec::new(),
            thrusts: Vec::new(),
            motions: Vec::new(),
            temperatures: Vec::new(),
            ovens: Vec::new(),
        }
    }

    /// The change in which one input changes by one.
    pub(super) fn change_by(
        &self,
        input: &Input<D>,
        outline: &Outline,
    ) -> Result<Change<D>, GradientError> {
        let mut change = self.no_change(outline);
        let component = |what: String, component: usize, components: usize| {
            let error = GradientError::Component {
                quantity: what,
                component,
                components,
            };
            if component < components {
                Ok(())
            } else {
                Err(error)
            }
        };
        match &input.of {
            InputOf::Parameter(elements, name) => {
                change.parameters = vec![Vec::new(); self.places.len()];
                for &element in elements {
                    change.parameters[element.index()] = self.parameter_of(element, name)?;
                }
            }
            InputOf::Mass(node) => {
                self.expect(node)?;
                change.masses = one_of(self.masses.len(), node.index);
            }
            InputOf::Density(node, masses) => {
                self.expect(node)?;
                change.masses = vec![0.0; self.masses.len()];
                change.pairs = vec![0.0; outline.pairs.len()];
                for &([i, j], mass) in masses {
                    if let Ok(place) = outline.pairs.binary_search(&[i, j]) {
                        change.pairs[place] += mass;
                    }
                    if i == j {
                        change.masses[i] += mass;
                    }
                }
            }
            &InputOf::Gravity(axis) => {
                component("gravity".to_owned(), axis, D)?;
                change.gravity[axis] = 1.0;
            }
            InputOf::Conductance(path) => {
                self.expect(path)?;
                let paths = self.conduction.path_ends().len();
                change.heat.conductances = one_of(paths, path.index);
            }
            InputOf::Reservoir(reservoir) => {
                self.expect(reservoir)?;
                let reservoirs = self.conduction.reservoirs.len();
                change.heat.reservoirs = one_of(reservoirs, reservoir.index);
            }
            &InputOf::Position(node, axis) => {
                self.expect(&node)?;
                component(format!("the position of {node}"), axis, D)?;
                change.start.positions[node.index * D + axis] = 1.0;
            }
            &InputOf::Velocity(node, axis) => {
                self.expect(&node)?;
                component(format!("the velocity of {node}"), axis, D)?;
                change.start.velocities[node.index * D + axis] = 1.0;
                self.drop_velocities(&mut change);
            }
            &InputOf::Temperature(element) => {
                let slot = self.slot_of(element, outline)?;
                change.start.temperatures[slot] = 1.0;
            }
            &InputOf::ViscousStretch(element, dashpot) => {
                self.expect(&element)?;
                let [group, _] = self.places[element.index()];
                let dashpots = self.shapes[group as usize].dashpots;
                component(
                    format!("the viscous stretch of {element}"),
                    dashpot,
                    dashpots,
                )?;
                let first = outline.layout.elements[element.index()].viscous;
                change.start.viscous[first + dashpot] = 1.0;
            }
            of => self.change_of_function(of, outline, &mut change)?,
        }
        Ok(change)
    }

    /// Adds to `change` that a parameter of a function of time changes by one.
    fn change_of_function(
        &self,
        of: &InputOf<D>,
        outline: &Outline,
        change: &mut Change<D>,
    ) -> Result<(), GradientError> {
        let none = |why: String| Err(GradientError::NoSeries { why });
        match of {
            InputOf::Force(node, by) => {
                self.expect(node)?;
                if !self
                    .loads
                    .forces
                    .iter()
                    .any(|(own, _)| own.index == node.index)
                {
                    return none(format!("{node} has no force"));
                }
                change.forces.push((node.index, by.clone()));
            }
            InputOf::Thrust(node, rocket, by) => {
                self.expect(node)?;
                let rockets = self.loads.rockets.iter().enumerate();
                let mut own = rockets.filter(|(_, own)| own.line.node.index == node.index);
                let Some((place, _)) = own.nth(*rocket) else {
                    return none(format!("{node} has no rocket {rocket}"));
                };
                change.thrusts.push((place, by.clone()));
            }
            InputOf::Motion(node, by) => {
                self.expect(node)?;
                if !self.is_moved(node.index) {
                    return none(format!("{node} is not moved"));
                }
                change.motions.push((node.index, by.clone()));
            }
            InputOf::Thermostat(element, by) => {
                let slot = self.slot_of(*element, outline)?;
                let mut held = self.loads.temperatures.iter();
                if !held.any(|(own, _)| own.index() == element.index()) {
                    return none(format!("{element} has no thermostat"));
                }
                change.temperatures.push((slot, by.clone()));
            }
            InputOf::Oven(oven, by) => {
                self.expect(oven)?;
                if !self.is_oven(oven.index) {
                    return none(format!("{oven} is not an oven"));
                }
                let reservoirs = self.conduction.reservoirs.len();
                change.heat.reservoirs = vec![0.0; reservoirs];
                change.ovens.push((oven.index, by.clone()));
            }
            _ => {}
        }
        Ok(())
    }

    fn is_moved(&self, node: usize) -> bool {
        let mut motions = self.loads.motions.iter();
        motions.any(|(own, _)| own.index == node)
    }

    /// Drops changes of initial velocities that anchors do not have: only moved ones that masses couple with other nodes have one.
    pub(super) fn drop_velocities(&self, change: &mut Change<D>) {
        for node in self.masses.anchors() {
            if !(self.masses.are_coupled() && self.is_moved(node)) {
                change.start.velocities[node * D..][..D].fill(0.0);
            }
        }
    }

    fn expect<H: Handle>(&self, handle: &H) -> Result<(), GradientError> {
        if self.scene.owns(handle) {
            return Ok(());
        }
        let handle = handle.to_string();
        Err(SceneError::ForeignHandle { handle }.into())
    }

    fn slot_of(&self, element: Element, outline: &Outline) -> Result<usize, GradientError> {
        self.expect(&element)?;
        let slot = outline.layout.elements[element.index()].thermal;
        slot.ok_or_else(|| SceneError::NotThermal { element }.into())
    }

    /// The changes of the parameters of an element if one of them changes by one.
    fn parameter_of(&self, element: Element, name: &str) -> Result<Vec<f64>, GradientError> {
        self.expect(&element)?;
        let [group, _] = self.places[element.index()];
        let group = self.stepper.elements(group as usize);
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
        let group_of = |element: &Element| self.places[element.index()][0] as usize;
        match &input.of {
            InputOf::Parameter(elements, name) => {
                let group = elements
                    .first()
                    .map(|own| self.stepper.elements(group_of(own)));
                let found = group.and_then(|group| {
                    let place = group.parameters().iter().position(|own| *own == name)?;
                    group.parameter_units().get(place)
                });
                found.copied().unwrap_or_default().to_owned()
            }
            InputOf::ViscousStretch(element, _) => self.viscous_unit(group_of(element)).to_owned(),
            _ => input.unit().to_owned(),
        }
    }

    /// The unit of the viscous stretches of a group.
    pub(super) fn viscous_unit(&self, group: usize) -> &'static str {
        match self.shapes[group].viscous_unit {
            "" => "1",
            unit => unit,
        }
    }

    /// Sets what changes in a step from outside: the new state of anchors and of prescribed temperatures, the conduction of heat,
    /// and the momentum balances of masses with their loads.
    pub(super) fn enter(&self, made: Made<'_>, way: &mut Forward<D>) {
        let (h, [old, new]) = made;
        let middle = old.time.value + 0.5 * h;
        let all = way.changes.iter().zip(&mut way.directions);
        for ((change, direction), heat) in all.zip(&mut way.heats) {
            direction.right.fill([0.0]);
            let Direction {
                old: from, new: to, ..
            } = direction;
            to.positions.copy_from_slice(&from.positions);
            to.reservoirs.copy_from_slice(&from.reservoirs);
            for &node in &way.anchors {
                to.velocities[node * D..][..D].fill(0.0);
            }
            self.move_anchors(made, change, direction);
            for (slot, _) in way.held.iter().enumerate().filter(|(_, is_held)| **is_held) {
                direction.new.temperatures[slot] = 0.0;
            }
            for (slot, by) in &change.temperatures {
                direction.new.temperatures[*slot] += by(new.time.value);
            }
            heat.clone_from(&change.heat);
            for (oven, by) in &change.ovens {
                heat.reservoirs[*oven] += by(middle);
            }
            let rows = &way.outline.layout.nodes;
            let mut push = |node: usize, force: SVector<f64, D>| {
                if let Some(row) = rows[node] {
                    for axis in 0..D {
                        direction.right[row + axis][0] += force[axis];
                    }
                }
            };
            for (node, by) in &change.forces {
                push(*node, by(middle) * h);
            }
            for (place, by) in &change.thrusts {
                let along: SVector<f64, D> = way.rockets[*place].direction.into();
                let node = self.loads.rockets[*place].line.node.index;
                push(node, along * (h * by(middle)));
            }
            if change.gravity.iter().any(|&axis| axis != 0.0) {
                for (node, &sum) in way.outline.sums.iter().enumerate() {
                    push(node, change.gravity * (h * sum));
                }
            }
            for (node, &by) in change.masses.iter().enumerate() {
                if let Some(mass) = self.masses.get(node) {
                    push(node, self.pushed(made, node, mass) * -by);
                }
            }
            for (&[i, j], &by) in way.outline.pairs.iter().zip(&change.pairs) {
                push(i, self.pushed(made, j, 1.0) * -by);
                push(j, self.pushed(made, i, 1.0) * -by);
            }
        }
    }

    /// Sets the changes of new positions and velocities for anchors whose motion changes.
    fn move_anchors(
        &self,
        (h, [old, new]): Made<'_>,
        change: &Change<D>,
        direction: &mut Direction,
    ) {
        for (node, _) in &change.motions {
            let own = *node * D..(*node + 1) * D;
            direction.new.positions[own.clone()].copy_from_slice(&change.start.positions[own]);
        }
        let start = old.time.value;
        for (node, by) in &change.motions {
            let end = by(new.time.value);
            let mut speed = SVector::<f64, D>::from_element(0.0);
            if self.masses.are_coupled() {
                for (thirds, weight) in CUBIC {
                    let at = start + thirds * (h / 3.0);
                    speed += (end - by(at)) * (0.5 * weight / h);
                }
            }
            for (axis, at) in (*node * D..).take(D).enumerate() {
                direction.new.positions[at] += end[axis];
                direction.new.velocities[at] += speed[axis];
            }
        }
    }
}

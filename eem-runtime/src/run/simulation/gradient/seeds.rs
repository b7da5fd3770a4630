//! The value of an objective, and its derivatives by the states of a history.

use core::mem;

use super::add;
use crate::element::group::ElementGeneric;
use crate::element::handle::{Element, Node};
use crate::element::layout::Layout;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::history::Kept;
use crate::run::gradient::objective::{Objective, Term, When};
use crate::run::gradient::result::Gradient;
use crate::run::recorder::Quantity;
use crate::run::simulation::Simulation;
use crate::run::simulation::stepper::Stepper;
use crate::step::adjoint::Costate;
use eem_material::number::scalar::{Mask, Real};
use nalgebra::SVector;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// The value of an objective, and the weights of its quantities in the state after each number of steps.
    pub(super) fn seeds(
        &mut self,
        kept: &Kept<S>,
        objective: &Objective<D, S>,
    ) -> Result<(f64, Vec<Vec<f64>>), GradientError> {
        let mut value = 0.0;
        let mut seeds = Vec::with_capacity(objective.terms.len());
        for term in &objective.terms {
            let mut weights = vec![0.0; kept.steps.len() + 1];
            if let When::Misfit(records) = &term.when {
                for &[time, datum, deviation] in records {
                    let at = end_of(kept, time)?;
                    let misfit = (self.value_at(kept, term, at)? - datum) / deviation;
                    weights[at] += term.factor * misfit / deviation;
                    value += 0.5 * term.factor * misfit * misfit;
                }
            } else {
                share(kept, &term.when, &mut weights)?;
                for (at, weight) in weights.iter_mut().enumerate() {
                    if *weight != 0.0 {
                        *weight *= term.factor;
                        value += *weight * self.value_at(kept, term, at)?;
                    }
                }
            }
            seeds.push(weights);
        }
        Ok((value, seeds))
    }

    /// A quantity in a state of the history.
    fn value_at(
        &mut self,
        kept: &Kept<S>,
        term: &Term<D, S>,
        steps: usize,
    ) -> Result<f64, GradientError> {
        let present = mem::replace(&mut *self.state, kept.state(steps).clone());
        let values = term.quantity.present(self);
        *self.state = present;
        let values = values?;
        let component = term.component;
        values.get(component).copied().ok_or_else(|| {
            let quantity = term.quantity.kind();
            GradientError::Component {
                quantity,
                component,
                components: values.len(),
            }
        })
    }

    /// Adds the derivatives of the quantities in the state after so many steps.
    pub(super) fn add_seeds(
        &mut self,
        kept: &Kept<S>,
        (steps, seeds): (usize, &[Vec<f64>]),
        objective: &Objective<D, S>,
        (layout, costate, found): (&Layout, &mut Costate<S>, &mut Gradient<D, S>),
    ) -> Result<(), GradientError> {
        let place = |costate: &Costate<S>, node: usize| {
            SVector::<S, D>::from_fn(|axis, _| costate.positions[node * D + axis])
        };
        let motions = found.motions.iter();
        let before: Vec<_> = motions.map(|&(node, _)| place(costate, node)).collect();
        for (term, weights) in objective.terms.iter().zip(seeds) {
            let weight = S::from_f64(weights[steps]);
            if !weight.equal(S::zero()).all() {
                self.add_seed(
                    kept,
                    (steps, weight),
                    term,
                    (layout, &mut *costate, &mut *found),
                )?;
            }
        }
        let time = kept.state(steps).time.value;
        for ((node, series), before) in found.motions.iter_mut().zip(before) {
            let own = place(costate, *node) - before;
            match series.last_mut() {
                Some((_, last)) => *last += own,
                None => series.push((time, own)),
            }
        }
        Ok(())
    }

    /// The same of one quantity with a weight.
    fn add_seed(
        &mut self,
        kept: &Kept<S>,
        (steps, weight): (usize, S),
        term: &Term<D, S>,
        (layout, costate, found): (&Layout, &mut Costate<S>, &mut Gradient<D, S>),
    ) -> Result<(), GradientError> {
        let state = kept.state(steps);
        let at = |node: &Node| node.index * D + term.component;
        let velocities = |node: usize, mass: S| state.velocity::<D>(node, mass);
        let slots = |element: &Element| layout.elements[element.index()];
        match &term.quantity {
            Quantity::Position(node) => costate.positions[at(node)] += weight,
            Quantity::Velocity(node) if self.masses.get(node.index).is_some() => {
                costate.velocities[at(node)] += weight;
            }
            Quantity::Momentum(node) if !self.masses.are_coupled() => {
                if let Some(mass) = self.masses.get(node.index) {
                    costate.velocities[at(node)] += weight * mass;
                    found.masses[node.index] +=
                        weight * velocities(node.index, mass)[term.component];
                }
            }
            Quantity::Stretch(element) => {
                let [group, place] = self.places[element.index()].map(|index| index as usize);
                let &[a, b] = self.stepper.elements(group).nodes(place) else {
                    return Err(no_derivative(&term.quantity));
                };
                let positions = state.positions.values();
                let arm: SVector<S, D> = SVector::from_fn(|axis, _| {
                    positions[b as usize * D + axis] - positions[a as usize * D + axis]
                });
                let length = arm.iter().fold(S::zero(), |sum, &x| sum + x * x).sqrt();
                for axis in 0..D {
                    let entry = weight * arm[axis] / length;
                    costate.positions[b as usize * D + axis] += entry;
                    costate.positions[a as usize * D + axis] -= entry;
                }
            }
            Quantity::ViscousStretch(element, dashpot) => {
                costate.viscous[slots(element).viscous + dashpot] += weight;
            }
            Quantity::Temperature(element) => {
                if let Some(slot) = slots(element).thermal {
                    costate.temperatures[slot] += weight;
                }
            }
            Quantity::ReservoirEntropy(reservoir) => {
                costate.reservoirs[reservoir.index] += weight;
            }
            Quantity::ReservoirHeat(reservoir) => {
                let theta = self.conduction.reservoirs[reservoir.index];
                costate.reservoirs[reservoir.index] += weight * theta;
                let entropy = state.reservoir_entropies.values()[reservoir.index];
                found.reservoirs[reservoir.index] += weight * entropy;
            }
            Quantity::KineticEnergy => self.add_kinetic(kept, (steps, weight), (costate, found)),
            Quantity::TotalEnergy => {
                self.add_kinetic(kept, (steps, weight), (costate, found));
                self.add_potential(kept, (steps, weight), (costate, found));
                self.add_internal(kept, (steps, weight), (costate, found));
                for (index, &theta) in self.conduction.reservoirs.iter().enumerate() {
                    costate.reservoirs[index] += weight * theta;
                    found.reservoirs[index] += weight * state.reservoir_entropies.values()[index];
                }
            }
            other => return Err(no_derivative(other)),
        }
        Ok(())
    }

    /// `½ vᵀ M v`.
    fn add_kinetic(
        &self,
        kept: &Kept<S>,
        (steps, weight): (usize, S),
        (costate, found): (&mut Costate<S>, &mut Gradient<D, S>),
    ) {
        let momenta = kept.state(steps).momenta.values();
        let half = S::from_f64(0.5);
        for (node, mass) in self.masses.iter().enumerate() {
            let Some(mass) = mass else { continue };
            let velocity = kept.state(steps).velocity::<D>(node, mass);
            for axis in 0..D {
                costate.velocities[node * D + axis] += weight * momenta[node * D + axis];
                found.masses[node] += weight * half * velocity[axis] * velocity[axis];
            }
        }
    }

    /// `−Σ m g·q`.
    fn add_potential(
        &self,
        kept: &Kept<S>,
        (steps, weight): (usize, S),
        (costate, found): (&mut Costate<S>, &mut Gradient<D, S>),
    ) {
        let positions = kept.state(steps).positions.values();
        let sums = self.masses.weights();
        for (node, &sum) in sums.iter().enumerate() {
            let is_mass = self.masses.get(node).is_some();
            for axis in 0..D {
                let (at, fall) = (node * D + axis, self.loads.gravity[axis]);
                costate.positions[at] -= weight * sum * fall;
                found.gravity[axis] -= weight * sum * positions[at];
                if is_mass {
                    found.masses[node] -= weight * fall * positions[at];
                }
            }
        }
    }

    /// `Σ e` of all elements.
    fn add_internal(
        &mut self,
        kept: &Kept<S>,
        (steps, weight): (usize, S),
        (costate, found): (&mut Costate<S>, &mut Gradient<D, S>),
    ) {
        let state = kept.state(steps);
        // The elements are evaluated elsewhere than at the ends of their last step.
        self.has_stepped = false;
        let Stepper::Newton(newton) = &mut self.stepper else {
            return;
        };
        for group in &mut newton.groups {
            for slopes in group.elements_mut().generic_in(state) {
                add_energy(&slopes, weight, costate);
            }
            group.energy_by_parameters(state, &mut |element, values| {
                add(&mut found.elements[element.index()].values, weight, values);
            });
        }
    }
}

/// Adds the derivatives of an internal energy at fixed temperature: `∂e = f ∂π − g ∂γ + θ ∂s`.
fn add_energy<S: Real>(element: &ElementGeneric<S>, weight: S, costate: &mut Costate<S>) {
    for &(at, force) in &element.forces {
        costate.positions[at] += weight * force;
    }
    for &(slot, force, _) in &element.dashpots {
        costate.viscous[slot] -= weight * force;
    }
    let (Some((_, theta)), Some(entropy)) = (element.temperature, &element.entropy) else {
        return;
    };
    let weight = weight * theta;
    for &(at, slope) in &entropy.by_position {
        costate.positions[at] += weight * slope;
    }
    for &(slot, slope) in &entropy.by_viscous {
        costate.viscous[slot] += weight * slope;
    }
    costate.temperatures[entropy.slot] += weight * entropy.by_temperature;
}

#[cold]
fn no_derivative<const D: usize, S: Real>(quantity: &Quantity<D, S>) -> GradientError {
    let quantity = quantity.kind();
    GradientError::NoDerivative { quantity }
}

/// Roundings, in ε of the time, by which a time may differ from the end of its step: half a unit each of the number that was
/// given and of the time of the run, and what steps of rounded sizes add.
const ROUNDINGS: f64 = 4.0;

/// The number of steps that end at a time.
fn end_of<S: Real>(kept: &Kept<S>, time: f64) -> Result<usize, GradientError> {
    let of = |steps: usize| kept.state(steps).time.value.to_f64();
    let steps = &kept.steps;
    let before = steps.partition_point(|step| step.state.time.value.to_f64() < time);
    let after = (before + 1).min(steps.len());
    let off = |&steps: &usize| (of(steps) - time).abs();
    let nearest = if off(&before) <= off(&after) {
        before
    } else {
        after
    };
    if off(&nearest) <= ROUNDINGS * S::EPSILON.to_f64() * time.abs() {
        return Ok(nearest);
    }
    let nearest = of(nearest);
    Err(GradientError::NotAnEndOfStep { time, nearest })
}

/// The weights of a quantity in the states after each number of steps, where they do not depend on its values.
fn share<S: Real>(kept: &Kept<S>, when: &When, weights: &mut [f64]) -> Result<(), GradientError> {
    match when {
        When::End => weights[kept.steps.len()] = 1.0,
        When::At(time) => weights[end_of(kept, *time)?] = 1.0,
        When::Integral => {
            for (index, step) in kept.steps.iter().enumerate() {
                let half = 0.5 * step.step.to_f64();
                weights[index] += half;
                weights[index + 1] += half;
            }
        }
        When::Misfit(_) => {}
    }
    Ok(())
}

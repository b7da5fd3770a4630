//! The way back through a history: what is carried from step to step.

use super::derivatives::{Of, Outline};
use crate::element::conduction::{Conduction, Partner};
use crate::run::gradient::objective::Objective;
use crate::run::gradient::result::Gradient;
use crate::step::adjoint::{Adjoint, RocketStep, Terms};
use nalgebra::SVector;

/// The way back through a history.
pub(super) struct Way<const D: usize> {
    pub(super) outline: Outline,
    /// The conduction, with the temperatures of ovens in the present step.
    pub(super) conduction: Conduction,
    pub(super) paths: Vec<(usize, Partner)>,
    /// Whether a thermostat prescribes the temperature, by thermal slot.
    pub(super) held: Vec<bool>,
    /// The anchors that masses couple with other nodes, and whether they are moved.
    pub(super) anchors: Vec<(usize, bool)>,
    /// The rockets in the present step.
    pub(super) rockets: Vec<RocketStep<D>>,
    /// The derivatives of the present step by the velocities of moved anchors at its end, where masses couple them with
    /// others, and by the temperatures of reservoirs.
    pub(super) by_speeds: Vec<(usize, SVector<f64, D>)>,
    pub(super) by_reservoirs: Vec<f64>,
    /// The adjoint, with the derivatives by the present state.
    pub(super) adjoint: Adjoint<D>,
    /// The derivative by the size of the step before the present state, as far as the objective itself contains this size.
    pub(super) by_size: f64,
    /// The terms of the derivative by the size of the last step.
    pub(super) last: Option<Terms>,
    pub(super) found: Gradient<D>,
}

/// Objectives with factors. The value of the first one is that of the gradient.
pub(super) type Weighted<'a, const D: usize> = &'a [(f64, &'a Objective<D>)];

/// Adds a derivative by a state variable to those by the present state, or one by an input to those by inputs.
pub(super) fn add_to<const D: usize>(
    (adjoint, found): (&mut Adjoint<D>, &mut Gradient<D>),
    of: Of<'_>,
    by: f64,
) {
    let costate = &mut adjoint.costate;
    match of {
        Of::Position(at) => costate.positions[at] += by,
        Of::Velocity(at) => adjoint.add_by_velocity(at, by),
        Of::Viscous(slot) => costate.viscous[slot] += by,
        Of::Temperature(slot) => costate.temperatures[slot] += by,
        Of::Entropy(index) => costate.reservoirs[index] += by,
        Of::Mass(node) => found.masses[node] += by,
        Of::Pair(place) => found.pairs[place].1 += by,
        Of::Gravity(axis) => found.gravity[axis] += by,
        Of::Reservoir(index) => found.reservoirs[index] += by,
        Of::Parameters(element, values) => add(&mut found.elements[element].values, by, values),
    }
}

/// Adds `factor values` to `sum`.
pub(super) fn add(sum: &mut [f64], factor: f64, values: &[f64]) {
    for (sum, &value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}

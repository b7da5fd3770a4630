//! A direction, along which a run is differentiated: the change of each input.

use super::derivatives::Of;
use crate::scene::loads::{OfTime, ScalarOfTime};
use crate::step::adjoint::{HeatChange, PerVariable};
use nalgebra::SVector;

/// The changes of all inputs. A list is empty if no input of its kind changes.
pub(super) struct Change<const D: usize> {
    /// The state at the start, without functions of time.
    pub(super) start: PerVariable,
    pub(super) parameters: Vec<Vec<f64>>,
    pub(super) masses: Vec<f64>,
    pub(super) pairs: Vec<f64>,
    pub(super) gravity: SVector<f64, D>,
    pub(super) heat: HeatChange,
    /// Changes as functions of time, each with its index: of the node, rocket, node, thermal slot or reservoir.
    pub(super) forces: Vec<(usize, OfTime<D>)>,
    pub(super) thrusts: Vec<(usize, ScalarOfTime)>,
    pub(super) motions: Vec<(usize, OfTime<D>)>,
    pub(super) temperatures: Vec<(usize, ScalarOfTime)>,
    pub(super) ovens: Vec<(usize, ScalarOfTime)>,
}

impl<const D: usize> Change<D> {
    /// The change of the state at the start, including that of prescribed motions at this time.
    pub(super) fn start_at(&self, time: f64) -> PerVariable {
        let mut start = self.start.clone();
        for (node, by) in &self.motions {
            let own = by(time);
            for (axis, at) in (*node * D..).take(D).enumerate() {
                start.positions[at] += own[axis];
            }
        }
        start
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
            let own = change
                .parameters
                .get(element)
                .map_or(&[][..], Vec::as_slice);
            let pairs = own.iter().zip(values);
            pairs.fold(0.0, |sum, (&a, &b)| sum + a * b)
        }
    })
}

//! A direction, along which a run is differentiated: the change of each input.

use super::derivatives::Of;
use crate::scene::loads::{OfTime, ScalarOfTime};
use crate::step::adjoint::{HeatChange, PerVariable};
use eem_material::number::scalar::Real;
use nalgebra::SVector;

/// The changes of all inputs. A list is empty if no input of its kind changes.
pub(super) struct Change<const D: usize, S: Real> {
    /// The state at the start, without functions of time.
    pub(super) start: PerVariable<S>,
    pub(super) parameters: Vec<Vec<S>>,
    pub(super) masses: Vec<S>,
    pub(super) pairs: Vec<S>,
    pub(super) gravity: SVector<S, D>,
    pub(super) heat: HeatChange<S>,
    /// Changes as functions of time, each with its index: of the node, rocket, node, thermal slot or reservoir.
    pub(super) forces: Vec<(usize, OfTime<S, D>)>,
    pub(super) thrusts: Vec<(usize, ScalarOfTime<S>)>,
    pub(super) motions: Vec<(usize, OfTime<S, D>)>,
    pub(super) temperatures: Vec<(usize, ScalarOfTime<S>)>,
    pub(super) ovens: Vec<(usize, ScalarOfTime<S>)>,
}

impl<const D: usize, S: Real> Change<D, S> {
    /// The change of the state at the start, including that of prescribed motions at this time.
    pub(super) fn start_at(&self, time: S) -> PerVariable<S> {
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
pub(super) fn along<const D: usize, S: Real>(
    (change, state): (&Change<D, S>, &PerVariable<S>),
    of: Of<'_, S>,
    by: S,
) -> S {
    let input = |all: &[S], at: usize| all.get(at).copied().unwrap_or(S::zero());
    by * match of {
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
            pairs.fold(S::zero(), |sum, (&a, &b)| sum + a * b)
        }
    }
}

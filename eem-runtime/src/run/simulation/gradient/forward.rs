//! The way forward through a history: what is carried from step to step.

use super::change::Change;
use super::derivatives::Outline;
use crate::element::conduction::Conduction;
use crate::step::adjoint::{Direction, HeatChange, RocketStep, Tangents};
use eem_material::number::scalar::Real;

/// The way forward through a history.
pub(super) struct Forward<const D: usize, S: Real> {
    pub(super) outline: Outline<S>,
    /// The conduction, with the temperatures of ovens in the present step.
    pub(super) conduction: Conduction<S>,
    /// The rockets in the present step.
    pub(super) rockets: Vec<RocketStep<S, D>>,
    /// Whether a thermostat prescribes the temperature, by thermal slot.
    pub(super) held: Vec<bool>,
    pub(super) anchors: Vec<usize>,
    /// The directions: all their inputs, their heat in the present step, and the changes of the state.
    pub(super) changes: Vec<Change<D, S>>,
    pub(super) heats: Vec<HeatChange<S>>,
    pub(super) directions: Vec<Direction<S>>,
    pub(super) tangents: Tangents<S, D>,
}

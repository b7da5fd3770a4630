//! The way forward through a history: what is carried from step to step.

use super::change::Change;
use super::derivatives::Outline;
use crate::element::conduction::Conduction;
use crate::step::adjoint::{Direction, HeatChange, RocketStep, Tangents};

/// The way forward through a history.
pub(super) struct Forward<const D: usize> {
    pub(super) outline: Outline,
    /// The conduction, with the temperatures of ovens in the present step.
    pub(super) conduction: Conduction,
    /// The rockets in the present step.
    pub(super) rockets: Vec<RocketStep<D>>,
    /// Whether a thermostat prescribes the temperature, by thermal slot.
    pub(super) held: Vec<bool>,
    pub(super) anchors: Vec<usize>,
    /// The directions: all their inputs, their heat in the present step, and the changes of the state.
    pub(super) changes: Vec<Change<D>>,
    pub(super) heats: Vec<HeatChange>,
    pub(super) directions: Vec<Direction>,
    pub(super) tangents: Tangents<D>,
}

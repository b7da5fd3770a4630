//! Why a simulation cannot go on from a checkpoint.

use thiserror::Error;

use crate::error::SceneError;
use crate::readable::Readable;
use crate::scheme::Scheme;

/// What differs between a checkpoint and the simulation that should go on from it, or is wrong
/// with the checkpoint itself. The simulation is as it was before.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The schemes differ.
    #[error(
        "the checkpoint is one of the scheme {}, the simulation has {}",
        checkpoint.name(),
        simulation.name()
    )]
    Scheme {
        /// The scheme of the checkpoint.
        checkpoint: Scheme,
        /// The scheme of the simulation.
        simulation: Scheme,
    },
    /// There are more or fewer of something.
    #[error(
        "number of {quantity}: the checkpoint has {checkpoint}, the simulation has {simulation}"
    )]
    Count {
        /// Of what.
        quantity: &'static str,
        /// How many the checkpoint has.
        checkpoint: usize,
        /// How many the simulation has.
        simulation: usize,
    },
    /// A node is an anchor in one and a mass in the other.
    #[error("node {node} is {} in the checkpoint and {} in the simulation", kind(*is_anchor), kind(!*is_anchor))]
    Node {
        /// The node, counted in the order of creation.
        node: usize,
        /// Whether it is an anchor in the checkpoint.
        is_anchor: bool,
    },
    /// An element has another number of dashpots.
    #[error(
        "element {element} has {checkpoint} dashpots in the checkpoint and {simulation} in the simulation"
    )]
    Dashpots {
        /// The element, counted in the order of creation.
        element: usize,
        /// How many it has in the checkpoint.
        checkpoint: usize,
        /// How many it has in the simulation.
        simulation: usize,
    },
    /// An element has a temperature in one and none in the other.
    #[error("element {element} has a temperature in the {} only", owner(*in_checkpoint))]
    Temperature {
        /// The element, counted in the order of creation.
        element: usize,
        /// Whether it has one in the checkpoint.
        in_checkpoint: bool,
    },
    /// The Newton settings of the checkpoint are none that a simulation can have.
    #[error(transparent)]
    Settings(#[from] SceneError),
    /// A value in the checkpoint is none that a simulation can have.
    #[error("the checkpoint has {value} among its values of {quantity}, they must be {required}", value = Readable(*value))]
    Value {
        /// Of what.
        quantity: &'static str,
        /// The value.
        value: f64,
        /// What it must be.
        required: &'static str,
    },
}

const fn kind(is_anchor: bool) -> &'static str {
    if is_anchor { "an anchor" } else { "a mass" }
}

const fn owner(in_checkpoint: bool) -> &'static str {
    if in_checkpoint {
        "checkpoint"
    } else {
        "simulation"
    }
}

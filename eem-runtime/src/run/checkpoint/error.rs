//! Errors of restoring a checkpoint, and of loading it from a file.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::algebra::memory::TooLarge;
use crate::element::error::StateError;
use crate::element::group::Misfit;
use crate::element::handle::Element;
use crate::scene::error::SceneError;
use crate::step::scheme::Scheme;
use eem_material::number::readable::Readable;

/// Why a checkpoint cannot be restored. The simulation is unchanged.
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
    /// A count differs.
    #[error(
        "number of {quantity}: the checkpoint has {checkpoint}, the simulation has {simulation}"
    )]
    Count {
        /// The quantity.
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
    /// The settings of Newton's method or of step control in the checkpoint are invalid.
    #[error(transparent)]
    Settings(#[from] SceneError),
    /// A value in the checkpoint is invalid.
    #[error("the checkpoint has {value} among its values of {quantity}, they must be {required}", value = Readable(*value))]
    Value {
        /// The quantity.
        quantity: &'static str,
        /// The value.
        value: f64,
        /// The requirement.
        required: &'static str,
    },
    /// The compensation of a sum is larger than rounding leaves.
    #[error(
        "the checkpoint carries {carry} over to a value of {quantity} of {value}, rounding leaves at most half a unit in its last place",
        value = Readable(*value), carry = Readable(*carry)
    )]
    Carry {
        /// The quantity.
        quantity: &'static str,
        /// The rounded sum.
        value: f64,
        /// The stored compensation of its rounding.
        carry: f64,
    },
    /// An entry that follows only from the steps, not from the state, is not the one that the run has saved.
    #[error(
        "the checkpoint has been edited: {entry} must be what the run has saved; change positions, momenta, viscous stretches and temperatures with their entropies, and everything else by methods of the simulation"
    )]
    Edited {
        /// The edited entry.
        entry: &'static str,
    },
    /// The scheme of the checkpoint, or the one that the run returns to, needs more memory than allowed.
    #[error(transparent)]
    Memory(#[from] TooLarge),
    /// What controllers have set does not fit the scene: other thermostats, or values that cannot be set.
    #[error(
        "what controllers have set in the checkpoint does not fit the scene: build the scene with the thermostats that it had"
    )]
    Loads,
    /// The numbers of the scenes differ: the parameters of a material, a mass, a conductance.
    #[error(
        "the checkpoint is one of a scene with other {kind}: build the scene with the numbers that it had"
    )]
    Numbers {
        /// Which numbers differ.
        kind: &'static str,
    },
    /// An element cannot have the state in the checkpoint.
    #[error("in the checkpoint, {0}")]
    State(StateError),
    /// The entropy of an element is not that of its temperature.
    #[error(
        "element {element} has the entropy {entropy} J/K in the checkpoint, but {expected} J/K at its temperature of {temperature} K; rounding explains {bound:.1e} J/K",
        entropy = Readable(*entropy), expected = Readable(*expected), temperature = Readable(*temperature)
    )]
    Entropy {
        /// The element, counted in the order of creation.
        element: usize,
        /// Its entropy in the checkpoint, J/K.
        entropy: f64,
        /// The entropy `s(λ, γ, θ)` of its model in the state of the checkpoint, J/K.
        expected: f64,
        /// Its temperature in the checkpoint, K.
        temperature: f64,
        /// By how much the two may differ, J/K.
        bound: f64,
    },
    /// An anchor is not where the scene has it at the time of the checkpoint.
    #[error(
        "coordinate {axis} of the anchor node {node} is {checkpoint} m in the checkpoint and {simulation} m in the simulation at t = {time} s",
        checkpoint = Readable(*checkpoint), simulation = Readable(*simulation), time = Readable(*time)
    )]
    Anchor {
        /// The node, counted in the order of creation.
        node: usize,
        /// The axis, from 0.
        axis: usize,
        /// The coordinate in the checkpoint, with its compensation, m.
        checkpoint: f64,
        /// Where the anchor was created, or where its motion puts it, m.
        simulation: f64,
        /// The time of the checkpoint, s.
        time: f64,
    },
    /// In a scene with solids, an anchor that does not move has a velocity.
    #[error(
        "component {axis} of the velocity of the anchor node {node} is {value} m/s in the checkpoint, it must be zero",
        value = Readable(*value)
    )]
    AnchorVelocity {
        /// The node, counted in the order of creation.
        node: usize,
        /// The axis, from 0.
        axis: usize,
        /// The component, m/s.
        value: f64,
    },
    /// In a scene without solids, an anchor has a momentum.
    #[error(
        "component {axis} of the momentum of the anchor node {node} is {value} kg m/s in the checkpoint, it must be zero",
        value = Readable(*value)
    )]
    AnchorMomentum {
        /// The node, counted in the order of creation.
        node: usize,
        /// The axis, from 0.
        axis: usize,
        /// The component, kg m/s.
        value: f64,
    },
    /// An element does not have the temperature that a thermostat gives it.
    #[error(
        "{element} has the temperature {checkpoint} K in the checkpoint, but {simulation} K is prescribed at t = {time} s",
        checkpoint = Readable(*checkpoint), simulation = Readable(*simulation), time = Readable(*time)
    )]
    Thermostat {
        /// The element.
        element: Element,
        /// Its temperature in the checkpoint, K.
        checkpoint: f64,
        /// The prescribed one, K.
        simulation: f64,
        /// The time of the checkpoint, s.
        time: f64,
    },
    /// A sum over the whole scene is not finite, though each term is.
    #[error(
        "the {quantity} of the scene in the checkpoint is {value} {unit}, it must be finite",
        value = Readable(*value)
    )]
    Total {
        /// An entry of the ledger.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Its unit.
        unit: &'static str,
    },
}

/// The first words of a file.
pub(super) const KIND: &str = "eem checkpoint";

/// The version of the format; files of another one are not read.
pub(super) const VERSION: &str = "1";

/// Why a checkpoint cannot be loaded.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The file cannot be read.
    #[error("{} cannot be read: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The contents of the file are not those of a checkpoint.
    #[error("{}: {source}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong with them.
        source: FormatError,
    },
}

/// What is wrong with the contents of a file.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FormatError {
    /// It is another kind of file.
    #[error(
        "the file does not begin with `{KIND}`: it is none that `Checkpoint::save` has written"
    )]
    Kind,
    /// It has another version of the format.
    #[error(
        "the checkpoint has the version `{found}` of the format, this library reads version {VERSION}: continue with the version of the library that wrote it"
    )]
    Version {
        /// The version of the file.
        found: String,
    },
    /// It is the checkpoint of a run in `f32`, of an earlier version.
    #[error(
        "the checkpoint has numbers of the type `{found}`, which scenes no longer have: they step `f64`"
    )]
    Scalar {
        /// The number type of the file.
        found: String,
    },
    /// The last line is not the digest of the lines before.
    #[error(
        "the file has been cut off or edited: its last line is not the digest of the others; take another copy of it"
    )]
    Digest,
    /// A line is not as expected.
    #[error("line {line} is not the list `{expected}` that version {VERSION} has there")]
    Line {
        /// The line, from 1.
        line: usize,
        /// The name of its list.
        expected: &'static str,
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

impl From<Misfit> for RestoreError {
    fn from(misfit: Misfit) -> Self {
        match misfit {
            Misfit::State(error) => Self::State(error),
            Misfit::Entropy {
                element,
                entropy,
                expected,
                temperature,
                bound,
            } => Self::Entropy {
                element,
                entropy,
                expected,
                temperature,
                bound,
            },
        }
    }
}

impl From<StateError> for RestoreError {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}

/// An error unless two counts agree.
pub(crate) fn expect_count(
    quantity: &'static str,
    checkpoint: usize,
    simulation: usize,
) -> Result<(), RestoreError> {
    if checkpoint == simulation {
        return Ok(());
    }
    Err(RestoreError::Count {
        quantity,
        checkpoint,
        simulation,
    })
}

//! Why a run has no gradient.

use thiserror::Error;

use crate::element::error::StateError;
use crate::scene::error::SceneError;
use eem_material::number::readable::Readable;

/// Why a run has no gradient; nothing has changed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GradientError {
    /// The scheme has no adjoint.
    #[error("{scheme} has no adjoint, and is used at t = {} s; take eem-temperature or eem-entropy", Readable(*time))]
    NoAdjoint {
        /// The name of the scheme.
        scheme: &'static str,
        /// The time at the end of the first such step, or now, s.
        time: f64,
    },
    /// Something in the scene has no adjoint.
    #[error(
        "the scene has {what}, of which there are no derivatives; leave them out, or use differences of runs"
    )]
    NotDifferentiable {
        /// What it is, in the plural.
        what: &'static str,
    },
    /// No history was kept.
    #[error("no history is kept: call `keep_history` before the first step that counts")]
    NoHistory,
    /// The states do not fit the memory that is allowed.
    #[error(
        "the states of {steps} steps of {needed} bytes each exceed {allowed} bytes; allow more with `History::bytes`, or make fewer steps"
    )]
    HistoryTooLarge {
        /// The steps that were kept.
        steps: usize,
        /// For each of them.
        needed: usize,
        /// For all of them.
        allowed: usize,
    },
    /// The states do not follow from each other by steps.
    #[error("the history ends at t = {} s: the state was restored, or made by another scheme, since; call `keep_history` again", Readable(*time))]
    HistoryBroken {
        /// The time, s.
        time: f64,
    },
    /// A time at which no step ends.
    #[error("no step ends at t = {} s; the nearest that does is at {} s; `run_at` makes steps end at given times", Readable(*time), Readable(*nearest))]
    NotAnEndOfStep {
        /// The time, s.
        time: f64,
        /// The nearest end of a step, s.
        nearest: f64,
    },
    /// A quantity has no derivatives here.
    #[error(
        "there are no derivatives of {quantity}; take positions, velocities, momenta, stretches, viscous stretches, temperatures, reservoirs, or energies"
    )]
    NoDerivative {
        /// The quantity.
        quantity: String,
    },
    /// A quantity has no such component.
    #[error(
        "{quantity} has {components} components, and component {component} was asked for; count from 0"
    )]
    Component {
        /// The quantity.
        quantity: String,
        /// The component that was asked for.
        component: usize,
        /// How many there are.
        components: usize,
    },
    /// The material has no derivatives by its parameters.
    #[error(
        "`{model}` has no derivatives by its parameters; derive its free energy with the feature `gradients`"
    )]
    NoParameterDerivatives {
        /// The name of the model.
        model: &'static str,
    },
    /// The material has no such parameter.
    #[error("`{model}` has no parameter `{name}`; it has {}", known.join(", "))]
    UnknownParameter {
        /// The name that was asked for.
        name: String,
        /// The name of the model.
        model: &'static str,
        /// The names that it has.
        known: Vec<&'static str>,
    },
    /// There is no such function of time.
    #[error("{why}: there are no values of it to differentiate by")]
    NoSeries {
        /// What is missing.
        why: String,
    },
    /// The adjoint equations of a step have no solution.
    #[error("the adjoint equations of the step to t = {} s are singular", Readable(*time))]
    Singular {
        /// The time, s.
        time: f64,
    },
    /// A derivative is infinite or not a number.
    #[error("a derivative is not finite at t = {} s: a formula has a kink or a pole there", Readable(*time))]
    NotFinite {
        /// The time, s.
        time: f64,
    },
    /// The linear system does not fit in memory, or a handle is of another scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An element cannot be in a state of the history.
    #[error(transparent)]
    State(#[from] StateError),
}

//! Why a run has no gradient.

use thiserror::Error;

use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::scene::error::SceneError;
use crate::step::error::StepError;
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
    /// The run has made more steps than its history may reach.
    #[error(
        "the history reaches {most} steps with its memory, and the run has made more; allow more with `History::bytes`, or make fewer steps"
    )]
    HistoryTooLarge {
        /// The steps that were kept.
        most: usize,
    },
    /// A step that was made again ended in another state.
    #[error("steps that were made again from a snapshot end in another state at t = {} s: a load gives other values than before, or settings have changed; keep all states, with more memory by `History::bytes`", Readable(*time))]
    NotRepeatable {
        /// The time, s.
        time: f64,
    },
    /// A step could not be made again.
    #[error(transparent)]
    Step(Box<StepError>),
    /// A standard deviation is not positive and finite.
    #[error("the standard deviation of the record at t = {} s is {}, it must be positive and finite", Readable(*time), Readable(*value))]
    Deviation {
        /// The time of the record, s.
        time: f64,
        /// The standard deviation.
        value: f64,
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
        "there are no derivatives of {quantity} here; take positions of nodes, velocities or momenta of masses, stretches, viscous stretches, temperatures, reservoirs, or energies"
    )]
    NoDerivative {
        /// The quantity.
        quantity: String,
    },
    /// The total energy counts heat that elements without a temperature have lost, which has no derivatives here.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{GradientError, History, Objective};
    ///
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch| 0.5 * k * (lambda - 1.0).powi(2))]
    /// #[viscosity(lambda = 0.3)]
    /// struct Damper { k: f64 }
    ///
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    /// scene.spring(Damper { k: 4.0 }, ends);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.keep_history(History::default());
    /// run.run_until(1.0)?;
    /// let total = run.gradient(&Objective::at_end(Quantity::TotalEnergy));
    /// assert!(matches!(total, Err(GradientError::LostHeat { heat }) if heat > 0.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[error(
        "the total energy counts {} J of heat that dashpots of elements without a temperature have lost, which has no derivatives; give these elements a temperature, or take the kinetic energy", Readable(*heat)
    )]
    LostHeat {
        /// The heat, J.
        heat: f64,
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
        "`{model}` has no derivatives by its parameters; derive its free energy with the feature `gradients`; a text has them by 64 parameters at most"
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
    /// A load is a function of time, whose derivative by time is not known.
    #[error(
        "{load} is a function of time, whose derivative is not known; `by_step_size_at_kept_loads` is without it"
    )]
    NoTimeDerivative {
        /// The load.
        load: String,
    },
    /// The time of an event does not follow the inputs.
    #[error("at t = {} s the event changes at the rate {} with the time, zero to rounding: its time has no derivatives; take an event that crosses its value", Readable(*time), Readable(*rate))]
    Grazing {
        /// The time, s.
        time: f64,
        /// The derivative of the event by the time.
        rate: f64,
    },
    /// The adjoint equations of a step have no solution.
    #[error("the adjoint equations of the step to t = {} s are singular", Readable(*time))]
    Singular {
        /// The time, s.
        time: f64,
    },
    /// A derivative is infinite or not a number.
    #[error("a derivative or the objective is not finite at t = {} s: a formula has a kink or a pole there, or a number of the objective or of an input is out of range", Readable(*time))]
    NotFinite {
        /// The time, s.
        time: f64,
    },
    /// A gradient is not that of the run, or its digits are lost.
    #[error(
        "along a direction the objective changes by {} with the gradient and by {} with the run: the gradient is of another objective or history, a formula has a kink, or the motion is so sensitive that no digits are left", Readable(*adjoint), Readable(*tangent)
    )]
    Disagrees {
        /// The change with the gradient.
        adjoint: f64,
        /// The change along the run.
        tangent: f64,
    },
    /// The function that watches gradients has stopped the computation.
    #[error("the derivatives were stopped by the function that `watch_gradients` was given")]
    Stopped,
    /// The linear system does not fit in memory, or a handle is of another scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An element cannot be in a state of the history.
    #[error(transparent)]
    State(#[from] StateError),
}

impl GradientError {
    /// An error unless a quantity has this component.
    pub(crate) fn expect_component(
        quantity: impl FnOnce() -> String,
        component: usize,
        components: usize,
    ) -> Result<(), Self> {
        if component < components {
            return Ok(());
        }
        Err(Self::Component {
            quantity: quantity(),
            component,
            components,
        })
    }

    /// The error that an element has no such parameter; a material of a text without derivatives has no parameters at all.
    pub(crate) fn no_parameter(element: &Element, name: &str, known: &[&'static str]) -> Self {
        let model = element.model();
        if known.is_empty() {
            return Self::NoParameterDerivatives { model };
        }
        Self::UnknownParameter {
            name: name.to_owned(),
            model,
            known: known.to_vec(),
        }
    }
}

impl From<StepError> for GradientError {
    fn from(error: StepError) -> Self {
        Self::Step(Box::new(error))
    }
}

//! Why a study is not begun: what is wrong with it, and what to do.

use thiserror::Error;

use super::quantity::StateQuantity;
use super::setting::Setting;
use crate::number::readable::Readable;
use crate::scene::error::SceneError;

/// A study that is not begun.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// There is nothing to run.
    #[error("the study has no settings; add some with `setting` or `settings`")]
    NoSettings,
    /// A run needs steps.
    #[error("a step of {} s is not positive and finite; choose a step between 0 and the end time", Readable(*step))]
    Step {
        /// The step, s.
        step: f64,
    },
    /// A scene starts at 0 s.
    #[error("the end time of {} s does not lie after the start at 0 s; choose a positive, finite end time", Readable(*end))]
    End {
        /// The end time, s.
        end: f64,
    },
    /// Errors are compared at one time, which all runs have to reach in full steps.
    #[error(
        "no whole number of steps of {} s ends at {} s; take {} s or {} s",
        Readable(*step), Readable(*end), Readable(*shorter), Readable(*longer)
    )]
    NoWholeSteps {
        /// The step, s.
        step: f64,
        /// The end time, s.
        end: f64,
        /// The next shorter step that hits the end, s.
        shorter: f64,
        /// The next longer step that hits it, s; the whole time if there is none.
        longer: f64,
    },
    /// More steps than a study counts.
    #[error("{} s in steps of {} s are more than {most} steps; choose longer steps or an earlier end", Readable(*end), Readable(*step))]
    TooManySteps {
        /// The step, s.
        step: f64,
        /// The end time, s.
        end: f64,
        /// The most steps of a run.
        most: u32,
    },
    /// A relative error that something is asked for has to be positive and finite.
    #[error("an accuracy of {} is not positive and finite; ask for a relative error such as 0.001", Readable(*accuracy))]
    Accuracy {
        /// What was asked for.
        accuracy: f64,
    },
    /// A setting in single precision, but no scene with `f32`.
    #[error("`{setting}` needs the scene with f32; give the closure that builds it to `single`")]
    NoSingleScene {
        /// The setting.
        setting: Setting,
    },
    /// A scene that cannot be run.
    #[error("`{setting}`: {source}")]
    Scene {
        /// The setting that it was built for.
        setting: Setting,
        /// What is wrong with it.
        r#source: SceneError,
    },
    /// A reference that is not of this scene.
    #[error(
        "reference {index} has {got} values for the {quantity} of the state, the scene has {expected}; \
         take it from a simulation of the same scene"
    )]
    Reference {
        /// Which of the two, from 0.
        index: usize,
        /// Of what it has another number.
        quantity: StateQuantity,
        /// How many values it has.
        got: usize,
        /// How many the scene has.
        expected: usize,
    },
    /// A reference with a value that is infinite or not a number.
    #[error(
        "reference {index} has a value of the {quantity} that is not finite; take it from a run that succeeded"
    )]
    ReferenceNotFinite {
        /// Which of the two, from 0.
        index: usize,
        /// Of what.
        quantity: StateQuantity,
    },
}

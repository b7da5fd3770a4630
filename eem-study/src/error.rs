//! Errors of studies.

use thiserror::Error;

use crate::quantity::StateQuantity;
use crate::setting::Setting;
use eem_material::number::readable::Readable;
use eem_runtime::SceneError;

/// Why a study has no report.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// There is nothing to run.
    #[error("the study has no settings; add some with `setting` or `settings`")]
    NoSettings,
    /// A step is not positive and finite.
    #[error("a step of {} s is not positive and finite; choose a step between 0 and the end time", Readable(*step))]
    Step {
        /// The step, s.
        step: f64,
    },
    /// The end time is not positive and finite.
    #[error("the end time of {} s does not lie after the start at 0 s; choose a positive, finite end time", Readable(*end))]
    End {
        /// The end time, s.
        end: f64,
    },
    /// No whole number of steps ends at the end time, at which errors are compared.
    #[error(
        "no whole number of steps of {} s ends at {} s; take {}",
        Readable(*step), Readable(*end), either(*shorter, *longer)
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
    /// Too many steps.
    #[error("{} s in steps of {} s are more than {most} steps; choose longer steps or an earlier end", Readable(*end), Readable(*step))]
    TooManySteps {
        /// The step, s.
        step: f64,
        /// The end time, s.
        end: f64,
        /// The largest number of steps of a run.
        most: u32,
    },
    /// An accuracy is not positive and finite.
    #[error("an accuracy of {} is not positive and finite; ask for a relative error such as 0.001", Readable(*accuracy))]
    Accuracy {
        /// The accuracy.
        accuracy: f64,
    },
    /// A recommendation is asked for kinds of quantities that the scene does not have.
    #[error(
        "the scene has none of the quantities that a recommendation was asked for: {}",
        listed(quantities)
    )]
    NoSuchQuantity {
        /// The kinds of quantities.
        quantities: Vec<StateQuantity>,
    },
    /// A scene is rejected.
    #[error("`{setting}`: {source}")]
    Scene {
        /// The setting that it was built for.
        setting: Setting,
        /// The error of the scene.
        r#source: SceneError,
    },
    /// The function that watches the study has ended it.
    #[error("the study was stopped by the function that `watch` was given")]
    Stopped,
    /// A reference belongs to another scene.
    #[error(
        "reference {index} has {got} values for the {quantity} of the state, the scene has {expected}; \
         take it from a simulation of the same scene"
    )]
    Reference {
        /// The index of the reference, from 0.
        index: usize,
        /// The quantity whose count differs.
        quantity: StateQuantity,
        /// The number of values in the reference.
        got: usize,
        /// The number of values in the scene.
        expected: usize,
    },
    /// A reference contains an infinite value or NaN.
    #[error(
        "reference {index} has a value of the {quantity} that is not finite; take it from a run that succeeded"
    )]
    ReferenceNotFinite {
        /// The index of the reference, from 0.
        index: usize,
        /// The quantity.
        quantity: StateQuantity,
    },
}

/// Two steps to choose from, which may be one.
fn either(shorter: f64, longer: f64) -> String {
    if shorter.to_bits() == longer.to_bits() {
        return format!("{} s", Readable(shorter));
    }
    format!("{} s or {} s", Readable(shorter), Readable(longer))
}

/// The names of kinds of quantities.
pub(crate) fn listed(quantities: &[StateQuantity]) -> String {
    if quantities.is_empty() {
        return "it was asked for none".to_owned();
    }
    let names: Vec<_> = quantities.iter().map(ToString::to_string).collect();
    names.join(", ")
}

//! Why there is no state at rest.

use thiserror::Error;

use super::motion::FreeMotion;
use crate::element::handle::{Element, Node};
use crate::scene::error::SceneError;
use crate::step::error::StepFailure;
use eem_material::number::readable::Readable;

/// Why [`Scene::equilibrium`](crate::Scene::equilibrium) found no stable state at rest. The scene is unchanged.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EquilibriumError {
    /// The scene is invalid.
    #[error("{}{}", first(errors), more(errors))]
    Scene {
        /// What is wrong with it, at least one error.
        errors: Vec<SceneError>,
    },
    /// A setting is invalid.
    #[error("the {name} is {value}, it must be positive and finite", value = Readable(*value))]
    Setting {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A load at the start is not finite, or an element has no force in the initial state.
    #[error(transparent)]
    Start(StepFailure),
    /// A motion that no force resists: a body without supports, or a mechanism.
    #[error(
        "nothing holds {motion} (stiffness {:.1e} N/m): add supports or springs, or loads that stretch them",
        motion.stiffness
    )]
    Free {
        /// The motion.
        motion: FreeMotion,
    },
    /// Forces are balanced, at least along a motion by which the scene would leave the state: it buckles.
    #[error(
        "the state is unstable: nothing starts {motion}, which has the stiffness {:.3e} N/m; add a small load or change positions along it to find the stable state beside it (the loads were followed up to {:.1} % of them)",
        motion.stiffness, 100.0 * followed
    )]
    Unstable {
        /// The motion.
        motion: FreeMotion,
        /// The share of the loads up to which states were stable.
        followed: f64,
    },
    /// No state was found in which all forces are balanced.
    #[error(
        "no state at rest was found: {residual:.3e} N were left{} (the loads were followed up to {:.1} % of them){}; take more load steps, or start nearer to the state",
        node.map_or_else(String::new, |node| format!(" on {node}")), 100.0 * followed, reason(failure)
    )]
    NotFound {
        /// The node with the largest force out of balance.
        node: Option<Node>,
        /// That force, N.
        residual: f64,
        /// The share of the loads up to which states were found.
        followed: f64,
        /// Why the last attempt failed.
        failure: Box<StepFailure>,
    },
    /// Paths of heat join elements, but none joins them with a reservoir or a thermostat: any temperature is one of
    /// thermal balance.
    #[error(
        "no path of heat joins {element} and its partners with a reservoir or a thermostat, so that their temperature in thermal balance is undetermined; add one, or keep temperatures as they are"
    )]
    Insulated {
        /// The first such element.
        element: Element,
    },
    /// Conductances differ by so much that rounding leaves the temperatures undetermined.
    #[error(
        "rounding leaves the temperatures of thermal balance undetermined: conductances differ by too much"
    )]
    HeatNotBalanced,
}

/// The reason that an element gives why it has no state, as the end of a message.
fn reason(failure: &StepFailure) -> String {
    match failure {
        StepFailure::State(error) => format!(": {error}"),
        _ => String::new(),
    }
}

fn first(errors: &[SceneError]) -> String {
    errors.first().map_or_else(String::new, ToString::to_string)
}

fn more(errors: &[SceneError]) -> String {
    match errors.len().saturating_sub(1) {
        0 => String::new(),
        more => format!(" (and {more} more)"),
    }
}

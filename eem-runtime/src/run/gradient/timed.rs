//! Loads whose values in the course of time are inputs.

use super::error::GradientError;
use crate::element::handle::{Element, Node, Reservoir};
use crate::element::lineage::Lineage;
use crate::scene::error::SceneError;

/// A load whose values in the course of time are inputs.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Timed {
    Force(Node),
    Motion(Node),
    /// A rocket by its number among those of its node.
    Thrust(Node, usize),
    Thermostat(Element),
    Oven(Reservoir),
}

impl Timed {
    /// What tells it from the other loads of its scene: its kind, the index of its handle, and its number there.
    pub(crate) fn key(self) -> [usize; 3] {
        match self {
            Self::Force(node) => [0, node.index, 0],
            Self::Motion(node) => [1, node.index, 0],
            Self::Thrust(node, rocket) => [2, node.index, rocket],
            Self::Thermostat(element) => [3, element.index(), 0],
            Self::Oven(oven) => [4, oven.index, 0],
        }
    }

    /// An error unless its handle is valid in a scene.
    pub(crate) fn expect_in(self, scene: &Lineage) -> Result<(), SceneError> {
        match self {
            Self::Force(node) | Self::Motion(node) | Self::Thrust(node, _) => scene.expect(&node),
            Self::Thermostat(element) => scene.expect(&element),
            Self::Oven(oven) => scene.expect(&oven),
        }
    }

    /// Its name as an input.
    pub(crate) fn name(self) -> String {
        match self {
            Self::Force(node) => format!("force on {node}"),
            Self::Motion(node) => format!("motion of {node}"),
            Self::Thrust(node, rocket) => format!("thrust {rocket} on {node}"),
            Self::Thermostat(element) => format!("temperature of {element}"),
            Self::Oven(oven) => format!("temperature of {oven}"),
        }
    }

    /// The error that the scene has no such load.
    #[cold]
    pub(crate) fn missing(self) -> GradientError {
        let why = match self {
            Self::Force(node) => format!("{node} has no force"),
            Self::Motion(node) => format!("{node} is not moved"),
            Self::Thrust(node, rocket) => format!("{node} has no rocket {rocket}"),
            Self::Thermostat(element) => format!("{element} has no thermostat"),
            Self::Oven(oven) => format!("{oven} is not an oven"),
        };
        GradientError::NoSeries { why }
    }
}

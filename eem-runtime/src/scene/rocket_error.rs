//! What can be wrong with a rocket.

use thiserror::Error;

use crate::element::handle::Node;

/// Why a [rocket](crate::Scene::rocket) is rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RocketError {
    /// The scheme does not support forces that turn within a step.
    #[error(
        "{scheme} does not step the rocket at {node}, whose force turns within a step; use eem-entropy or eem-temperature"
    )]
    Scheme {
        /// The name of the scheme.
        scheme: &'static str,
        /// The node with the first rocket.
        node: Node,
    },
    /// The line goes from a node to itself.
    #[error(
        "the rocket at {node} pushes along a line from {end} to itself, which has no direction"
    )]
    NoLine {
        /// The node that it pushes.
        node: Node,
        /// The only node of the line.
        end: Node,
    },
    /// The line joins two anchors at the same position.
    #[error(
        "the rocket at {node} pushes along a line from {tail} to {head}, which are anchors in the same place, so that it has no direction; put one of them elsewhere"
    )]
    NoLength {
        /// The node that it pushes.
        node: Node,
        /// The beginning of the line.
        tail: Node,
        /// The end of the line.
        head: Node,
    },
}

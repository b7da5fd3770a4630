//! What can be wrong with a rocket.

use thiserror::Error;

use crate::element::handle::Node;

/// Why a [rocket](crate::Scene::rocket) cannot push.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RocketError {
    /// The scheme has no force that turns within a step.
    #[error(
        "{scheme} does not step the rocket at {node}, whose force turns within a step; use eem-entropy or eem-temperature"
    )]
    Scheme {
        /// The name of the scheme.
        scheme: &'static str,
        /// The node that the first of them pushes.
        node: Node,
    },
    /// It pushes along a line from a node to itself.
    #[error(
        "the rocket at {node} pushes along a line from {end} to itself, which has no direction"
    )]
    NoLine {
        /// The node that it pushes.
        node: Node,
        /// The only node of the line.
        end: Node,
    },
    /// It pushes along a line between two anchors in one place.
    #[error(
        "the rocket at {node} pushes along a line from {tail} to {head}, which are anchors in the same place, so that it has no direction; put one of them elsewhere"
    )]
    NoLength {
        /// The node that it pushes.
        node: Node,
        /// Where the line begins.
        tail: Node,
        /// Where it ends.
        head: Node,
    },
}

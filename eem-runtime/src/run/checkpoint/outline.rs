//! The shape of a scene: what two scenes must share to have states in common.

use crate::element::layout::Shape;
use crate::element::masses::Masses;
use crate::run::checkpoint::error::RestoreError;
use crate::run::checkpoint::expect::expect_count;
use eem_material::number::scalar::Real;

/// Nodes, elements and reservoirs, without their values.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Outline {
    dimensions: usize,
    /// Whether each node is an anchor.
    anchors: Vec<bool>,
    elements: Vec<ElementOutline>,
    reservoirs: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
struct ElementOutline {
    dashpots: usize,
    thermal: bool,
}

impl Outline {
    /// The outline of a scene in so many dimensions.
    pub(crate) fn new<S: Real>(
        dimensions: usize,
        masses: &Masses<S>,
        shapes: impl Iterator<Item = Shape>,
        reservoirs: usize,
    ) -> Self {
        let element = |shape: Shape| ElementOutline {
            dashpots: shape.dashpots,
            thermal: shape.thermal,
        };
        Self {
            dimensions,
            anchors: masses.iter().map(|mass| mass.is_none()).collect(),
            elements: shapes.map(element).collect(),
            reservoirs,
        }
    }

    /// An error with the first difference from the outline of a simulation.
    pub(super) fn compare(&self, simulation: &Self) -> Result<(), RestoreError> {
        let counts = |outline: &Self| {
            [
                ("dimensions", outline.dimensions),
                ("nodes", outline.anchors.len()),
                ("elements", outline.elements.len()),
                ("reservoirs", outline.reservoirs),
            ]
        };
        for ((quantity, own), (_, other)) in counts(self).into_iter().zip(counts(simulation)) {
            expect_count(quantity, own, other)?;
        }
        let mut nodes = self.anchors.iter().zip(&simulation.anchors);
        if let Some(node) = nodes.position(|(own, other)| own != other) {
            let is_anchor = self.anchors[node];
            return Err(RestoreError::Node { node, is_anchor });
        }
        let elements = self.elements.iter().zip(&simulation.elements);
        for (element, (own, other)) in elements.enumerate() {
            if own.dashpots != other.dashpots {
                return Err(RestoreError::Dashpots {
                    element,
                    checkpoint: own.dashpots,
                    simulation: other.dashpots,
                });
            }
            if own.thermal != other.thermal {
                let in_checkpoint = own.thermal;
                return Err(RestoreError::Temperature {
                    element,
                    in_checkpoint,
                });
            }
        }
        Ok(())
    }
}

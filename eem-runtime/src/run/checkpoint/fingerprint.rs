//! The fingerprint of a scene: its outline, and digests of its numbers.

use crate::element::layout::Shape;
use crate::element::masses::Masses;
use crate::run::checkpoint::error::{RestoreError, expect_count};
use eem_material::number::digest::Digest;

/// Nodes, elements and reservoirs, without their values.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Outline {
    pub(super) dimensions: usize,
    /// Whether each node is an anchor.
    pub(super) anchors: Vec<bool>,
    pub(super) elements: Vec<ElementOutline>,
    pub(super) reservoirs: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(super) struct ElementOutline {
    pub(super) dashpots: usize,
    pub(super) thermal: bool,
}

/// Digests of all numbers of a scene that a state does not contain.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Numbers {
    /// Names and values of the parameters, by element.
    pub(crate) materials: Digest,
    pub(crate) masses: Digest,
    pub(crate) conductances: Digest,
    pub(crate) reservoirs: Digest,
    pub(crate) gravity: Digest,
}

impl Outline {
    pub(crate) fn new(
        dimensions: usize,
        masses: &Masses,
        shapes: &mut dyn Iterator<Item = Shape>,
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
        expect_count("dimensions", self.dimensions, simulation.dimensions)?;
        expect_count("nodes", self.anchors.len(), simulation.anchors.len())?;
        expect_count("elements", self.elements.len(), simulation.elements.len())?;
        expect_count("reservoirs", self.reservoirs, simulation.reservoirs)?;
        let mut nodes = self.anchors.iter().zip(&simulation.anchors);
        if let Some(node) = nodes.position(|(own, other)| own != other) {
            let is_anchor = self.anchors[node];
            return Err(RestoreError::Node { node, is_anchor });
        }
        let elements = self.elements.iter().zip(&simulation.elements);
        for (element, (own, other)) in elements.enumerate() {
            let (checkpoint, simulation) = (own.dashpots, other.dashpots);
            if checkpoint != simulation {
                return Err(RestoreError::Dashpots {
                    element,
                    checkpoint,
                    simulation,
                });
            }
            let in_checkpoint = own.thermal;
            if in_checkpoint != other.thermal {
                return Err(RestoreError::Temperature {
                    element,
                    in_checkpoint,
                });
            }
        }
        Ok(())
    }
}

impl Numbers {
    /// An error with the first kind of numbers that differ from those of a simulation.
    pub(super) fn compare(&self, simulation: &Self) -> Result<(), RestoreError> {
        let kinds = [
            (
                "parameters of materials",
                self.materials,
                simulation.materials,
            ),
            ("masses", self.masses, simulation.masses),
            ("conductances", self.conductances, simulation.conductances),
            (
                "temperatures of reservoirs",
                self.reservoirs,
                simulation.reservoirs,
            ),
            ("gravity", self.gravity, simulation.gravity),
        ];
        match kinds.into_iter().find(|(_, own, other)| own != other) {
            Some((kind, ..)) => Err(RestoreError::Numbers { kind }),
            None => Ok(()),
        }
    }
}

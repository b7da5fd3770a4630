//! Which unknown of the global system belongs to which node and element.
//!
//! Unknowns are the displacements of the masses and, for elements that conduct heat to other
//! elements, the algorithmic temperature that their neighbours see. Viscous stretches and
//! temperatures proper are condensed within their element.

use crate::element::handle::{Element, HeatPartner};

/// What a model has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    pub(crate) dashpots: usize,
    pub(crate) thermal: bool,
    /// Whether a dashpot stands beside the spring.
    pub(crate) drag: bool,
    /// Whether it has a length and a force.
    pub(crate) is_spring: bool,
    /// How many of the dashpots, the last ones, are components of a viscous strain.
    pub(crate) viscous_strain: usize,
    /// The unit of a viscous stretch.
    pub(crate) viscous_unit: &'static str,
}

impl Shape {
    /// How many dashpots have a stretch each.
    pub(crate) const fn scalar_dashpots(&self) -> usize {
        self.dashpots - self.viscous_strain
    }
}

/// Where an element keeps its internal variables in the [`State`](crate::element::state::State).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slots {
    /// Offset of the viscous stretches.
    pub(crate) viscous: usize,
    /// Index of entropy and temperature, if the element has them.
    pub(crate) thermal: Option<usize>,
}

/// The numbering of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    /// First unknown of each node; `None` for anchors.
    pub(crate) nodes: Vec<Option<usize>>,
    /// The slots of each element.
    pub(crate) elements: Vec<Slots>,
    /// The unknown of the algorithmic temperature of each thermal slot, if it is coupled.
    pub(crate) coupled: Vec<Option<usize>>,
    /// Number of viscous stretches.
    pub(crate) viscous: usize,
    /// Number of thermal slots.
    pub(crate) thermal: usize,
    /// Number of unknowns.
    pub(crate) unknowns: usize,
}

impl Layout {
    /// Numbers a scene.
    pub(crate) fn new(
        dimension: usize,
        is_mass: impl Iterator<Item = bool>,
        shapes: impl Iterator<Item = Shape>,
        paths: impl Iterator<Item = (Element, HeatPartner)>,
    ) -> Self {
        let (mut unknowns, mut viscous, mut thermal) = (0, 0, 0);
        let mut nodes = Vec::with_capacity(is_mass.size_hint().0);
        for is_mass in is_mass {
            nodes.push(is_mass.then_some(unknowns));
            unknowns += if is_mass { dimension } else { 0 };
        }
        let mut elements = Vec::with_capacity(shapes.size_hint().0);
        for shape in shapes {
            elements.push(Slots {
                viscous,
                thermal: shape.thermal.then_some(thermal),
            });
            viscous += shape.dashpots;
            thermal += usize::from(shape.thermal);
        }
        let mut coupled = vec![None; thermal];
        for (element, partner) in paths {
            let HeatPartner::Element(partner) = partner else {
                continue;
            };
            for element in [element, partner] {
                let slot = elements[element.index()].thermal;
                if let Some(unknown @ None) = slot.map(|slot| &mut coupled[slot]) {
                    *unknown = Some(unknowns);
                    unknowns += 1;
                }
            }
        }
        Self {
            nodes,
            elements,
            coupled,
            viscous,
            thermal,
            unknowns,
        }
    }

    /// Drops the tables from nodes and elements to unknowns, which are not needed once all places are
    /// found; the numbers of unknowns and variables stay.
    pub(crate) fn forget_places(&mut self) {
        self.nodes = Vec::new();
        self.elements = Vec::new();
        self.coupled = Vec::new();
    }
}

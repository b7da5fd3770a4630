//! The DOF map: the unknowns of the global system of each node and element.
//!
//! Unknowns are the displacements of the masses and, for elements that conduct heat to other elements, their coupled
//! interface temperature. Viscous stretches and the temperatures θ are condensed within their element.

/// Capabilities of a model: dashpots, temperature, kind of measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    pub(crate) dashpots: usize,
    pub(crate) thermal: bool,
    /// Whether a dashpot acts in parallel with the spring (Kelvin–Voigt).
    pub(crate) drag: bool,
    /// Whether its measure is a length, whose conjugate is a force.
    pub(crate) is_spring: bool,
    /// The number of dashpots, the last ones, that are components of a viscous strain.
    pub(crate) viscous_strain: usize,
    /// The unit of a viscous stretch.
    pub(crate) viscous_unit: &'static str,
}

impl Shape {
    /// Number of dashpots with a stretch of their own.
    pub(crate) const fn scalar_dashpots(&self) -> usize {
        self.dashpots - self.viscous_strain
    }
}

/// The state indices of the internal variables of an element in the [`State`](crate::element::state::State).
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
    /// The unknown of the interface temperature of each thermal slot, if it is coupled.
    pub(crate) coupled: Vec<Option<usize>>,
    /// Number of viscous stretches.
    pub(crate) viscous: usize,
    /// Number of thermal slots.
    pub(crate) thermal: usize,
    /// Number of unknowns.
    pub(crate) unknowns: usize,
}

impl Layout {
    /// Numbers a scene whose elements exchange no heat.
    pub(crate) fn new(
        dimension: usize,
        mut is_mass: impl Iterator<Item = bool>,
        mut shapes: impl Iterator<Item = Shape>,
    ) -> Self {
        Self::of(dimension, &mut is_mass, &mut shapes)
    }

    fn of(
        dimension: usize,
        is_mass: &mut dyn Iterator<Item = bool>,
        shapes: &mut dyn Iterator<Item = Shape>,
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
        Self {
            nodes,
            elements,
            coupled: vec![None; thermal],
            viscous,
            thermal,
            unknowns,
        }
    }

    /// Numbers the interface temperatures of the thermal slots that exchange heat with others.
    pub(crate) fn couple(&mut self, is_coupled: impl Fn(usize) -> bool) {
        for (slot, unknown) in self.coupled.iter_mut().enumerate() {
            if is_coupled(slot) {
                *unknown = Some(self.unknowns);
                self.unknowns += 1;
            }
        }
    }

    /// Drops the tables from nodes and elements to unknowns, which are not needed once all matrix indices are
    /// found; the numbers of unknowns and variables stay.
    pub(crate) fn forget_places(&mut self) {
        self.nodes = Vec::new();
        self.elements = Vec::new();
        self.coupled = Vec::new();
    }
}

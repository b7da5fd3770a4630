//! The types of elements by their numbers in Gmsh.

/// A type of elements.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    pub(super) name: &'static str,
    /// The dimension of their entities, if it is known.
    pub(super) dimension: Option<usize>,
    /// The number of nodes of an element, if it is known.
    pub(super) nodes: Option<usize>,
}

impl Kind {
    /// The type with a number. Types of which no mesh can be made are named by their shape.
    pub(super) const fn of(number: u32) -> Self {
        let (name, dimension, nodes) = match number {
            15 => ("points", 0, Some(1)),
            1 => ("lines", 1, Some(2)),
            8 => ("lines", 1, Some(3)),
            26..=28 => ("lines", 1, None),
            2 => ("triangles", 2, Some(3)),
            9 => ("triangles", 2, Some(6)),
            20..=25 => ("triangles", 2, None),
            3 => ("Quad4", 2, Some(4)),
            16 => ("Quad8", 2, Some(8)),
            10 => ("quadrilaterals of 9 nodes", 2, Some(9)),
            4 => ("tetrahedra", 3, Some(4)),
            11 => ("tetrahedra", 3, Some(10)),
            29..=33 => ("tetrahedra", 3, None),
            5 => ("Hex8", 3, Some(8)),
            17 => ("Hex20", 3, Some(20)),
            12 => ("hexahedra of 27 nodes", 3, Some(27)),
            6 => ("prisms", 3, Some(6)),
            13 => ("prisms", 3, Some(18)),
            18 => ("prisms", 3, Some(15)),
            7 => ("pyramids", 3, Some(5)),
            14 => ("pyramids", 3, Some(14)),
            19 => ("pyramids", 3, Some(13)),
            _ => {
                return Self {
                    name: "elements of another type",
                    dimension: None,
                    nodes: None,
                };
            }
        };
        Self {
            name,
            dimension: Some(dimension),
            nodes,
        }
    }
}

//! Extrusion of plane meshes.

use std::collections::{BTreeMap, BTreeSet};

use super::Mesh;
use super::error::MeshError;
use super::geometry::per_node;
use super::grid::{check_axis, level};
use crate::element::kinematics::{Hex8, Hex20, Quad4, Quad8, Shape};

impl Mesh<Hex8, 3> {
    /// Extrudes a plane mesh along z through these heights, m: one layer of hexahedra between two heights.
    ///
    /// ```
    /// use eem::Mesh;
    /// use eem::kinematics::{Hex8, Quad4};
    ///
    /// let profile = Mesh::<Quad4, 2>::polygon(&[[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]])?;
    /// let wedge = Mesh::<Hex8, 3>::extruded(&profile, &[0.0, 0.5, 2.0])?;
    /// assert_eq!((profile.cells().len(), wedge.cells().len()), (3, 6));
    /// assert_eq!(wedge.nodes().len(), 3 * profile.nodes().len());
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::Cut`] if the heights do not ascend, [`MeshError::Empty`] if there are fewer than two.
    pub fn extruded(profile: &Mesh<Quad4, 2>, heights: &[f64]) -> Result<Self, MeshError> {
        extruded(profile, heights)
    }
}

impl Mesh<Hex20, 3> {
    /// Extrudes a plane mesh along z through these heights, m: one layer of hexahedra between two heights.
    ///
    /// ```
    /// use eem::Mesh;
    /// use eem::kinematics::{Hex20, Quad8};
    ///
    /// let strip = Mesh::<Quad8, 2>::block([4, 1], [[0.0, 4.0], [0.0, 1.0]])?;
    /// let bent = strip.mapped(|[x, y]| [x, y + 0.1 * x * x])?;
    /// let beam = Mesh::<Hex20, 3>::extruded(&bent, &[0.0, 0.5])?;
    /// assert_eq!((beam.cells().len(), beam.nodes().len()), (4, 56));
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::Cut`] if the heights do not ascend, [`MeshError::Empty`] if there are fewer than two.
    pub fn extruded(profile: &Mesh<Quad8, 2>, heights: &[f64]) -> Result<Self, MeshError> {
        extruded(profile, heights)
    }
}

/// The nodes of a hexahedron lie above those of its quadrilateral: all of them at two heights, at most the corners
/// half-way between.
fn extruded<P: Shape<2>, H: Shape<3>>(
    profile: &Mesh<P, 2>,
    heights: &[f64],
) -> Result<Mesh<H, 3>, MeshError> {
    check_axis(2, heights)?;
    // Twice the index of a height, which sorts first, and the node of the profile.
    let key = |layer: usize, cell: &P::PerNode<usize>, [x, y, z]: [i8; 3]| {
        let below = P::NODES.iter().position(|&node| node == [x, y]);
        let below = below.unwrap_or_else(|| unreachable!("hexahedra stand on quadrilaterals"));
        let at = (2 * layer + 1).saturating_add_signed(isize::from(z));
        [at, cell.as_ref()[below]]
    };
    let layers = 0..heights.len() - 1;
    let all = layers.flat_map(|layer| profile.cells.iter().map(move |cell| (layer, cell)));
    let nodes = H::NODES.iter();
    let keys = all.map(|(layer, cell)| nodes.clone().map(|&node| key(layer, cell, node)).collect());
    let keys: Vec<Vec<[usize; 2]>> = keys.collect();
    let sorted: BTreeSet<[usize; 2]> = keys.iter().flatten().copied().collect();
    let nodes: BTreeMap<_, _> = sorted.into_iter().zip(0..).collect();
    let place = |&[at, node]: &[usize; 2]| {
        let [x, y] = profile.nodes[node];
        [x, y, level(heights, at)]
    };
    let cell = |keys: &Vec<[usize; 2]>| per_node::<H, _, 3>(|at| nodes[&keys[at]]);
    Mesh::new(
        nodes.keys().map(place).collect(),
        keys.iter().map(cell).collect(),
    )
}

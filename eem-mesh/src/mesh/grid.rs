//! Meshes of boxes, and extrusion of plane meshes.

use super::Mesh;
use super::error::MeshError;
use super::geometry::per_node;
use super::lattice::Lattice;
use crate::shape::{Hex8, Hex20, Quad4, Quad8, Shape};

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// A box between two coordinates per axis, m, divided into equal cells. The first coordinate varies fastest.
    ///
    /// ```
    /// use eem::kinematics::Hex8;
    /// use eem::Mesh;
    ///
    /// let cube = Mesh::<Hex8, 3>::block([2, 2, 2], [[-0.5, 0.5]; 3])?;
    /// assert_eq!((cube.cells().len(), cube.nodes().len()), (8, 27));
    /// assert_eq!(cube.nodes()[1], [0.0, -0.5, -0.5]);
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::Empty`] if an axis has no cells, [`MeshError::Range`] if its coordinates do not ascend;
    /// [`MeshError::TooMany`] and [`MeshError::TooLarge`], before memory is reserved, if there are too many nodes
    /// or too little memory. The latter needs the feature `sparse`.
    pub fn block(cells: [usize; D], ranges: [[f64; 2]; D]) -> Result<Self, MeshError> {
        for (axis, [from, to]) in ranges.into_iter().enumerate() {
            if !(from.is_finite() && to.is_finite() && from < to) {
                return Err(MeshError::Range { axis, from, to });
            }
        }
        let lattice = Lattice::of(cells)?;
        let cuts: [Vec<f64>; D] = core::array::from_fn(|axis| {
            let [from, to] = ranges[axis];
            // `Lattice::of` has refused more.
            let parts = u32::try_from(cells[axis]).unwrap_or(u32::MAX);
            let all = f64::from(parts);
            let cut = |at: u32| {
                let at = f64::from(at);
                // Exact at both ends.
                let cut = (from * (all - at) + to * at) / all;
                if cut.is_finite() {
                    cut
                } else {
                    from * ((all - at) / all) + to * (at / all)
                }
            };
            (0..=parts).map(cut).collect()
        });
        let cuts = cuts.each_ref().map(Vec::as_slice);
        check_cuts(cuts)?;
        Self::on_lattice(&lattice, cuts)
    }

    /// A box divided at these coordinates along each axis, m.
    ///
    /// ```
    /// use eem::kinematics::Quad8;
    /// use eem::Mesh;
    ///
    /// let graded = Mesh::<Quad8, 2>::grid([&[0.0, 1.0, 4.0], &[0.0, 1.0]])?;
    /// // Corners and middles of edges.
    /// assert_eq!(graded.nodes()[1], [0.5, 0.0]);
    /// assert_eq!(graded.nodes().len(), 13);
    /// # Ok::<(), eem::MeshError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`MeshError::Empty`] if an axis has no cells, [`MeshError::Cut`] if its coordinates do not ascend;
    /// [`MeshError::TooMany`] and [`MeshError::TooLarge`] as for a [`block`](Self::block).
    pub fn grid(cuts: [&[f64]; D]) -> Result<Self, MeshError> {
        check_cuts(cuts)?;
        Self::on_lattice(&Lattice::of(cuts.map(|cuts| cuts.len() - 1))?, cuts)
    }

    fn on_lattice(lattice: &Lattice<H, D>, cuts: [&[f64]; D]) -> Result<Self, MeshError> {
        let place = |at: [usize; D]| -> [f64; D] {
            core::array::from_fn(|axis| level(cuts[axis], at[axis]))
        };
        // Middles of edges are between the corners of a cell.
        let named = |cell: [usize; D]| {
            per_node::<H, _, D>(|at| {
                lattice.number(core::array::from_fn(|axis| {
                    (2 * cell[axis] + 1).saturating_add_signed(isize::from(H::NODES[at][axis]))
                }))
            })
        };
        let (mut places, mut cells) = lattice.reserved()?;
        places.extend(lattice.places().map(place));
        cells.extend(indices(cuts.map(|cuts| cuts.len() - 1)).map(named));
        Self::new(places, cells)
    }
}

/// The position `at/2` cuts along an axis, m: a cut, or the middle between two.
pub(super) fn level(cuts: &[f64], at: usize) -> f64 {
    let below = cuts[at / 2];
    match at % 2 {
        0 => below,
        _ => f64::midpoint(below, cuts[at / 2 + 1]),
    }
}

/// An error unless there are at least two cuts along each axis, which ascend.
fn check_cuts<const D: usize>(cuts: [&[f64]; D]) -> Result<(), MeshError> {
    let mut axes = cuts.iter().enumerate();
    axes.try_for_each(|(axis, cuts)| check_axis(axis, cuts))
}

/// An error unless there are at least two cuts, which ascend.
pub(super) fn check_axis(axis: usize, cuts: &[f64]) -> Result<(), MeshError> {
    let mut before = f64::NEG_INFINITY;
    for (cut, &value) in cuts.iter().enumerate() {
        if !(value > before && value.is_finite()) {
            return Err(MeshError::Cut { axis, cut, value });
        }
        before = value;
    }
    if cuts.len() < 2 {
        return Err(MeshError::Empty);
    }
    Ok(())
}

/// All indices below these, the first coordinate fastest.
pub(super) fn indices<const D: usize>(counts: [usize; D]) -> impl Iterator<Item = [usize; D]> {
    let number = counts.iter().product();
    let index = move |mut rest: usize| {
        counts.map(|count| {
            let own = rest % count;
            rest /= count;
            own
        })
    };
    (0..number).map(index)
}

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
    // The nodes in their order: far less to compile than a map.
    let mut nodes = keys.concat();
    nodes.sort_unstable();
    nodes.dedup();
    let number = |key: &[usize; 2]| match nodes.binary_search(key) {
        Ok(number) | Err(number) => number,
    };
    let place = |&[at, node]: &[usize; 2]| {
        let [x, y] = profile.nodes[node];
        [x, y, level(heights, at)]
    };
    let cell = |keys: &Vec<[usize; 2]>| per_node::<H, _, 3>(|at| number(&keys[at]));
    Mesh::new(
        nodes.iter().map(place).collect(),
        keys.iter().map(cell).collect(),
    )
}

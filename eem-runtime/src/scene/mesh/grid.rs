//! Meshes of boxes that planes cut into cells.

use std::collections::BTreeMap;

use super::Mesh;
use super::error::MeshError;
use crate::element::kinematics::Shape;
use crate::material::free_energy::Array;

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// A box between two ends along each axis, m, cut into equal cells. The first coordinate runs fastest.
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
    /// If there are no cells along an axis, or its ends do not ascend.
    pub fn block(cells: [usize; D], ranges: [[f64; 2]; D]) -> Result<Self, MeshError> {
        let cuts: [Vec<f64>; D] = core::array::from_fn(|axis| {
            let ([from, to], parts) = (ranges[axis], cells[axis]);
            let counted = core::iter::successors(Some(0.0), |at| Some(at + 1.0));
            let all = counted.clone().nth(parts).unwrap_or(0.0);
            // Exact at both ends.
            let cut = |at: f64| (from * (all - at) + to * at) / all;
            match parts {
                0 => vec![from],
                _ => counted.take(parts + 1).map(cut).collect(),
            }
        });
        Self::grid(cuts.each_ref().map(Vec::as_slice))
    }

    /// A box that is cut at these places along each axis, m.
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
    /// If there are no cells along an axis, or cuts do not ascend.
    pub fn grid(cuts: [&[f64]; D]) -> Result<Self, MeshError> {
        check_cuts(cuts)?;
        let cells = indices(cuts.map(|cuts| cuts.len() - 1));
        // Twice the index of a cut: middles of edges are in between. The last coordinate sorts first.
        let key = |cell: &[usize; D], node: &[i8; D]| -> [usize; D] {
            core::array::from_fn(|back| {
                let axis = D - 1 - back;
                (2 * cell[axis] + 1).saturating_add_signed(isize::from(node[axis]))
            })
        };
        let all = cells.iter();
        let keys = all.flat_map(|cell| H::NODES.iter().map(move |node| key(cell, node)));
        let mut nodes: BTreeMap<[usize; D], usize> = keys.map(|key| (key, 0)).collect();
        let counted = nodes.values_mut().enumerate();
        counted.for_each(|(index, node)| *node = index);
        let place = |key: &[usize; D]| -> [f64; D] {
            core::array::from_fn(|axis| {
                let twice = key[D - 1 - axis];
                let before = cuts[axis][twice / 2];
                match twice % 2 {
                    0 => before,
                    _ => f64::midpoint(before, cuts[axis][twice / 2 + 1]),
                }
            })
        };
        let places = nodes.keys().map(place).collect();
        let named = |cell: &[usize; D]| {
            let mut named = H::PerNode::filled(0);
            for (name, node) in named.as_mut().iter_mut().zip(H::NODES) {
                *name = nodes[&key(cell, node)];
            }
            named
        };
        Self::new(places, cells.iter().map(named).collect())
    }
}

/// At least two cuts along each axis, which ascend.
fn check_cuts<const D: usize>(cuts: [&[f64]; D]) -> Result<(), MeshError> {
    let mut axes = cuts.iter().enumerate();
    axes.try_for_each(|(axis, cuts)| check_axis(axis, cuts))
}

/// At least two cuts, which ascend.
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
pub(super) fn indices<const D: usize>(counts: [usize; D]) -> Vec<[usize; D]> {
    let number = counts.iter().product();
    let index = |mut rest: usize| {
        counts.map(|count| {
            let own = rest % count;
            rest /= count;
            own
        })
    };
    (0..number).map(index).collect()
}

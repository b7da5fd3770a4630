//! Parts of the surface of a mesh, and the faces of the sub-cells of integration points with their skewness.

use super::geometry::distance;
use eem_material::number::digest::Digest;

/// Some faces on the surface of a mesh, from [`Mesh::face`](crate::Mesh::face). They are valid for copies of the
/// mesh and for equal meshes, but not after it has been moved, mapped or refined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Face {
    /// The digest of its mesh.
    pub(super) mesh: Digest,
    /// Cells with the number of their face, in ascending order.
    #[doc(hidden)]
    pub sides: Vec<[usize; 2]>,
    /// Their nodes, each once, in ascending order.
    pub(super) nodes: Vec<usize>,
}

impl Face {
    /// The nodes of the mesh that belong to these faces, in ascending order.
    #[must_use]
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }
}

/// A closed line of nodes, from [`Mesh::outlines`](crate::Mesh::outlines).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outline {
    /// The cell, from 0.
    pub cell: usize,
    /// Its nodes, from 0, in order; the last is connected to the first.
    pub nodes: Vec<usize>,
}

/// A face of the sub-cell of an integration point.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct SubFace<const D: usize> {
    /// The point, counted cell by cell.
    pub point: usize,
    /// `|A|`; m², m in the plane.
    pub area: f64,
    /// `t/k`; m, dimensionless in the plane.
    pub shape_factor: f64,
    /// The centre, m.
    pub(super) centre: [f64; D],
    /// `|A·d|/(|A| |d|)`.
    pub(super) cosine: f64,
}

/// Pairs each sub-face on one side of a face with the nearest one on the other side.
#[must_use]
pub fn facing<const D: usize>(
    first: Vec<SubFace<D>>,
    second: &[SubFace<D>],
) -> Vec<[SubFace<D>; 2]> {
    let pair = |face: SubFace<D>| {
        let far = |other: &SubFace<D>| distance(other.centre, face.centre);
        let nearest = second.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        nearest.map(|other| [face, *other])
    };
    first.into_iter().filter_map(pair).collect()
}

/// The least cosine `|A·d|/(|A| |d|)` between a path of heat and the normal of its face that counts as orthogonal: that
/// of 18°, or of a shear of a third.
const LEAST_COSINE: f64 = 0.95;

/// One face in this many may be skew. A cell sheared by a third conducts about 0.3 k across its grid. If one face in
/// twenty does, the flow has an error of at most 0.3/20, about 2 %, as on a mesh of four cells per side.
const ONE_IN: usize = 20;

/// The skew faces between points, and the worst of them.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct Skewness {
    /// The number of faces.
    pub faces: usize,
    /// The number of skew ones.
    pub skew: usize,
    /// The cosine of the worst.
    pub cosine: f64,
    /// Its cell.
    pub cell: usize,
}

impl Skewness {
    /// From both sides of each face, for cells with `per_cell` points.
    pub(super) fn of<const D: usize>(pairs: &[[SubFace<D>; 2]], per_cell: usize) -> Self {
        let mut skewness = Self {
            faces: pairs.len(),
            skew: 0,
            cosine: 1.0,
            cell: 0,
        };
        for pair in pairs {
            for face in pair {
                if face.cosine < skewness.cosine {
                    skewness.cosine = face.cosine;
                    skewness.cell = face.point / per_cell;
                }
            }
            if pair.iter().any(|face| face.cosine < LEAST_COSINE) {
                skewness.skew += 1;
            }
        }
        skewness
    }

    /// Whether conduction deviates from Fourier's law.
    #[doc(hidden)]
    #[must_use]
    pub fn is_too_much(&self) -> bool {
        self.skew * ONE_IN > self.faces
    }
}

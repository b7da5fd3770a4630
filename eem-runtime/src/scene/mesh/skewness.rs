//! How far the paths of heat are from the normals of the faces that they cross.

use super::sub_face::SubFace;

/// The least cosine `|A·d|/(|A| |d|)` between a path and the normal of its face that counts as orthogonal. It is that
/// of 18°, or of a shear of a third.
pub(crate) const LEAST_COSINE: f64 = 0.95;

/// One face in so many may be skew. A cell sheared by a third conducts some 0.3 k across its grid. Where one face in
/// twenty does so, the flow is off by at most 0.3/20, some 2 %, about what a mesh of four cells per side is off.
const ONE_IN: usize = 20;

/// How many faces between points are skew, and which is the worst.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Skewness {
    /// How many there are.
    pub(crate) faces: usize,
    /// How many are skew.
    pub(crate) skew: usize,
    /// The cosine of the worst.
    pub(crate) cosine: f64,
    /// Its cell.
    pub(crate) cell: usize,
}

impl Skewness {
    /// That of both sides of each face, for cells with so many points.
    pub(super) fn of<const D: usize>(pairs: &[[SubFace<D>; 2]], per_cell: usize) -> Self {
        let mut skewness = Self {
            faces: pairs.len(),
            skew: 0,
            cosine: 1.0,
            cell: 0,
        };
        for pair in pairs {
            for face in pair {
                if face.alignment < skewness.cosine {
                    skewness.cosine = face.alignment;
                    skewness.cell = face.point / per_cell;
                }
            }
            if pair.iter().any(|face| face.alignment < LEAST_COSINE) {
                skewness.skew += 1;
            }
        }
        skewness
    }

    /// Whether conduction is not Fourier's law.
    pub(crate) fn is_too_much(&self) -> bool {
        self.skew * ONE_IN > self.faces
    }
}

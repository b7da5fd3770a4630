//! Faces of the sub-cells that belong to points.

use super::geometry::distance;

/// A face of a sub-cell: of which point of the mesh it is, and how it lies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SubFace<const D: usize> {
    /// Cell by cell.
    pub(crate) point: usize,
    /// `|A|`; m², m in the plane.
    pub(crate) area: f64,
    /// `t/k`; m, one in the plane.
    pub(crate) reach: f64,
    /// m.
    pub(super) centre: [f64; D],
    /// `|A·d|/(|A| |d|)`
    pub(super) alignment: f64,
}

/// Each of the sub-faces on one side of a face with that on the other side which is nearest.
pub(crate) fn facing<const D: usize>(
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

//! Faces of the sub-cells that belong to points.

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

//! Stress and strain at a point of a solid.

use nalgebra::SMatrix;

/// Stress and strain at a point of a solid, in three dimensions also in plane strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidState {
    /// Cauchy's stress `σ = F S Fᵀ/J` without that of dashpots in parallel with the solid, Pa.
    pub stress: SMatrix<f64, 3, 3>,
    /// Green and Lagrange's strain `E = ½(FᵀF − 1)`.
    pub strain: SMatrix<f64, 3, 3>,
    /// `J − 1`.
    pub dilatation: f64,
}

impl SolidState {
    /// Von Mises's equivalent stress `√(³⁄₂ dev σ:dev σ)`, Pa.
    #[must_use]
    pub fn von_mises(&self) -> f64 {
        let s = |i, j| self.stress[(i, j)];
        let differences = [s(0, 0) - s(1, 1), s(1, 1) - s(2, 2), s(2, 2) - s(0, 0)];
        let shears = [s(0, 1), s(1, 2), s(2, 0)];
        let square = |sum, &entry: &f64| sum + entry * entry;
        let normal = differences.iter().fold(0.0, square);
        let shear = shears.iter().fold(0.0, square);
        (0.5 * normal + 3.0 * shear).sqrt()
    }
}

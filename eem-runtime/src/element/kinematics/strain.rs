//! Which measures of strain a free energy per volume depends on.

/// A measure of the strain at a point of a solid: an invariant of the Green–Lagrange strain
/// `E = ½(FᵀF − 1)` with the deformation gradient F.
///
/// Nothing in it is a difference from one, so that small strains keep their digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strain {
    /// `tr E`; role `StrainTrace`.
    Trace,
    /// `E:E`; role `StrainSquare`.
    Square,
    /// `J − 1`, `J = det F`; role `Dilatation`.
    Dilatation,
}

/// A free energy per reference volume, J/m³, that depends on N measures of strain.
///
/// `#[derive(FreeEnergy)]` implements it where the arguments of the formula have roles of strains.
///
/// ```
/// use eem::{Strain, StrainEnergy};
///
/// struct Elastic;
/// impl StrainEnergy<2> for Elastic {
///     const STRAINS: [Strain; 2] = [Strain::Trace, Strain::Square];
/// }
/// assert_eq!(Elastic::STRAINS[1], Strain::Square);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no free energy of strains",
    label = "not a material of solids",
    note = "a solid needs arguments like `e1: StrainTrace` and `e2: StrainSquare` in `#[free_energy(…)]`"
)]
pub trait StrainEnergy<const N: usize> {
    /// The measures, in the order of the arguments.
    const STRAINS: [Strain; N];
}

//! The measures of strain on which a free energy per volume depends.

use eem_material::free_energy::{FreeEnergy, Material};
use eem_material::number::scalar::Scalar;

/// A measure of the strain at a point of a solid: an invariant of the Green–Lagrange strain
/// `E = ½(FᵀF − 1)` with the deformation gradient F.
///
/// All are zero at rest, so small strains keep their digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strain {
    /// `tr E`; role `StrainTrace`.
    Trace,
    /// `E:E`; role `StrainSquare`.
    Square,
    /// `J − 1`, `J = det F`; role `Dilatation`.
    Dilatation,
    /// `a·E a` along a fibre with the direction a; role `FibreStrain`.
    Fibre,
    /// `E:b_k` with the k-th of six tensors of length one at right angles to each other,
    ///
    /// ```text
    /// b_0 = (xx − yy)/√2,   b_1 = (xx + yy − 2zz)/√6,   b_2, b_3, b_4 = √2 sym(xy), √2 sym(xz), √2 sym(yz),
    /// b_5 = (xx + yy + zz)/√3
    /// ```
    ///
    /// of which free energies with the role `ViscousStrain` have all, or the first five.
    Component(usize),
}

/// A measure of the strain at a point of a solid, with the directions of fibres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure<const D: usize> {
    /// `tr E`.
    Trace,
    /// `E:E`.
    Square,
    /// `J − 1`.
    Dilatation,
    /// `a·E a` with the unit vector a.
    Fibre([f64; D]),
    /// `E:b_k`, see [`Strain::Component`].
    Component(usize),
}

impl<const D: usize> Measure<D> {
    /// Gives the fibres among some measures their directions, one after the other; the lengths of the
    /// directions do not matter.
    ///
    /// ```
    /// use eem::kinematics::{Measure, Strain};
    ///
    /// let strains = [Strain::Trace, Strain::Fibre];
    /// let measures = Measure::along(strains, &[[3.0, 4.0]]);
    /// assert_eq!(measures, Some([Measure::Trace, Measure::Fibre([0.6, 0.8])]));
    /// assert_eq!(Measure::<2>::along(strains, &[]), None);
    /// assert_eq!(Measure::along(strains, &[[0.0, 0.0]]), None);
    /// ```
    ///
    /// `None` unless there are as many directions as fibres, each finite and not zero.
    #[must_use]
    pub fn along<const N: usize>(
        strains: [Strain; N],
        directions: &[[f64; D]],
    ) -> Option<[Self; N]> {
        let mut directions = directions.iter();
        let mut measures = [Self::Trace; N];
        for (measure, strain) in measures.iter_mut().zip(strains) {
            *measure = match strain {
                Strain::Trace => Self::Trace,
                Strain::Square => Self::Square,
                Strain::Dilatation => Self::Dilatation,
                Strain::Fibre => Self::Fibre(unit(directions.next()?)?),
                Strain::Component(k) => Self::Component(k),
            };
        }
        directions.next().is_none().then_some(measures)
    }
}

/// `a/|a|`.
fn unit<const D: usize>(direction: &[f64; D]) -> Option<[f64; D]> {
    let length = direction
        .iter()
        .fold(0.0, |length, &component| Scalar::hypot(length, component));
    let is_length = length > 0.0 && length.is_finite();
    is_length.then(|| direction.map(|component| component / length))
}

/// A free energy per reference volume, J/m³, that depends on N measures of strain.
///
/// `#[derive(FreeEnergy)]` implements it for formulas with strain arguments.
///
/// ```
/// use eem::{Strain, StrainEnergy};
///
/// #[derive(eem::FreeEnergy)]
/// #[free_energy(|e1: StrainTrace, e2: StrainSquare| 500.0 * e1.powi(2) + 1000.0 * e2)]
/// struct Elastic;
///
/// assert_eq!(<Elastic as StrainEnergy<2>>::STRAINS[1], Strain::Square);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no free energy of strains",
    label = "not a material of solids",
    note = "a solid needs arguments like `e1: StrainTrace` and `e2: StrainSquare` in `#[free_energy(…)]`"
)]
pub trait StrainEnergy<const N: usize> {
    /// The measures at a point, in the order of the arguments; then the components of the strain, if there is a
    /// viscous strain.
    const STRAINS: [Strain; N];

    /// [`STRAINS`](Self::STRAINS), unless the measures are known only at run time.
    fn strains(&self) -> [Strain; N] {
        Self::STRAINS
    }

    /// The free energy as a function of these measures: the material itself or, with a viscous strain, a function of
    /// components in place of the joint invariants of strain and viscous strain.
    type AtPoint: FreeEnergy<f64> + Send + Sync + 'static
    where
        Self: Material;

    /// The material at a point.
    fn at_point(&self) -> Self::AtPoint
    where
        Self: Material;
}

//! The heat of the dashpot beside a spring or a solid at a stage.

use crate::element::kinematics::{PerStrain, QuadraticStrain};
use crate::element::tableau::MOST_SETS;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Real;

/// What the dashpot turns into heat at a stage, `f ν`, J, and its derivatives by the increments of the strain, with the
/// temperature held, and by the temperature.
#[derive(Debug)]
pub(super) struct DragHeat<S: Real, K: QuadraticStrain<S, D>, const D: usize> {
    pub(super) heat: S,
    pub(super) by_strain: [PerStrain<K, S, D>; MOST_SETS],
    pub(super) by_theta: S,
}

impl<S: Real, K: QuadraticStrain<S, D>, const D: usize> DragHeat<S, K, D> {
    /// None.
    pub(super) fn zero() -> Self {
        Self {
            heat: S::zero(),
            by_strain: [PerStrain::<K, S, D>::filled(S::zero()); MOST_SETS],
            by_theta: S::zero(),
        }
    }
}

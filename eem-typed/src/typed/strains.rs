//! Solids of laws: their strains, and at a point the components of a viscous strain.

use eem_material::free_energy::{FreeEnergy, Material};
use eem_material::{ComponentEnergy, Joint, JointEnergy};
use eem_runtime::{Strain, StrainEnergy};

use super::Typed;
use crate::shape::{Flow, KEPT, Strains};

/// Room for what is kept of the old state of a material, and for the components of E and Γ.
const KEPT_WITH_COMPONENTS: usize = KEPT + 12;

// Which strains they are is known only at run time, from `strains`; only the length of `STRAINS` counts.
impl<
    const M: usize,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
> StrainEnergy<M> for Typed<Strains<M>, N, K, V, D, C, R, KEPT>
{
    const STRAINS: [Strain; M] = [Strain::Trace; M];

    fn strains(&self) -> [Strain; M] {
        self.functions.strains_at_point()
    }

    type AtPoint
        = Self
    where
        Self: Material;

    fn at_point(&self) -> Self
    where
        Self: Material,
    {
        FreeEnergy::<f64>::duplicate(self)
    }
}

impl<
    const M: usize,
    const N1: usize,
    const K1: usize,
    const R1: usize,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
> StrainEnergy<M> for Typed<Flow<M, N1, K1, R1>, N, K, V, D, C, R, KEPT>
{
    const STRAINS: [Strain; M] = [Strain::Trace; M];

    fn strains(&self) -> [Strain; M] {
        self.functions.strains_at_point()
    }

    type AtPoint
        = ComponentEnergy<Self, N1, K1, R1, KEPT_WITH_COMPONENTS, KEPT_WITH_COMPONENTS>
    where
        Self: Material;

    fn at_point(&self) -> Self::AtPoint
    where
        Self: Material,
    {
        ComponentEnergy::new(FreeEnergy::<f64>::duplicate(self))
    }
}

impl<
    const M: usize,
    const N1: usize,
    const K1: usize,
    const R1: usize,
    const N: usize,
    const K: usize,
    const V: usize,
    const D: usize,
    const C: usize,
    const R: usize,
> JointEnergy for Typed<Flow<M, N1, K1, R1>, N, K, V, D, C, R, KEPT>
{
    // Only their number, and whether the trace is among them, are right: which they are, `joints` says.
    const JOINT: &'static [Joint] = match (Self::SHAPE.joints, Self::SHAPE.flows) {
        (1, 1) => &[Joint::Strain],
        (2, 1) => &[Joint::Strain, Joint::Square],
        (1, 2) => &[Joint::Trace],
        (2, 2) => &[Joint::Strain, Joint::Trace],
        (3, 2) => &[Joint::Strain, Joint::Square, Joint::Trace],
        _ => panic!("there are one to three invariants"),
    };

    fn joints(&self) -> &[Joint] {
        &self.functions.joints
    }
}

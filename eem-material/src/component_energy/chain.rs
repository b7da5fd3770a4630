//! The chain rule between joint invariants and components of E and Γ.

use super::ComponentEnergy;
use crate::free_energy::{Array, FreeEnergy};
use crate::joint::{DEVIATORIC, Joint, JointEnergy, Tensors};
use crate::number::scalar::Real;

/// Derivatives by variables: a row per quantity.
pub(super) type Rows<S, const N: usize, const R: usize> = [[S; N]; R];

impl<M: JointEnergy, const N: usize, const K: usize, const R: usize, const A: usize, const B: usize>
    ComponentEnergy<M, N, K, R, A, B>
{
    /// Number of strains of the material.
    const fn strains<S: Real>() -> usize
    where
        M: FreeEnergy<S>,
    {
        M::MEASURES - M::JOINT.len()
    }

    /// Number of components of Γ.
    const fn components<S: Real>() -> usize
    where
        M: FreeEnergy<S>,
    {
        K - M::DASHPOTS
    }

    /// The components of E among the variables begin here, those of Γ there.
    const fn places<S: Real>() -> [usize; 2]
    where
        M: FreeEnergy<S>,
    {
        let strains = Self::strains::<S>();
        let dashpots = strains + Self::components::<S>();
        [strains, dashpots + M::DASHPOTS]
    }

    /// Where a variable or a conjugate of the material that is no invariant is among those here.
    const fn place<S: Real>(index: usize) -> usize
    where
        M: FreeEnergy<S>,
    {
        let invariants = M::JOINT.len();
        if index < Self::strains::<S>() {
            index
        } else if index < M::MEASURES + M::DASHPOTS {
            index - invariants + Self::components::<S>()
        } else {
            index - invariants + 2 * Self::components::<S>()
        }
    }

    /// The invariant at an index of the variables of the material.
    fn joint<S: Real>(index: usize) -> Option<Joint>
    where
        M: FreeEnergy<S>,
    {
        let joint = index.checked_sub(Self::strains::<S>())?;
        M::JOINT.get(joint).copied()
    }

    /// The index of an invariant among the variables of the material.
    pub(super) fn invariants<S: Real>() -> impl Iterator<Item = (usize, Joint)>
    where
        M: FreeEnergy<S>,
    {
        (Self::strains::<S>()..).zip(M::JOINT.iter().copied())
    }

    /// E and Γ.
    pub(super) fn tensors<S: Real>(x: &[S; N]) -> Tensors<S>
    where
        M: FreeEnergy<S>,
    {
        let [strain, viscous] = Self::places::<S>();
        let components = Self::components::<S>();
        Tensors::new(
            &x[strain..strain + components],
            &x[viscous..viscous + components],
        )
    }

    /// The variables of the material.
    pub(super) fn variables<S: Real>(x: &[S; N]) -> M::Variables
    where
        M: FreeEnergy<S>,
    {
        let tensors = Self::tensors(x);
        let mut variables = M::Variables::filled(S::zero());
        for (index, variable) in variables.as_mut().iter_mut().enumerate() {
            *variable = match Self::joint::<S>(index) {
                Some(joint) => tensors.value(joint),
                None => x[Self::place::<S>(index)],
            };
        }
        variables
    }

    /// The derivative by the variables here of what has these derivatives by those of the material.
    fn chained<S: Real>(tensors: &Tensors<S>, by: &[S]) -> [S; N]
    where
        M: FreeEnergy<S>,
    {
        let [strain, viscous] = Self::places::<S>();
        let mut chained = [S::zero(); N];
        for (index, &by) in by.iter().enumerate() {
            match Self::joint::<S>(index) {
                Some(joint) => {
                    for k in 0..Self::components::<S>() {
                        chained[strain + k] += by * tensors.by_strain(joint, k);
                        chained[viscous + k] += by * tensors.by_viscous(joint, k);
                    }
                }
                None => chained[Self::place::<S>(index)] = by,
            }
        }
        chained
    }

    /// Conjugates of the variables here from those of the material, along gradients `P` of the invariants; the
    /// sign of those of Γ is the one given.
    pub(super) fn conjugates<S: Real, const W: usize>(
        along: &Tensors<S>,
        response: &[S],
        sign: S,
    ) -> [S; W]
    where
        M: FreeEnergy<S>,
    {
        let [strain, viscous] = Self::places::<S>();
        let mut conjugates = [S::zero(); W];
        for (index, &value) in response.iter().enumerate() {
            let Some(joint) = Self::joint::<S>(index) else {
                conjugates[Self::place::<S>(index)] = value;
                continue;
            };
            for k in 0..Self::components::<S>() {
                conjugates[strain + k] += value * along.by_strain(joint, k);
                conjugates[viscous + k] += sign * (value * along.by_viscous(joint, k));
            }
        }
        conjugates
    }

    /// The derivatives of conjugates by the new variables, from those of the material; the gradients change by
    /// the share given of those at the new state.
    pub(super) fn slopes<S: Real, const W: usize>(
        [along, new]: [&Tensors<S>; 2],
        (response, tangent): (&[S], &[M::Variables]),
        [sign, share]: [S; 2],
    ) -> Rows<S, N, W>
    where
        M: FreeEnergy<S>,
    {
        let [strain, viscous] = Self::places::<S>();
        let mut slopes = [[S::zero(); N]; W];
        for (index, row) in tangent.iter().enumerate() {
            let row = Self::chained(new, row.as_ref());
            let Some(joint) = Self::joint::<S>(index) else {
                slopes[Self::place::<S>(index)] = row;
                continue;
            };
            let force = share * response[index];
            for k in 0..Self::components::<S>() {
                let by = [along.by_strain(joint, k), sign * along.by_viscous(joint, k)];
                for (column, &entry) in row.iter().enumerate() {
                    slopes[strain + k][column] += by[0] * entry;
                    slopes[viscous + k][column] += by[1] * entry;
                }
                match joint {
                    Joint::Trace => {}
                    Joint::Square => slopes[viscous + k][viscous + k] += sign * (force + force),
                    Joint::Strain => {
                        slopes[strain + k][viscous + k] += force;
                        slopes[viscous + k][strain + k] += sign * force;
                    }
                }
            }
        }
        slopes
    }

    /// Splits what a form keeps: that of the material, E and Γ.
    pub(super) fn split<S: Real, T: Array<S>>(old: &[S]) -> (T, Tensors<S>)
    where
        M: FreeEnergy<S>,
    {
        let mut own = T::filled(S::zero());
        let (of_material, components) = old.split_at(T::LEN);
        own.as_mut().copy_from_slice(of_material);
        let (strain, viscous) = components.split_at(Self::components::<S>());
        (own, Tensors::new(strain, viscous))
    }

    /// Puts together what a form keeps.
    pub(super) fn joined<S: Real, const W: usize>(own: &[S], x0: &[S; N]) -> [S; W]
    where
        M: FreeEnergy<S>,
    {
        let components = Self::components::<S>();
        let mut all = [S::zero(); W];
        let (of_material, rest) = all.split_at_mut(own.len());
        of_material.copy_from_slice(own);
        for (part, place) in rest.chunks_exact_mut(components).zip(Self::places::<S>()) {
            part.copy_from_slice(&x0[place..place + components]);
        }
        all
    }

    /// The response of a form of the material, and its tangent.
    pub(super) fn form<S: Real>(
        old: &Tensors<S>,
        x1: &[S; N],
        (response, tangent): (&M::Response, &M::Tangent),
    ) -> ([S; R], Rows<S, N, R>)
    where
        M: FreeEnergy<S>,
    {
        let new = Self::tensors(x1);
        let mean = old.mean(&new);
        let (response, tangent) = (response.as_ref(), tangent.as_ref());
        let half = S::from_f64(0.5);
        (
            Self::conjugates(&mean, response, -S::one()),
            Self::slopes([&mean, &new], (response, tangent), [-S::one(), half]),
        )
    }

    /// Viscosities of the components from those of the material.
    pub(super) fn spread<S: Real>(own: &[S]) -> [S; K]
    where
        M: FreeEnergy<S>,
    {
        let dashpots = M::DASHPOTS;
        core::array::from_fn(|k| {
            if k < dashpots {
                own[k]
            } else if k < dashpots + DEVIATORIC {
                own[dashpots]
            } else {
                own[dashpots + 1]
            }
        })
    }
}

//! The tangent at a point of a solid.
//!
//! ```text
//! force_i = F S B_i,   S = Σ_n f_n P_n
//! K_ij    = B_i·(𝔸·B_j + Σ_n F P_n ⊗ ∂f_n/∂r_j),     𝔸 = ∂(F S)/∂F¹ at constant f
//! ```
//!
//! 𝔸 is computed once per point, and multiplied with all arms at once, in loops of fixed length that the compiler
//! vectorises.

use core::array;

use crate::element::kinematics::solid::{PerArm, PerPair, SolidPoint, Strains};
use eem_material::free_energy::Array;
use eem_material::number::scalar::Real;
use eem_mesh::Shape;
use eem_mesh::tensor::{Symmetric, Tensor, add, dot, pushed};

/// `∂(F S)_am/∂F_bl`, in the order of the indices a, m, b, l.
type Moduli<S, const D: usize> = [[Tensor<S, D>; D]; D];

impl<H: Shape<D>, S: Real, const N: usize, const D: usize> SolidPoint<H, S, N, D> {
    /// Adds the derivative of `F S B_i` with respect to the new deformation, of whose change F takes the fraction `share`.
    /// The derivatives of the forces with respect to the arms are included if they are given.
    pub(super) fn add_stiffness(
        &self,
        [tensor, new]: [&Tensor<S, D>; 2],
        between: &Strains<H, S, D>,
        (force, force_by_arm): (&[S; N], &[PerArm<H, S, D>]),
        share: S,
        sum: &mut PerPair<H, S, D>,
    ) {
        let slopes = self
            .measures
            .each_ref()
            .map(|measure| between.slope(measure));
        let moduli = self.moduli([tensor, new], between, (force, &slopes), share);
        for (axis, row) in tensor.iter().enumerate() {
            let mut changes = self.changes(&moduli[axis]);
            for (slope, by_arm) in slopes.iter().zip(force_by_arm) {
                let along = slope.applied(row);
                for (change, along) in changes.iter_mut().zip(along) {
                    add_scaled::<H, S, D>(change, along, by_arm);
                }
            }
            for (b, blocks) in self.gradients.as_ref().iter().zip(sum.as_mut()) {
                let entries = combined::<H, S, D>(b, &changes);
                for (block, entries) in blocks.as_mut().iter_mut().zip(entries.as_ref()) {
                    for (sum, &entry) in block[axis].iter_mut().zip(entries) {
                        *sum += entry;
                    }
                }
            }
        }
    }

    /// 𝔸.
    #[inline]
    fn moduli(
        &self,
        [tensor, new]: [&Tensor<S, D>; 2],
        between: &Strains<H, S, D>,
        (force, slopes): (&[S; N], &[H::Tensor<S>; N]),
        share: S,
    ) -> Moduli<S, D> {
        let nothing = H::Tensor::<S>::filled(S::zero());
        let mut stress = nothing;
        for (slope, &force) in slopes.iter().zip(force) {
            add(&mut stress, share * force, slope);
        }
        let mut moduli = [[[[S::zero(); D]; D]; D]; D];
        for l in 0..D {
            let mut direction = [S::zero(); D];
            direction[l] = S::one();
            let turned = stress.applied(&direction);
            for (b, row) in new.iter().enumerate() {
                let strain = H::Tensor::<S>::symmetrised(row, &direction);
                let mut change = nothing;
                for ((measure, slope), &force) in self.measures.iter().zip(slopes).zip(force) {
                    let own = between.change_of_slope(measure, slope, &strain);
                    add(&mut change, force, &own);
                }
                for (a, row) in tensor.iter().enumerate() {
                    let stretched = change.applied(row);
                    for m in 0..D {
                        let turned = if a == b { turned[m] } else { S::zero() };
                        moduli[a][m][b][l] = stretched[m] + turned;
                    }
                }
            }
        }
        moduli
    }

    /// `W : 𝔸`, where F takes half of the change of the new deformation.
    #[cfg(feature = "gradients")]
    pub(super) fn pulled_stiffness(
        &self,
        [tensor, new]: [&Tensor<S, D>; 2],
        between: &Strains<H, S, D>,
        force: &[S; N],
        w: &Tensor<S, D>,
    ) -> Tensor<S, D> {
        let slopes = self
            .measures
            .each_ref()
            .map(|measure| between.slope(measure));
        let nothing = H::Tensor::<S>::filled(S::zero());
        let mut stress = nothing;
        for (slope, &force) in slopes.iter().zip(force) {
            add(&mut stress, S::from_f64(0.5) * force, slope);
        }
        let along = strain_along::<H::Tensor<S>, S, D>(tensor, w);
        let mut pulled = w.map(|row| stress.applied(&row));
        for l in 0..D {
            let mut direction = [S::zero(); D];
            direction[l] = S::one();
            for (b, row) in new.iter().enumerate() {
                let strain = H::Tensor::<S>::symmetrised(row, &direction);
                for ((measure, slope), &force) in self.measures.iter().zip(&slopes).zip(force) {
                    let own = between.change_of_slope(measure, slope, &strain);
                    pulled[b][l] += force * own.contracted(&along);
                }
            }
        }
        pulled
    }

    /// `𝔸_m·B_j` of all arms j, for each m.
    #[inline]
    fn changes(&self, moduli: &[Tensor<S, D>; D]) -> [PerArm<H, S, D>; D] {
        array::from_fn(|m| {
            let mut change = self.gradients;
            for b in change.as_mut() {
                *b = pushed(&moduli[m], b);
            }
            change
        })
    }
}

/// The symmetric part of `FᵀW`.
#[cfg(feature = "gradients")]
#[inline]
pub(super) fn strain_along<A: Symmetric<S, D>, S: Real, const D: usize>(
    tensor: &Tensor<S, D>,
    w: &Tensor<S, D>,
) -> A {
    let mut along = A::filled(S::zero());
    for (row, w) in tensor.iter().zip(w) {
        add(&mut along, S::one(), &A::symmetrised(row, w));
    }
    along
}

/// `Σ_m b_m rows_m`.
#[inline]
fn combined<H: Shape<D>, S: Real, const D: usize>(
    b: &[S; D],
    rows: &[PerArm<H, S, D>; D],
) -> PerArm<H, S, D> {
    let mut sum = rows[0];
    let rows = rows.each_ref().map(|row| row.as_ref().as_flattened());
    for (at, sum) in sum.as_mut().as_flattened_mut().iter_mut().enumerate() {
        *sum = dot(b, &array::from_fn(|m| rows[m][at]));
    }
    sum
}

/// `sum += factor arms`.
#[inline]
fn add_scaled<H: Shape<D>, S: Real, const D: usize>(
    sum: &mut PerArm<H, S, D>,
    factor: S,
    arms: &PerArm<H, S, D>,
) {
    let entries = arms.as_ref().as_flattened();
    for (sum, &entry) in sum.as_mut().as_flattened_mut().iter_mut().zip(entries) {
        *sum += factor * entry;
    }
}

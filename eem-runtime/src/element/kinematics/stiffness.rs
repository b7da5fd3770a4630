//! The tangent at a point of a solid.
//!
//! ```text
//! force_i = F S B_i,   S = Σ_n f_n P_n
//! K_ij    = B_i·(𝔸·B_j + Σ_n F P_n ⊗ ∂f_n/∂r_j),     𝔸 = ∂(F S)/∂F¹ at constant f
//! ```
//!
//! 𝔸 is computed once per point, and multiplied with all arms at once, in loops of fixed length that the compiler
//! vectorises.

use crate::algebra::vector;
use crate::element::kinematics::solid::{PerArm, PerPair, SolidPoint, Strains};
use eem_material::free_energy::Array;
use eem_mesh::Shape;
use eem_mesh::tensor::{Symmetric, Tensor, add, dot, pushed};

/// `∂(F S)_am/∂F_bl`, in the order of the indices a, m, b, l.
type Moduli<const D: usize> = [[Tensor<D>; D]; D];

impl<H: Shape<D>, const N: usize, const D: usize> SolidPoint<H, N, D> {
    /// Adds the derivative of `F S B_i` with respect to the new deformation, of whose change F takes the fraction `share`.
    /// The derivatives of the forces with respect to the arms are included if they are given.
    pub(super) fn add_stiffness(
        &self,
        [tensor, new]: [&Tensor<D>; 2],
        between: &Strains<H, D>,
        (force, force_by_arm): (&[f64; N], &[PerArm<H, D>]),
        share: f64,
        sum: &mut PerPair<H, D>,
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
                    add_scaled::<H, D>(change, along, by_arm);
                }
            }
            for (b, blocks) in self.gradients.as_ref().iter().zip(sum.as_mut()) {
                let entries = combined::<H, D>(b, &changes);
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
        [tensor, new]: [&Tensor<D>; 2],
        between: &Strains<H, D>,
        (force, slopes): (&[f64; N], &[H::Tensor; N]),
        share: f64,
    ) -> Moduli<D> {
        let nothing = H::Tensor::filled(0.0);
        let mut stress = nothing;
        for (slope, &force) in slopes.iter().zip(force) {
            add(&mut stress, share * force, slope);
        }
        let mut moduli = [[[[0.0; D]; D]; D]; D];
        for l in 0..D {
            let mut direction = [0.0; D];
            direction[l] = 1.0;
            let turned = stress.applied(&direction);
            for (b, row) in new.iter().enumerate() {
                let strain = H::Tensor::symmetrised(row, &direction);
                let mut change = nothing;
                for ((measure, slope), &force) in self.measures.iter().zip(slopes).zip(force) {
                    let own = between.change_of_slope(measure, slope, &strain);
                    add(&mut change, force, &own);
                }
                for (a, row) in tensor.iter().enumerate() {
                    let stretched = change.applied(row);
                    for m in 0..D {
                        let turned = if a == b { turned[m] } else { 0.0 };
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
        [tensor, new]: [&Tensor<D>; 2],
        between: &Strains<H, D>,
        force: &[f64; N],
        w: &Tensor<D>,
    ) -> Tensor<D> {
        let slopes = self
            .measures
            .each_ref()
            .map(|measure| between.slope(measure));
        let nothing = H::Tensor::filled(0.0);
        let mut stress = nothing;
        for (slope, &force) in slopes.iter().zip(force) {
            add(&mut stress, 0.5 * force, slope);
        }
        let along = strain_along::<H::Tensor, D>(tensor, w);
        let mut pulled = w.map(|row| stress.applied(&row));
        for l in 0..D {
            let mut direction = [0.0; D];
            direction[l] = 1.0;
            for (b, row) in new.iter().enumerate() {
                let strain = H::Tensor::symmetrised(row, &direction);
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
    fn changes(&self, moduli: &[Tensor<D>; D]) -> [PerArm<H, D>; D] {
        core::array::from_fn(|m| {
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
pub(super) fn strain_along<A: Symmetric<D>, const D: usize>(
    tensor: &Tensor<D>,
    w: &Tensor<D>,
) -> A {
    let mut along = A::filled(0.0);
    for (row, w) in tensor.iter().zip(w) {
        add(&mut along, 1.0, &A::symmetrised(row, w));
    }
    along
}

/// `Σ_m b_m rows_m`.
#[inline]
fn combined<H: Shape<D>, const D: usize>(b: &[f64; D], rows: &[PerArm<H, D>; D]) -> PerArm<H, D> {
    let mut sum = rows[0];
    let rows = rows.each_ref().map(|row| row.as_ref().as_flattened());
    for (at, sum) in sum.as_mut().as_flattened_mut().iter_mut().enumerate() {
        *sum = dot(b, &vector(|m| rows[m][at]));
    }
    sum
}

/// `sum += factor arms`.
#[inline]
fn add_scaled<H: Shape<D>, const D: usize>(
    sum: &mut PerArm<H, D>,
    factor: f64,
    arms: &PerArm<H, D>,
) {
    let entries = arms.as_ref().as_flattened();
    for (sum, &entry) in sum.as_mut().as_flattened_mut().iter_mut().zip(entries) {
        *sum += factor * entry;
    }
}

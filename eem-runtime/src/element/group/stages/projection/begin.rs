//! Where the path of a point through a step begins.

use core::ops::Range;

use super::Projections;
use super::derivatives::derivatives;
use super::vector::{Matrix, Vector};
use crate::element::group::stages::member::StatePoint;
use crate::element::kinematics::{Arms, QuadraticStrain};
use crate::element::tableau::{MOST_POINTS, MOST_STAGES};
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> Projections<S, M, K, D> {
    /// Takes y⁰ from the old variables and arms; all increments are zero.
    pub(super) fn begin_path(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
        x0: &M::Variables,
        r0: &Arms<K, S, D>,
    ) {
        let (kinematics, last) = (&self.point.kinematics, M::Variables::LEN - 1);
        let (gradient, hessian) = in_state.model.hessian(x0);
        self.old_form = in_state.model.temperature_form_old(x0);
        (self.old.rest, self.old.strain) = (*x0, kinematics.strain(r0));
        let strain = &self.old.strain;
        let (slopes, curvatures) = derivatives(kinematics, strain, (x0, &gradient, &hessian));
        self.end_slopes[0] = slopes;
        self.end_sizes[0] = kinematics.strain_sizes(strain);
        let strains = 0..Vector::<S, M, K, D>::STRAINS;
        let (counts, unit) = kinematics.strain_metric(strain);
        let derivatives = (&slopes, &curvatures);
        let of_strain = steepness(derivatives, strains.clone(), |q| counts[q], unit);
        for q in strains.clone() {
            self.metric[q] = counts[q] * of_strain;
        }
        let entropy = Vector::<S, M, K, D>::ENTROPY;
        let components = entropy - M::VISCOUS_STRAIN..entropy;
        for index in strains.end..components.start {
            let unit = self.point.viscous_unit;
            self.units[index] = unit;
            self.metric[index] = steepness(derivatives, index..index + 1, |_| S::one(), unit);
        }
        // Components of a tensor count alike, whatever the axes are.
        let of_components = steepness(derivatives, components.clone(), |_| S::one(), S::one());
        for index in components {
            self.units[index] = self.point.viscous_unit;
            self.metric[index] = of_components;
        }
        if M::THERMAL {
            let theta = x0[last];
            self.old[entropy] = self.point.entropy;
            self.units[entropy] = -theta * hessian[last][last];
            self.metric[entropy] = curvatures[[entropy, entropy]];
            self.temperatures = [theta; MOST_POINTS + 1];
        }
        self.rates = [Vector::zero(); MOST_STAGES];
    }
}

/// A number of the magnitude of the second derivatives by some variables, each of which counts so many times, and of the
/// first ones over their unit: the energy is flat in a metric of it only where all derivatives vanish.
fn steepness<S: Real, M: FreeEnergy<S>, K: QuadraticStrain<S, D>, const D: usize>(
    (slopes, curvatures): (&Vector<S, M, K, D>, &Matrix<S, M, K, D>),
    variables: Range<usize>,
    counts: impl Fn(usize) -> S,
    unit: S,
) -> S {
    let (mut curvature, mut slope) = (S::zero(), S::zero());
    for row in variables.clone() {
        slope = slope.hypot(slopes[row] / counts(row).sqrt());
        for column in variables.clone() {
            let counted = (counts(row) * counts(column)).sqrt();
            curvature = curvature.hypot(curvatures[[row, column]] / counted);
        }
    }
    curvature + slope / unit
}

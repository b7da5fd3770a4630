//! Where the path of a point through a step begins.

use core::ops::Range;

use super::ProjectedPoint;
use super::derivatives::derivatives;
use super::vector::{Matrix, Vector};
use crate::element::group::point::variables;
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::StepView;
use crate::element::kinematics::{Arms, QuadraticStrain};
use crate::element::tableau::{MOST_POINTS, MOST_STAGES};
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> ProjectedPoint<S, M, K, D> {
    /// Takes y⁰ from the old state, where all increments are zero.
    pub(super) fn begin_path(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
        view: &StepView<'_, S>,
        r0: &Arms<K, S, D>,
    ) {
        let measures = self.kinematics.measure(r0);
        let x0 = variables::<S, M>(measures.as_ref(), in_state.slots(), view.state);
        let (gradient, hessian) = in_state.model.hessian(&x0);
        let (own, last) = (&mut self.own, M::Variables::LEN - 1);
        own.old_form = in_state.model.temperature_form_old(&x0);
        own.old.take_rest(&x0);
        own.old.strain = self.kinematics.strain(r0);
        let of_model = (&x0, &gradient, &hessian);
        let (slopes, curvatures) =
            derivatives::<S, M, K, D>(&self.kinematics, &own.old.strain, of_model);
        own.end_slopes[0] = slopes;
        own.end_sizes[0] = self.kinematics.strain_sizes(&own.old.strain);
        let strains = 0..Vector::<S, M, K, D>::STRAINS;
        let (counts, unit) = self.kinematics.strain_metric(&own.old.strain);
        let derivatives = (&slopes, &curvatures);
        let of_strain = steepness(derivatives, strains.clone(), |q| counts[q], unit);
        for q in strains {
            own.metric[q] = counts[q] * of_strain;
        }
        let mut dashpots = Vector::<S, M, K, D>::dashpots();
        let components = dashpots.end - M::VISCOUS_STRAIN..dashpots.end;
        dashpots.end = components.start;
        for index in dashpots.clone().chain(components.clone()) {
            own.units[index] = self.viscous_unit;
        }
        // Components of a tensor count alike, whatever the axes are.
        let of_components = steepness(derivatives, components.clone(), |_| S::one(), S::one());
        for index in components {
            own.metric[index] = of_components;
        }
        for index in dashpots {
            let own_range = index..index + 1;
            own.metric[index] = steepness(derivatives, own_range, |_| S::one(), self.viscous_unit);
        }
        if M::THERMAL {
            let (entropy, theta) = (Vector::<S, M, K, D>::ENTROPY, x0[last]);
            own.old[entropy] = self.entropy;
            own.units[entropy] = -theta * hessian[last][last];
            own.metric[entropy] = curvatures[[entropy, entropy]];
            own.temperatures = [theta; MOST_POINTS + 1];
        }
        own.rates = [Vector::zero(); MOST_STAGES];
    }
}

/// A number of the magnitude of the second derivatives by some variables, each of which counts so many times, and of the
/// first ones over the unit of these: the energy is flat in a metric of it only where all derivatives vanish.
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

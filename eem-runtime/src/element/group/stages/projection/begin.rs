//! Where the path of a spring through a step begins.

use super::ProjectedMember;
use super::path::derivatives;
use crate::element::group::arms::dot;
use crate::element::group::element_group::variables;
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::StepView;
use crate::element::kinematics::Kinematics;
use crate::element::tableau::{MOST_POINTS, MOST_STAGES};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

impl<S, M, K, const D: usize> ProjectedMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Takes y⁰ from the old state, where all increments are zero.
    pub(super) fn begin_path(&mut self, point: &StatePoint<S, M, K, D>, view: &StepView<'_, S>) {
        let measures = self.kinematics.measure(&self.r0);
        let x0 = variables::<S, M>(measures.as_ref(), point.slots(), view.state);
        let (gradient, hessian) = point.model.hessian(&x0);
        let (own, last) = (&mut self.own, M::Variables::LEN - 1);
        own.old_form = point.model.temperature_form_old(&x0);
        own.old_stretch = x0[0];
        own.old = x0;
        own.old[0] = dot(&self.r0.as_ref()[0], &self.r0.as_ref()[0]);
        own.units = M::Variables::filled(self.length);
        own.units[0] = own.old[0];
        let (slopes, curvatures) = derivatives::<S, M>(&x0, &gradient, &hessian);
        own.end_slopes[0] = slopes;
        for index in 0..=last {
            // The energy is nowhere flat in this metric unless its derivative vanishes, too.
            let slope = slopes[index].abs() / own.units[index];
            own.metric[index] = curvatures[index][index].abs() + slope;
        }
        if M::THERMAL {
            let theta = x0[last];
            own.old[last] = self.entropy;
            own.units[last] = -theta * hessian[last][last];
            own.metric[last] = curvatures[last][last];
            own.temperatures = [theta; MOST_POINTS + 1];
        }
        own.rates = [M::Variables::filled(S::zero()); MOST_STAGES];
    }
}

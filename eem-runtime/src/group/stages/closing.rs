//! The end of a step: forces and increments of the internal variables from the found stages.
//!
//! Newton's method leaves an error in the trial stages. Taking `f`, `g`, `θ` of the stages as given
//! and evaluating the remaining relations explicitly from them makes the balances of momentum and
//! entropy hold to rounding whatever that error is.

use super::member::StageMember;
use super::point::Point;
use super::{END, MIDDLE, StageTrial, StageView, ThreeStageGroup};
use crate::conduction::Partner;
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::group::arms::{arms, measures_in, points, resultant};
use crate::group::closing::pull;
use crate::kinematics::{Kinematics, Weights};
use crate::layout::Slots;
use crate::scalar::Real;
use crate::scheme::variational_4;
use crate::state::State;
use crate::system::LinearSystem;

impl<S, M, K, const D: usize> ThreeStageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// See [`StageGroup::add_secant`](super::StageGroup::add_secant).
    pub(super) fn add_secant_all(
        &mut self,
        view: &StageView<'_, S>,
        trial: &StageTrial<S, D>,
        system: &mut LinearSystem<S, D>,
    ) {
        let impulse = view.step * S::from_f64(variational_4::MIDDLE_AND_END[0][MIDDLE]);
        let old = points(view.state.positions.values());
        let (values, right) = system.parts();
        for stages in &self.members {
            let weights = stages.secant(self.elements.kinematics);
            let (site, secant) = (stages.site.common(), &stages.site.secant);
            let mut known = arms::<K, S, D>(&site.nodes, old);
            site.add_anchors(&mut known, &trial.displacements[0], S::one());
            secant.add_matrix(&site.is_mass, &weights, impulse, values);
            site.subtract_known(&weights, (&known, impulse), right);
        }
    }

    /// See [`StageGroup::subtract_forces`](super::StageGroup::subtract_forces).
    pub(super) fn subtract_all_forces(
        &mut self,
        stage: usize,
        trial: &StageTrial<S, D>,
        forces: &mut [[S; D]],
    ) {
        let kinematics = self.elements.kinematics;
        for stages in &self.members {
            let nodes = &stages.site.common().nodes;
            let r = arms::<K, S, D>(nodes, &trial.positions[stage]);
            let force = if stage == MIDDLE {
                pull::<K, S, D>(&stages.secant(kinematics), &r)
            } else {
                let gradient = kinematics.gradient(&r, &kinematics.measure(&r));
                let found = measures_in::<K, S, D>(&stages.points[stage].gradient);
                resultant::<K, S, D>(&gradient, &found)
            };
            for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                for (sum, &force) in forces[node as usize].iter_mut().zip(force) {
                    *sum -= force;
                }
            }
        }
    }

    /// See [`StageGroup::close`](super::StageGroup::close).
    pub(super) fn close_all(
        &mut self,
        view: &StageView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StateError> {
        let (kinematics, at_end) = (self.elements.kinematics, view.at_end());
        for (member, stages) in self.elements.members.iter_mut().zip(&mut self.members) {
            stages.close(member.slots(), view, next);
            let near = stages.x[END][M::Variables::LEN - 1];
            if let Some(entropy) = member.settle(kinematics, &at_end, near, next)? {
                stages.book_thermostat(view.step, entropy, next);
            }
        }
        Ok(())
    }
}

impl<S, M, K, const D: usize> StageMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// A of the nodal force `A q_m` of the found middle.
    fn secant(&self, kinematics: K) -> Weights<K, S, D> {
        let measures = measures_in::<K, S, D>(&self.x[MIDDLE]);
        let forces = measures_in::<K, S, D>(&self.points[MIDDLE].gradient);
        kinematics.secant(&measures, &measures, &forces)
    }

    /// The increments of the internal variables and of the reservoirs' entropies.
    fn close(&mut self, slots: Slots, view: &StageView<'_, S>, next: &mut State<S>) {
        let weights = variational_4::STEP.map(|weight| view.step * S::from_f64(weight));
        let (points, old) = (&self.points, view.state);
        let step = |of: &dyn Fn(usize) -> S| {
            let terms = weights.iter().enumerate();
            terms.fold(S::zero(), |sum, (stage, &weight)| sum + weight * of(stage))
        };
        for k in 0..M::DASHPOTS {
            let creep = step(&|stage| points[stage].rates[M::MEASURES + k]);
            next.viscous.advance(slots.viscous + k, &old.viscous, creep);
        }
        let Some(slot) = slots.thermal else {
            next.dissipated
                .add(step(&|stage| points[stage].dissipation));
            return;
        };
        let last = M::Variables::LEN - 1;
        let received = step(&|stage| points[stage].rates[last]);
        next.entropies.advance(slot, &old.entropies, received);
        for link in view.conduction.links(slot) {
            if let Partner::Reservoir(index) = link.partner {
                let theta = view.conduction.reservoirs[index];
                let flow =
                    |stage: usize| link.conductance * (self.temperature(stage) - theta) / theta;
                next.reservoir_entropies.add(index, step(&flow));
            }
        }
        self.entropy_received = received;
    }

    /// The heat of the thermostat of an element whose new entropy is given.
    ///
    /// The entropies `(h/6)R_0`, `(2h/3)R_m`, `(h/6)R_1` that it gives at the stages are what the equations of the
    /// scheme lack with the prescribed temperatures, and its heat is `Σ θ_i` times them.
    fn book_thermostat(&self, h: S, new_entropy: S, next: &mut State<S>) {
        let last = M::Variables::LEN - 1;
        let [start, middle, end] = self.points.each_ref().map(Point::entropy);
        let received = |stage: usize| {
            let rate = self.points[stage].rates[last];
            h * S::from_f64(variational_4::STEP[stage]) * rate
        };
        let [w0, wm, w1] = variational_4::START.map(S::from_f64);
        let at_start = w0 * start + wm * middle + w1 * end - self.entropy - received(0);
        let share = S::from_f64(variational_4::STEP[MIDDLE]);
        let in_middle = share * (end - start) - received(MIDDLE);
        let total = new_entropy - self.entropy - self.entropy_received;
        let at_end = total - at_start - in_middle;
        let given = [at_start, in_middle, at_end];
        for (stage, given) in given.into_iter().enumerate() {
            next.heat.add(self.temperature(stage) * given);
        }
        next.thermostat_entropy.add(-total);
    }
}

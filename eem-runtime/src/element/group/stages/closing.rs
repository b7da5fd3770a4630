//! The end of a step: forces and increments of the internal variables from the found stages.
//!
//! Newton's method leaves an error in the trial stages. Taking `f`, `g`, `θ` of the stages as given
//! and evaluating the remaining relations explicitly from them makes the balances of momentum and
//! entropy hold to rounding whatever that error is.

use super::member::StageMember;
use crate::algebra::system::LinearSystem;
use crate::element::conduction::Partner;
use crate::element::error::StateError;
use crate::element::group::arms::{arms_in, measures_in, resultant};
use crate::element::group::closing::pull;
use crate::element::group::stages::stage_group::StageGroup;
use crate::element::group::view::{StepView, Trial};
use crate::element::impulse::Impulses;
use crate::element::kinematics::{Ends, Kinematics, Weights};
use crate::element::layout::Slots;
use crate::element::state::State;
use crate::element::tableau::{Ending, Tableau};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

impl<S, M, K, const D: usize> StageGroup<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// See [`Group::add_secant`](crate::element::group::Group::add_secant).
    pub(super) fn add_secant_all(
        &mut self,
        set: usize,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        system: &mut LinearSystem<S, D>,
    ) {
        let rule = self.rule;
        let stage = rule.stage_of(set);
        let impulse = view.step * S::from_f64(rule.positions[set][stage]);
        let (values, right) = system.parts();
        for stages in &self.members {
            let weights = stages.secant(stage);
            let (site, secant) = (stages.site.common(), &stages.site.secant);
            let mut known = arms_in::<K, S, D>(&site.nodes, &view.state.positions);
            site.add_anchors(&mut known, trial.displacements_of_set(set), S::one());
            secant.add_matrix(&site.is_mass, &weights, impulse, values);
            site.subtract_known(&weights, (&known, impulse), right);
        }
    }

    /// Subtracts the nodal impulses of a step of the forces of a stage: their magnitudes as found, their
    /// directions from the trial.
    pub(super) fn add_impulse_of(
        &self,
        stage: usize,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        impulses: &mut Impulses<'_, S, D>,
    ) {
        let rule = self.rule;
        let feels_itself = rule
            .set_of(stage)
            .is_some_and(|set| rule.positions[set][stage] != 0.0);
        for stages in &self.members {
            let r = stages.arms_at(rule, stage, trial);
            let force = if feels_itself && matches!(rule.ending, Ending::StageByStage) {
                pull::<K, S, D>(&stages.secant(stage), &r)
            } else {
                let kinematics = stages.kinematics;
                let gradient = kinematics.gradient(&r, &kinematics.measure(&r));
                let found = measures_in::<K, S, D>(&stages.points[stage].gradient);
                resultant::<K, S, D>(&gradient, &found)
            };
            let nodes = &stages.site.common().nodes;
            for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                for (sum, &force) in impulses.of(node as usize).iter_mut().zip(force) {
                    *sum -= view.step * force;
                }
            }
        }
    }

    /// Increments of the internal variables and of the reservoirs, and the temperatures of the new state.
    pub(super) fn close_all(
        &mut self,
        view: &StepView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StateError> {
        let rule = self.rule;
        for (member, stages) in self.elements.members.iter_mut().zip(&mut self.members) {
            let r1 = member.arms_in(next);
            let point = member.only_mut();
            stages.close(rule, point.slots(), view, next);
            let near = stages.temperature(rule.stages() - 1);
            if let Some(entropy) = point.settle(&r1, view, near, next)? {
                stages.book_thermostat(rule, view.step, entropy, next);
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
    /// A of the nodal force `A q_i` of the found stage.
    fn secant(&self, stage: usize) -> Weights<K, S, D> {
        let measures = measures_in::<K, S, D>(&self.x[stage]);
        let forces = measures_in::<K, S, D>(&self.points[stage].gradient);
        // At rest in the stage; the arms of an element with one point are not asked for.
        let ends = Ends {
            r0: self.r0,
            r1: self.r0,
            measures0: measures,
            measures1: measures,
        };
        self.kinematics.secant(&ends, &forces)
    }

    /// The increments of the internal variables and of the reservoirs' entropies.
    fn close(&mut self, rule: &Tableau, slots: Slots, view: &StepView<'_, S>, next: &mut State<S>) {
        let (points, old) = (&self.points, view.state);
        let step = |of: &dyn Fn(usize) -> S| {
            let terms = rule.weights.iter().enumerate();
            terms.fold(S::zero(), |sum, (stage, &weight)| {
                sum + view.step * S::from_f64(weight) * of(stage)
            })
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

    /// The heat of the thermostat of an element whose new entropy is given: the entropies that it gives at
    /// the stages are what the equations of the rule lack with the prescribed temperatures; what is left of
    /// the total it gives at the last stage.
    fn book_thermostat(&self, rule: &Tableau, h: S, new_entropy: S, next: &mut State<S>) {
        let last = M::Variables::LEN - 1;
        let total = new_entropy - self.entropy - self.entropy_received;
        let mut rest = total;
        for balance in rule.entropies {
            let mut lacking = -S::from_f64(balance.old) * self.entropy;
            let terms = balance.entropies.iter().zip(balance.rates).enumerate();
            for (stage, (&entropy, &rate)) in terms {
                lacking += S::from_f64(entropy) * self.points[stage].entropy();
                lacking -= h * S::from_f64(rate) * self.points[stage].rates[last];
            }
            for (stage, &supply) in balance.supply.iter().enumerate() {
                let given = S::from_f64(supply) * lacking;
                next.heat.add(self.temperature(stage) * given);
                rest -= given;
            }
        }
        next.heat.add(self.temperature(rule.stages() - 1) * rest);
        next.thermostat_entropy.add(-total);
    }
}

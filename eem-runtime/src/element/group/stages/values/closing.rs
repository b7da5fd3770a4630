//! What is booked of an element with values at the stages.

use super::ValuesPoint;
use crate::element::conduction::Partner;
use crate::element::group::arms::{measures_in, resultant};
use crate::element::group::closing::pull;
use crate::element::group::stages::member::StageArms;
use crate::element::group::view::StepView;
use crate::element::kinematics::{Arms, Ends, Kinematics, Weights};
use crate::element::layout::Slots;
use crate::element::state::State;
use crate::element::tableau::{Ending, Tableau};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> ValuesPoint<S, M, K, D> {
    /// The forces on the nodes at a stage: their magnitudes as found, their directions from the trial.
    pub(super) fn pull(
        &self,
        rule: &Tableau,
        stage: usize,
        arms: &StageArms<K, S, D>,
    ) -> K::PerNode<[S; D]> {
        let feels_itself = rule
            .set_of(stage)
            .is_some_and(|set| rule.positions[set][stage] != 0.0);
        let r = arms.at(rule, stage);
        if feels_itself && matches!(rule.ending, Ending::StageByStage) {
            return pull::<K, S, D>(&self.secant(stage), &r);
        }
        let kinematics = self.kinematics;
        let gradient = kinematics.gradient(&r, &kinematics.measure(&r));
        let found = measures_in::<K, S, D>(&self.own.points[stage].gradient);
        resultant::<K, S, D>(&gradient, &found)
    }

    /// A of the nodal force `A q_i` of the found stage.
    pub(super) fn secant(&self, stage: usize) -> Weights<K, S, D> {
        let measures = measures_in::<K, S, D>(&self.own.x[stage]);
        let forces = measures_in::<K, S, D>(&self.own.points[stage].gradient);
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        // At rest in the stage; the arms of an element with one point are not asked for.
        let ends = Ends::new(&self.kinematics, [nowhere; 2], [measures; 2]);
        self.kinematics.secant(&ends, &forces)
    }

    /// The increments of the internal variables and of the reservoirs' entropies.
    pub(super) fn book(
        &mut self,
        rule: &Tableau,
        slots: Slots,
        view: &StepView<'_, S>,
        next: &mut State<S>,
    ) {
        let (points, old) = (&self.own.points, view.state);
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
        self.own.entropy_received = received;
    }

    /// The heat of the thermostat of an element whose new entropy is given: the entropies that it gives at
    /// the stages are what the equations of the rule lack with the prescribed temperatures; what is left of
    /// the total it gives at the last stage.
    pub(super) fn book_thermostat(
        &self,
        rule: &Tableau,
        h: S,
        new_entropy: S,
        next: &mut State<S>,
    ) {
        let last = M::Variables::LEN - 1;
        let total = new_entropy - self.entropy - self.own.entropy_received;
        let mut rest = total;
        for balance in rule.entropies {
            let mut lacking = -S::from_f64(balance.old) * self.entropy;
            let terms = balance.entropies.iter().zip(balance.rates).enumerate();
            for (stage, (&entropy, &rate)) in terms {
                lacking += S::from_f64(entropy) * self.own.points[stage].entropy();
                lacking -= h * S::from_f64(rate) * self.own.points[stage].rates[last];
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

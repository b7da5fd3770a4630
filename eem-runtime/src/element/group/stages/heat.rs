//! Heat between elements at the stages, as a function of the coupled interface temperatures Θ.
//!
//! ```text
//! Q_i = Σ κ (θ_i,partner − θ_i),   θ_i = Σ_k t_ik Θ_k
//! ```
//!
//! except that a thermostat gives its `θ_i` directly.

use super::member::StagePoint;
use crate::element::conduction::Partner;
use crate::element::group::site::Contact;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::Kinematics;
use crate::element::tableau::Tableau;
use eem_material::number::scalar::Real;

/// Q at a stage of the element with a thermal slot, W.
pub(super) fn received<S: Real, const D: usize>(
    rule: &Tableau,
    stage: usize,
    slot: usize,
    (view, trial): (&StepView<'_, S>, &Trial<S, D>),
) -> S {
    let mut heat = S::zero();
    for link in view.conduction.links(slot) {
        let Partner::Slot(partner) = link.partner else {
            continue;
        };
        let mut drop = excess(rule, stage, partner, view) - excess(rule, stage, slot, view);
        for (set, &share) in rule.temperatures[stage].iter().enumerate() {
            let [near, far] = [slot, partner].map(|slot| trial.seen_of_set(set, slot));
            drop += S::from_f64(share) * trial.seen.drop(near, far);
        }
        heat += link.conductance * drop;
    }
    heat
}

/// The difference of a prescribed temperature at a stage and the combination of interface temperatures there, K.
fn excess<S: Real>(rule: &Tableau, stage: usize, slot: usize, view: &StepView<'_, S>) -> S {
    let Some(prescribed) = view.prescribed_at_stages(slot) else {
        return S::zero();
    };
    let shares = rule.temperatures[stage].iter().zip(rule.entropies);
    shares.fold(prescribed[stage], |rest, (&share, balance)| {
        rest - S::from_f64(share) * prescribed[balance.unknown]
    })
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> StagePoint<K, S, D> {
    /// The change of Q at a stage by a global solution, W.
    pub(super) fn heat_change(&self, stage: usize, solution: &[[S; 1]]) -> S {
        let mut change = S::zero();
        let contacts = self.contacts.iter().flatten().enumerate();
        for (set, contacts) in contacts.take(self.rule.sets()) {
            let share = S::from_f64(self.rule.share(stage, set));
            let near = solution[contacts[set].unknown as usize][0];
            for partner in &contacts[set].partners {
                let far = solution[partner.unknown as usize][0];
                change += share * partner.conductance * (far - near);
            }
        }
        change
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Contact<K, S, D> {
    /// `Σ κ`, W/K.
    pub(super) fn conductance(&self) -> S {
        let partners = self.partners.iter();
        partners.fold(S::zero(), |sum, partner| sum + partner.conductance)
    }
}

//! Heat between elements at the stages, as a function of the temperatures that neighbours see.
//!
//! ```text
//! Q_i = Σ κ (θ_i,partner − θ_i),   θ_i = Σ_k t_ik Θ_k
//! ```
//!
//! except that a thermostat gives its `θ_i` directly.

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
    view: &StepView<'_, S>,
    trial: &Trial<S, D>,
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

/// By how much a prescribed temperature at a stage differs from the combination of those that are seen, K.
fn excess<S: Real>(rule: &Tableau, stage: usize, slot: usize, view: &StepView<'_, S>) -> S {
    let Some(prescribed) = view.prescribed_at_stages(slot) else {
        return S::zero();
    };
    let shares = rule.temperatures[stage].iter().zip(rule.entropies);
    shares.fold(prescribed[stage], |rest, (&share, balance)| {
        rest - S::from_f64(share) * prescribed[balance.unknown]
    })
}

/// `Σ_i factor_i t_ik`, the derivative of `Σ_i factor_i θ_i` by Θ of a set k.
pub(super) fn by_seen<S: Real>(rule: &Tableau, set: usize, factors: &[S]) -> S {
    let terms = factors.iter().enumerate();
    terms.fold(S::zero(), |sum, (stage, &factor)| {
        sum + S::from_f64(rule.share(stage, set)) * factor
    })
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Contact<K, S, D> {
    /// `Σ κ`, W/K.
    pub(super) fn conductance(&self) -> S {
        let partners = self.partners.iter();
        partners.fold(S::zero(), |sum, partner| sum + partner.conductance)
    }
}

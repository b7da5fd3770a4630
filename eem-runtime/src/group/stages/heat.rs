//! Heat between elements at the stages, as a function of the temperatures that neighbours see.
//!
//! ```text
//! Q_0 = Σ κ (Θ_0,partner − Θ_0),   Q_m = Σ κ (Θ_m,partner − Θ_m),   Θ_m = ½(Θ_0 + Θ_1)
//! ```
//!
//! except that a thermostat gives its `Θ_m` directly.

use super::StageView;
use super::member::StageMember;
use crate::conduction::Partner;
use crate::free_energy::FreeEnergy;
use crate::group::site::{Contact, PartnerSite};
use crate::kinematics::Kinematics;
use crate::scalar::Real;

/// The derivatives of `start Q_0 + middle Q_m` by the seen temperatures of one half of the unknowns,
/// 0 or 1: by the element's own, and by that of each partner.
pub(super) fn slopes<'a, K: Kinematics<S, D>, S: Real, const D: usize>(
    view: &'a StageView<'_, S>,
    slot: usize,
    contact: &'a Contact<K, S, D>,
    half: usize,
    [start, middle]: [S; 2],
) -> (S, impl Iterator<Item = (S, &'a PartnerSite<K, S, D>)>) {
    let by = move |slot: usize| {
        let mean = mean_share(view, slot) * middle;
        if half == 0 { start + mean } else { mean }
    };
    let all = contact.partners.iter();
    let own = all.fold(S::zero(), |sum, site| sum - site.conductance * by(slot));
    let partners = partners(view, slot).zip(&contact.partners);
    (
        own,
        partners.map(move |(partner, site)| (site.conductance * by(partner), site)),
    )
}

impl<S, M, K, const D: usize> StageMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// The changes of `Q_0` and `Q_m`, W, that a solution means.
    pub(super) fn heat_change(
        &self,
        view: &StageView<'_, S>,
        slot: Option<usize>,
        solution: &[[S; 1]],
    ) -> [S; 2] {
        let (mut start, mut middle) = (S::zero(), S::zero());
        let (Some(slot), Some([[at_start, _], [at_end, _]])) = (slot, &self.site.contacts) else {
            return [start, middle];
        };
        let change = |slot: usize, rows: [u32; 2]| {
            let [start, end] = rows.map(|row| solution[row as usize][0]);
            [start, mean_share(view, slot) * (start + end)]
        };
        let near = change(slot, [at_start.unknown, at_end.unknown]);
        let sites = at_start.partners.iter().zip(&at_end.partners);
        for (partner, (at_start, at_end)) in partners(view, slot).zip(sites) {
            let far = change(partner, [at_start.unknown, at_end.unknown]);
            start += at_start.conductance * (far[0] - near[0]);
            middle += at_start.conductance * (far[1] - near[1]);
        }
        [start, middle]
    }
}

/// The thermal slots of the elements to which one conducts heat.
fn partners<'a, S: Real>(
    view: &'a StageView<'_, S>,
    slot: usize,
) -> impl Iterator<Item = usize> + 'a {
    let links = view.conduction.links(slot).iter();
    links.filter_map(|link| match link.partner {
        Partner::Slot(partner) => Some(partner),
        Partner::Reservoir(_) => None,
    })
}

/// The share of `Θ_0` and of `Θ_1` in `Θ_m`, which a thermostat gives directly.
fn mean_share<S: Real>(view: &StageView<'_, S>, slot: usize) -> S {
    match view.prescribed(slot) {
        None => S::from_f64(0.5),
        Some(_) => S::zero(),
    }
}

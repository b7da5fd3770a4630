//! Flows of heat between elements, reservoirs and thermostats, booked once for implicit schemes of any number of stages.
//!
//! Both ends of a path book the same exchange `u`, and one of them the production `P ≥ 0`, see
//! [`conduction`](super::conduction).

use super::conduction::{Conduction, Exchange, HeatFlow, Partner};
use super::state::State;
use super::tally::Tally;

/// The sums to which the flows of a step are added.
pub(crate) struct Balances<'a> {
    pub(crate) next: &'a mut State,
    pub(crate) tally: &'a mut Tally,
}

/// Heat and entropy that an element has received during a step or a stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Received {
    /// Entropy, J/K.
    pub(crate) entropy: f64,
    /// The magnitude of its terms, J/K: exchange and production of a path cancel where the element is much warmer than
    /// its partner.
    pub(crate) terms: f64,
    /// Heat of its dashpots and of paths to other elements, J.
    pub(crate) heat: f64,
}

impl Received {
    /// Nothing yet.
    #[inline]
    pub(crate) fn none() -> Self {
        Self {
            entropy: 0.0,
            terms: 0.0,
            heat: 0.0,
        }
    }

    /// Adds a term of the entropy, J/K.
    #[inline]
    pub(crate) fn add(&mut self, entropy: f64) {
        self.entropy += entropy;
        self.terms += entropy.abs();
    }
}

impl Balances<'_> {
    /// Books a path between two elements at the end with the first of these slots, where it has this link. Both ends book
    /// the same exchange; only the end with the larger slot books the production, after the exchange.
    #[inline]
    pub(crate) fn conduct(
        &mut self,
        [slot, other]: [usize; 2],
        (link, path): (u32, &Exchange),
        received: &mut Received,
    ) {
        self.next.entropies.add(slot, path.entropy);
        received.add(path.entropy);
        received.heat += path.heat;
        if slot > other {
            self.produce(slot, path, received);
        }
        if self.next.meters.are_on {
            let meters = &mut self.next.meters;
            meters.see_path([slot, other], link as usize, path);
        }
    }

    /// Books the paths of a slot to reservoirs during the time `share`, s, with the temperature of the element and the
    /// [correction](reservoir_correction) of its differences to theirs, K.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 0.5 % of a step of a spring"
    )]
    #[inline(always)]
    pub(crate) fn exchange_with_reservoirs(
        &mut self,
        conduction: &Conduction,
        slot: usize,
        (share, [theta, correction]): (f64, [f64; 2]),
        received: &mut Received,
    ) {
        for (place, link) in conduction.links(slot).iter().enumerate() {
            let Partner::Reservoir(index) = link.partner else {
                continue;
            };
            let theta_r = conduction.reservoirs[index];
            let drop = (theta_r - theta) + correction;
            let path = Exchange::from_reservoir(share * link.conductance, drop, theta_r);
            self.next.reservoir_entropies.add(index, -path.entropy);
            self.next.entropies.add(slot, path.entropy);
            received.add(path.entropy);
            self.produce(slot, &path, received);
            if self.next.meters.are_on {
                let link = conduction.first_link(slot) + place;
                self.next.meters.see_path_outside(slot, link, &path);
            }
        }
    }

    /// Books the production of a path at this end.
    #[inline]
    fn produce(&mut self, slot: usize, path: &Exchange, received: &mut Received) {
        let production = path.production();
        self.next.entropies.add(slot, production);
        received.add(production);
        self.tally.produce(production);
        self.tally.turn_over(path.heat);
    }
}

impl State {
    /// Books heat and entropy that a thermostat gives, J and J/K.
    #[inline]
    pub(crate) fn book_thermostat(&mut self, heat: f64, entropy: f64) {
        self.heat.add(heat);
        self.thermostat_entropy.add(-entropy);
    }
}

/// Correction of the differences `θ_r − θ*` with which the conducted heat is that of the entropy change of an element, K.
///
/// ```text
/// Σ h κ (θ_r − θ* + correction) = θ* Δs − heat
/// ```
///
/// with the heat conducted in the time h, the heat taken, θ* Δs, and the heat received otherwise, J. Rounding of θ*
/// changes the left-hand side by `hκ ε θ`, and the right-hand side by `ε (stored + |θ* Δs| + |heat|)`, where `stored` is cθ
/// if Δs is the difference at two temperatures, each of which is rounded, else zero. The heat is computed from the side that
/// rounding changes less.
///
/// The entropy `u + P` that the element books is `Q/(θ* − correction)`, so that a correction changes the
/// energy by `Q correction/θ*`. Where a correction is made, it is a few roundings of θ*, and the change of the energy a few
/// roundings of Q.
pub(crate) fn reservoir_correction(
    flow: &HeatFlow,
    [h, theta]: [f64; 2],
    [taken, stored, heat]: [f64; 3],
) -> f64 {
    let conducted = h * flow.conductance;
    let is_stiff = stored + taken.abs() + heat.abs() < conducted * theta;
    let correction = ((taken - heat) - h * flow.heat) / conducted;
    if is_stiff { correction } else { 0.0 }
}

//! What is booked of an element with projected conjugates.
//!
//! ```text
//! γ¹ = γ⁰ + Σ b ν
//! s¹ = s⁰ + Σ b (η ν²/(hΘ) + Σ u + Σ P)
//! ```
//!
//! with the exchange `u` and the production `P ≥ 0` of every path of heat at every stage, see
//! [`conduction`](crate::element::conduction).

use super::ProjectedMember;
use crate::element::conduction::{Exchange, Partner};
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::Kinematics;
use crate::element::state::State;
use crate::element::tableau::{MOST_STAGES, Tableau};
use crate::element::tally::Tally;
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::{Mask, Real};

/// What a step has given to an element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Booked<S> {
    /// Entropy, stage by stage, J/K.
    pub(super) received: [S; MOST_STAGES],
    /// The magnitude of its terms, which cancel where a reservoir is far colder than the element, J/K.
    pub(super) terms: [S; MOST_STAGES],
    /// Heat of its dashpots, and with it that of paths to other elements, J.
    pub(super) heat: [S; MOST_STAGES],
}

impl<S: Real> Booked<S> {
    /// Entropy that an element receives at a stage, J/K.
    fn receive(&mut self, stage: usize, entropy: S) {
        self.received[stage] += entropy;
        self.terms[stage] += entropy.abs();
    }
}

impl<S, M, K, const D: usize> ProjectedMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Books the increments of the internal variables and of the reservoirs' entropies.
    pub(super) fn book(
        &self,
        point: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        (view, trial): (&StepView<'_, S>, &Trial<S, D>),
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Booked<S> {
        let mut booked = self.book_dashpots(point, rule, view, next, tally);
        let Some(slot) = point.slots().thermal else {
            let heat = booked.heat.iter();
            let dissipated = heat.fold(S::zero(), |sum, &heat| sum + heat);
            if M::DASHPOTS > 0 {
                next.dissipated.add(dissipated);
            }
            return booked;
        };
        let received = booked.received.iter();
        let produced = received.fold(S::zero(), |sum, &entropy| sum + entropy);
        next.entropies
            .advance(slot, &view.state.entropies, produced);
        for (stage, &weight) in rule.weights.iter().enumerate() {
            let share = view.step * S::from_f64(weight);
            self.book_paths((stage, share), slot, trial, (next, tally), &mut booked);
            self.book_reservoirs((stage, share), slot, view, (next, tally), &mut booked);
        }
        booked
    }

    /// Books the viscous stretches; what the dashpots give, in J and in J/K.
    fn book_dashpots(
        &self,
        point: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        view: &StepView<'_, S>,
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Booked<S> {
        let zeros = [S::zero(); MOST_STAGES];
        let mut booked = Booked {
            received: zeros,
            terms: zeros,
            heat: zeros,
        };
        let slots = point.slots();
        let creep = self.increments(rule.weights);
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            next.viscous
                .advance(slots.viscous + k, &view.state.viscous, creep[index]);
            for (stage, &weight) in rule.weights.iter().enumerate() {
                let rate = self.own.rates[stage][index];
                let drag = self.own.viscosities[stage].0[k] * view.per_step * rate;
                let heat = S::from_f64(weight) * (drag * rate);
                let entropy = heat / self.temperature_or_one(stage);
                booked.heat[stage] += heat;
                booked.receive(stage, entropy);
                tally.produce(entropy);
                tally.turn_over(heat);
            }
        }
        booked
    }

    /// Books what flows to other elements at a stage, during its share of the step, s.
    fn book_paths(
        &self,
        (stage, share): (usize, S),
        slot: usize,
        trial: &Trial<S, D>,
        (next, tally): (&mut State<S>, &mut Tally<S>),
        booked: &mut Booked<S>,
    ) {
        let Some(contacts) = &self.site.contacts else {
            return;
        };
        for partner in &contacts[stage][stage].partners {
            let other = partner.slot as usize;
            let [own, far] = [slot, other].map(|slot| trial.seen_of_set(stage, slot));
            let path = trial.seen.exchange(share * partner.conductance, own, far);
            next.entropies.add(slot, path.entropy);
            booked.receive(stage, path.entropy);
            booked.heat[stage] += path.heat;
            // The production is booked at one end, after the exchange, which both ends share.
            if slot > other {
                let production = path.production();
                next.entropies.add(slot, production);
                booked.receive(stage, production);
                tally.produce(production);
                tally.turn_over(path.heat);
            }
        }
    }

    /// Books what flows from reservoirs at a stage, during its share of the step, s.
    fn book_reservoirs(
        &self,
        (stage, share): (usize, S),
        slot: usize,
        view: &StepView<'_, S>,
        (next, tally): (&mut State<S>, &mut Tally<S>),
        booked: &mut Booked<S>,
    ) {
        let theta = self.mean_temperature(stage);
        let weight = share * view.per_step;
        let correction = self.reservoir_correction((stage, share), slot, (view, weight), booked);
        for link in view.conduction.links(slot) {
            let Partner::Reservoir(index) = link.partner else {
                continue;
            };
            let theta_r = view.conduction.reservoirs[index];
            let drop = (theta_r - theta) + correction;
            let path = Exchange::from_reservoir(share * link.conductance, drop, theta_r);
            next.reservoir_entropies.add(index, -path.entropy);
            next.entropies.add(slot, path.entropy);
            let production = path.production();
            next.entropies.add(slot, production);
            tally.produce(production);
            tally.turn_over(path.heat);
            booked.receive(stage, path.entropy);
            booked.receive(stage, production);
        }
    }

    /// What the differences `θ_r − Θ` lack for the heat that the entropy of the element has taken, K; see
    /// the same of elements with one set of forces. The unknown here is hṡ, which no temperature rounds, so
    /// that the heat capacity does not matter.
    fn reservoir_correction(
        &self,
        (stage, share): (usize, S),
        slot: usize,
        (view, weight): (&StepView<'_, S>, S),
        booked: &Booked<S>,
    ) -> S {
        let theta = self.mean_temperature(stage);
        let flow = view.conduction.reservoir_flow(slot, theta);
        if self.prescribed.is_some() || flow.conductance.equal(S::zero()).all() {
            return S::zero();
        }
        let conducted = share * flow.conductance;
        let taken = weight * theta * self.own.rates[stage][M::Variables::LEN - 1];
        let heat = booked.heat[stage];
        let is_stiff = (taken.abs() + heat.abs()).less(conducted * theta);
        let correction = ((taken - heat) - share * flow.heat) / conducted;
        S::select(is_stiff, correction, S::zero())
    }

    /// Books the heat of the thermostat of an element whose new entropy is given, stage by stage; what is left
    /// of the entropy by rounding it gives at the last one.
    pub(super) fn book_thermostat(
        &self,
        rule: &Tableau,
        booked: &Booked<S>,
        entropy: S,
        next: &mut State<S>,
    ) {
        let mut total = entropy - self.entropy;
        let mut heat = S::zero();
        let mut rest = total;
        for (stage, &weight) in rule.weights.iter().enumerate() {
            let taken = S::from_f64(weight) * self.own.rates[stage][M::Variables::LEN - 1];
            let received = booked.received[stage];
            heat += self.mean_temperature(stage) * (taken - received);
            rest -= taken;
            total -= received;
        }
        heat += self.mean_temperature(rule.stages() - 1) * rest;
        next.heat.add(heat);
        next.thermostat_entropy.add(-total);
    }

    /// Θ of a stage, K; one without temperature.
    fn temperature_or_one(&self, stage: usize) -> S {
        if M::THERMAL {
            self.mean_temperature(stage)
        } else {
            S::one()
        }
    }
}

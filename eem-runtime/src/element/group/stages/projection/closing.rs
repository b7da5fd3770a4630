//! The end of a step of an element with projected conjugates: balances and certificate.
//!
//! ```text
//! γ¹ = γ⁰ + Σ b ν
//! s¹ = s⁰ + Σ b (η ν²/(hΘ) + Σ u + Σ P)
//! ```
//!
//! with the exchange `u` and the production `P ≥ 0` of every path of heat at every stage, see
//! [`conduction`](crate::element::conduction).

use super::path::PointPath;
use crate::element::balances::{Balances, Received, reservoir_correction};
use crate::element::conjugates::Any;
use crate::element::error::StateError;
use crate::element::group::point::Point;
use crate::element::group::stages::point::Outside;
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasureSet, MeasuresOf, PerStrain, StrainMeasures};
use crate::element::state::State;
use crate::element::tableau::{MOST_POINTS, MOST_STAGES};
use crate::element::tally::{Care, Tally};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

/// Heat and entropy received in a step, stage by stage.
type Booked = [Received; MOST_STAGES];

impl<A: Arrays, G: StrainMeasures> PointPath<A, G> {
    /// Closes the step at the new measures, except for the impulses of its forces.
    pub(super) fn close_at(
        &mut self,
        in_state: &mut Point<A, G::Measures>,
        measures: &MeasuresOf<G>,
        (view, outside): (&StepView<'_>, Outside<'_>),
        (next, tally): (&mut State, &mut Tally),
    ) -> Result<(), StateError> {
        let booked = self.book(in_state, (view, outside), next, tally);
        let near = self.temperatures[MOST_POINTS];
        if let Some(entropy) =
            in_state.recover_temperature::<Any>(measures, view, (near, None), next)?
        {
            self.book_thermostat(&booked, entropy, next);
        }
        let energy = &mut next.energies[in_state.element.index()];
        energy.terms += self.forces_at_end();
        let magnitude = energy.magnitude;
        self.certify(in_state, (view, outside), (&booked, magnitude), tally);
        Ok(())
    }

    /// Books the increments of the internal variables and of the reservoirs' entropies.
    fn book(
        &self,
        in_state: &Point<A, G::Measures>,
        (view, outside): (&StepView<'_>, Outside<'_>),
        next: &mut State,
        tally: &mut Tally,
    ) -> Booked {
        let mut booked = self.book_dashpots(in_state, view, next, tally);
        let sum = |of: fn(&Received) -> f64| {
            let terms = booked.iter().map(of);
            terms.fold(0.0, |sum, term| sum + term)
        };
        let Some(slot) = in_state.slots().thermal else {
            if in_state.dashpots() + in_state.drags() > 0 {
                next.dissipated.add(sum(|received| received.heat));
            }
            return booked;
        };
        let produced = sum(|received| received.entropy);
        let mut balances = Balances { next, tally };
        (balances.next.entropies).advance(slot, &view.state.entropies, produced);
        let weights = self.point.rule.weights.iter();
        for ((stage, &weight), received) in weights.enumerate().zip(&mut booked) {
            let share = view.step * weight;
            self.book_paths((stage, share), slot, outside, &mut balances, received);
            let theta = self.mean_temperature(stage);
            let correction = self.reservoir_correction((stage, share), slot, view, received.heat);
            let share = (share, [theta, correction]);
            balances.exchange_with_reservoirs(view.conduction, slot, share, received);
        }
        booked
    }

    /// Books the viscous stretches; returns heat and entropy of the dashpots.
    fn book_dashpots(
        &self,
        in_state: &Point<A, G::Measures>,
        view: &StepView<'_>,
        next: &mut State,
        tally: &mut Tally,
    ) -> Booked {
        let mut booked = [Received::none(); MOST_STAGES];
        let (weights, slots) = (self.point.rule.weights, in_state.slots());
        let mut dissipate = |stage: usize, heat: f64, (dashpot, next): (usize, &mut State)| {
            let entropy = heat / self.temperature_or_one(stage);
            booked[stage].heat += heat;
            booked[stage].add(entropy);
            tally.produce(entropy);
            tally.turn_over(heat);
            next.meters.dissipate(dashpot, heat);
            if let Some(slot) = slots.thermal {
                next.meters.produce(slot, entropy);
            }
        };
        let creep = self.increments(weights);
        for k in 0..self.point.dashpots {
            let index = Self::STRAINS + k;
            (next.viscous).advance(slots.viscous + k, &view.state.viscous, creep[index]);
            for (stage, &weight) in weights.iter().enumerate() {
                let rate = self.rates[stage][index];
                let drag = self.viscosities[stage].0[k] * view.per_step * rate;
                let heat = weight * (drag * rate);
                dissipate(stage, heat, (slots.viscous + k, &mut *next));
            }
        }
        if in_state.drags() > 0 {
            for (stage, &weight) in weights.iter().enumerate() {
                let heat = weight * self.viscous_heat[stage];
                let drag = view.state.viscous.values().len() + in_state.element.index();
                dissipate(stage, heat, (drag, &mut *next));
            }
        }
        booked
    }

    /// Books the heat to other elements at a stage, during its share of the step, s.
    fn book_paths(
        &self,
        (stage, share): (usize, f64),
        slot: usize,
        (paths, interface): Outside<'_>,
        balances: &mut Balances<'_>,
        received: &mut Received,
    ) {
        for site in paths.map_or(&[][..], |paths| paths[stage]) {
            let other = site.slot as usize;
            let of_set = |slot| interface.of_set(self.point.rule, stage, slot);
            let [own, far] = [slot, other].map(of_set);
            let path = interface.exchange(share * site.conductance, own, far);
            let path = (site.link, &path);
            balances.conduct([slot, other], path, received);
        }
    }

    /// See [`reservoir_correction`]. The unknown here is hṡ and no difference of entropies at two temperatures, so that
    /// `stored` is zero.
    fn reservoir_correction(
        &self,
        (stage, share): (usize, f64),
        slot: usize,
        view: &StepView<'_>,
        heat: f64,
    ) -> f64 {
        if self.point.prescribed.is_some() {
            return 0.0;
        }
        let theta = self.mean_temperature(stage);
        let flow = view.conduction.reservoir_flow(slot, theta);
        let weight = share * view.per_step;
        let taken = weight * theta * self.rates[stage][Self::ENTROPY];
        reservoir_correction(&flow, [share, theta], [taken, 0.0, heat])
    }

    /// Books the heat of the thermostat of an element whose new entropy is given, stage by stage; the rounding of the
    /// entropy at the last one.
    fn book_thermostat(&self, booked: &Booked, entropy: f64, next: &mut State) {
        let rule = self.point.rule;
        let mut total = entropy - self.point.entropy;
        let mut heat = self.heat_beyond;
        let mut rest = total;
        for ((stage, &weight), received) in rule.weights.iter().enumerate().zip(booked) {
            let taken = weight * self.rates[stage][Self::ENTROPY];
            heat += self.mean_temperature(stage) * (taken - received.entropy);
            rest -= taken;
            total -= received.entropy;
        }
        heat += self.mean_temperature(rule.stages() - 1) * rest;
        next.book_thermostat(heat, total);
    }

    /// Θ of a stage, K; one without temperature.
    fn temperature_or_one(&self, stage: usize) -> f64 {
        if self.point.is_thermal {
            self.mean_temperature(stage)
        } else {
            1.0
        }
    }

    /// Adds the terms of its forces, and checks the balances of its internal variables, given the magnitude of the terms of
    /// its energy, J.
    fn certify(
        &self,
        in_state: &Point<A, G::Measures>,
        (view, (paths, interface)): (&StepView<'_>, Outside<'_>),
        (booked, energy): (&Booked, f64),
        tally: &mut Tally,
    ) {
        let weights = self.point.rule.weights;
        let forces = self.amplitude(tally.care);
        tally.force(forces);
        for k in 0..self.point.dashpots {
            let half = 0.5 * self.stiffness[k];
            tally.see_relaxation(view.step, half, self.viscosities[0].0[k]);
        }
        if let Some(slot) = in_state.slots().thermal
            && self.point.prescribed.is_none()
        {
            let capacity = view.state.energies[in_state.element.index()].heat_capacity;
            tally.see_relaxation(view.step, view.conduction.settling(slot), capacity);
        }
        for ((stage, &weight), received) in weights.iter().enumerate().zip(booked) {
            for k in 0..self.point.dashpots {
                let index = Self::STRAINS + k;
                let eta = self.viscosities[stage].0[k];
                let drag = eta * view.per_step * self.rates[stage][index];
                let force = self.conjugates[stage][index];
                let terms = drag.abs() + self.size_of_conjugate([stage, index], tally.care);
                tally.balance(drag + force, terms);
            }
            if !self.point.is_thermal {
                continue;
            }
            let last = Self::ENTROPY;
            let theta = self.mean_temperature(stage);
            if self.point.prescribed.is_none() {
                let taken = weight * theta * self.rates[stage][last];
                let defect = taken - theta * received.entropy;
                let terms = theta * received.terms;
                tally.balance(defect, taken.abs() + terms + energy + forces);
            }
            if paths.is_some()
                && let Some(slot) = in_state.slots().thermal
            {
                let at = interface.of_set(self.point.rule, stage, slot);
                let terms = self.size_of_conjugate([stage, last], tally.care);
                tally.balance(interface.values()[at] - theta, terms);
            }
        }
    }

    /// `Σ b (a·R − heat) + μ w`, the change of energy by the path, J.
    pub(super) fn change_along_path(&self) -> f64 {
        let mut found = 0.0;
        for (stage, &weight) in self.point.rule.weights.iter().enumerate() {
            let work = self.conjugates[stage].dot(&self.rates[stage]);
            found += weight * (work - self.viscous_heat[stage]);
        }
        found + self.heat_beyond
    }

    /// The sizes of the conjugates of the strain, limited by those at the ends of the path.
    pub(crate) fn limited_stress(&self, stage: usize) -> PerStrain<G> {
        let [old, new] = &self.end_slopes;
        let mut sizes = self.conjugates[stage].strain;
        for (q, size) in sizes.as_mut().iter_mut().enumerate() {
            let at_ends = Scalar::maximum(old[q].abs(), new[q].abs());
            *size = Scalar::minimum(size.abs(), at_ends);
        }
        sizes
    }

    /// The sizes of the conjugates of the strain at all stages, with the conditioning errors of the path.
    pub(crate) fn conditioned_stress(
        &mut self,
        in_state: &Point<A, G::Measures>,
    ) -> [PerStrain<G>; MOST_STAGES] {
        self.add_conditioning_of_path(in_state);
        let mut sizes = [PerStrain::<G>::filled(0.0); MOST_STAGES];
        for (stage, sizes) in sizes.iter_mut().enumerate() {
            for (q, size) in sizes.as_mut().iter_mut().enumerate() {
                *size = self.size_of_conjugate([stage, q], Care::Thorough);
            }
        }
        sizes
    }

    /// The size of a conjugate, for a thorough bound with its conditioning error, in units of ε.
    pub(super) fn size_of_conjugate(&self, [stage, index]: [usize; 2], care: Care) -> f64 {
        let size = self.conjugates[stage][index].abs();
        match care {
            Care::Quick => size,
            Care::Thorough => size + self.conditioning[stage][index],
        }
    }

    /// The contribution of its forces to A* and, for a thorough bound, to A⁺ of `step/certificate.rs`, J:
    ///
    /// ```text
    /// |∇ê⁰||y⁰| + |∇ê¹||y¹| + Σ b |a||R| + ε Σ |W| y¹²,     Σ b |∂²ê/∂x∂y| |y| |R_x|
    /// ```
    fn amplitude(&self, care: Care) -> f64 {
        let weights = self.point.rule.weights;
        let mut sum = 0.0;
        for index in 0..Self::ENTROPY {
            let [old, new] = [0, 1].map(|end| self.size_at_end(end, index));
            sum += f64::EPSILON * self.metric[index] * new * new;
            // λ ∂e/∂λ = 2 C ∂ê/∂C
            let [old_slopes, new_slopes] = &self.end_slopes;
            let ends = (old_slopes[index] * old).abs() + (new_slopes[index] * new).abs();
            sum += ends + ends;
            for (stage, &weight) in weights.iter().enumerate() {
                let work = self.conjugates[stage][index] * self.rates[stage][index];
                sum += weight * work.abs();
            }
        }
        // Strains of solids are ratios, whose sizes are unrelated to the motion.
        if G::Measures::IS_SPRING && care == Care::Quick {
            return sum;
        }
        for (stage, &weight) in weights.iter().enumerate() {
            for index in 0..Self::LEN {
                let work = self.conditioning[stage][index] * self.rates[stage][index];
                sum += weight * work.abs();
            }
        }
        sum
    }

    /// The magnitude of the terms of a variable at one of the ends.
    fn size_at_end(&self, end: usize, index: usize) -> f64 {
        if index < Self::STRAINS {
            self.end_sizes[end][index]
        } else {
            [&self.old, &self.end][end][index]
        }
    }

    /// `Σ|f||π| + Σ|g||γ|` of the new state, J.
    fn forces_at_end(&self) -> f64 {
        let strains = Self::STRAINS;
        (0..Self::ENTROPY).fold(0.0, |sum, index| {
            let size = self.size_at_end(1, index);
            let work = (self.end_slopes[1][index] * size).abs();
            // λ ∂e/∂λ = 2 C ∂ê/∂C
            sum + if index < strains { work + work } else { work }
        })
    }
}

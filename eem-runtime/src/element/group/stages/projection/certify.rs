//! What an element with projected conjugates contributes to the certificate of a step.

use super::ProjectedPoint;
use super::closing::Booked;
use super::vector::Vector;
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{PerStrain, QuadraticStrain};
use crate::element::state::State;
use crate::element::tableau::Tableau;
use crate::element::tally::{Care, Recount, Tally};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> ProjectedPoint<S, M, K, D> {
    /// Counts its forces, and judges the balances of its internal variables, given the magnitude of the
    /// terms of its energy, J.
    pub(super) fn certify(
        &self,
        in_state: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        (view, trial): (&StepView<'_, S>, &Trial<S, D>),
        (booked, energy): (&Booked<S>, S),
        tally: &mut Tally<S>,
    ) {
        let forces = self.amplitude(rule, tally.care);
        tally.force(forces);
        tally.exchange(self.impulse(rule, view.step));
        for (stage, received) in booked.iter().enumerate().take(rule.stages()) {
            for k in 0..M::DASHPOTS {
                let index = Vector::<S, M, K, D>::STRAINS + k;
                let eta = self.own.viscosities[stage].0[k];
                let drag = eta * view.per_step * self.own.rates[stage][index];
                let force = self.own.conjugates[stage][index];
                let terms = drag.abs() + self.known_to([stage, index], tally.care);
                tally.balance(drag + force, terms);
            }
            if !M::THERMAL {
                continue;
            }
            let last = Vector::<S, M, K, D>::ENTROPY;
            let (theta, weight) = (
                self.mean_temperature(stage),
                S::from_f64(rule.weights[stage]),
            );
            if self.prescribed.is_none() {
                let taken = weight * theta * self.own.rates[stage][last];
                let lacking = taken - theta * received.entropy;
                let terms = theta * received.terms;
                tally.balance(lacking, taken.abs() + terms + energy + forces);
            }
            if self.contacts.is_some()
                && let Some(slot) = in_state.slots().thermal
            {
                let seen = trial.seen.values()[trial.seen_of_set(stage, slot)];
                let terms = self.known_to([stage, last], tally.care);
                tally.balance(seen - theta, terms);
            }
        }
    }

    /// To what a conjugate is known, in units of ε.
    fn known_to(&self, [stage, index]: [usize; 2], care: Care) -> S {
        let size = self.own.conjugates[stage][index].abs();
        match care {
            Care::Quick => size,
            Care::Thorough => size + self.own.resolution[stage][index],
        }
    }

    /// What its forces contribute to A and, with care, to A⁺, J:
    ///
    /// ```text
    /// |∇ê⁰||y⁰| + |∇ê¹||y¹| + Σ b |a||R| + ε Σ |W| y¹²,     Σ b |∂²ê/∂x∂y| |y| |R_x|
    /// ```
    fn amplitude(&self, rule: &Tableau, care: Care) -> S {
        let own = &self.own;
        let mut sum = S::zero();
        for index in 0..Vector::<S, M, K, D>::ENTROPY {
            let [old, new] = [0, 1].map(|end| self.size_at_end(end, index));
            sum += S::EPSILON * own.metric[index] * new * new;
            // λ ∂e/∂λ = 2 C ∂ê/∂C
            let [old_slopes, new_slopes] = &own.end_slopes;
            let ends = (old_slopes[index] * old).abs() + (new_slopes[index] * new).abs();
            sum += ends + ends;
            for (stage, &weight) in rule.weights.iter().enumerate() {
                let work = own.conjugates[stage][index] * own.rates[stage][index];
                sum += S::from_f64(weight) * work.abs();
            }
        }
        // Strains of solids are ratios, whose sizes have nothing to do with the motion.
        if K::IS_SPRING && care == Care::Quick {
            return sum;
        }
        for (stage, &weight) in rule.weights.iter().enumerate() {
            for index in 0..Vector::<S, M, K, D>::LEN {
                let work = own.resolution[stage][index] * own.rates[stage][index];
                sum += S::from_f64(weight) * work.abs();
            }
        }
        sum
    }

    /// The magnitude of the terms of a variable at one of the ends.
    fn size_at_end(&self, end: usize, index: usize) -> S {
        let y = [&self.own.old, &self.own.end][end];
        if index < Vector::<S, M, K, D>::STRAINS {
            self.own.end_sizes[end][index]
        } else {
            y[index]
        }
    }

    /// `Σ|f||π| + Σ|g||γ|` of the new state, which the amplitude has for both ends, J.
    pub(super) fn forces_at_end(&self) -> S {
        let strains = Vector::<S, M, K, D>::STRAINS;
        (0..Vector::<S, M, K, D>::ENTROPY).fold(S::zero(), |sum, index| {
            let size = self.size_at_end(1, index);
            let work = (self.own.end_slopes[1][index] * size).abs();
            // λ ∂e/∂λ = 2 C ∂ê/∂C
            sum + if index < strains { work + work } else { work }
        })
    }

    /// `h Σ b |F|`, N s.
    fn impulse(&self, rule: &Tableau, step: S) -> S {
        let mut sum = S::zero();
        for (stage, &weight) in rule.weights.iter().enumerate() {
            let mut sizes = PerStrain::<K, S, D>::filled(S::zero());
            for (q, size) in sizes.as_mut().iter_mut().enumerate() {
                *size = self.own.conjugates[stage][q].abs();
            }
            let force = self
                .kinematics
                .strain_force_size(&self.own.arms[stage], &sizes);
            sum += step * S::from_f64(weight) * force;
        }
        sum
    }

    /// The magnitude of what the forces of the stages are computed from in a step, N s.
    pub(super) fn magnitude_of_impulse(&self, rule: &Tableau, step: S) -> S {
        let mut largest = S::zero();
        for stage in 0..rule.stages() {
            let own = &self.own;
            let mut known = PerStrain::<K, S, D>::filled(S::zero());
            for (q, known) in known.as_mut().iter_mut().enumerate() {
                *known = own.conjugates[stage][q].abs() + own.resolution[stage][q];
            }
            let force = self.kinematics.strain_force_size(&own.arms[stage], &known);
            largest = largest.maximum(force);
        }
        step * largest
    }

    /// Its balance of energy between two states.
    pub(super) fn recount_energy(
        &self,
        in_state: &StatePoint<S, M, K, D>,
        (rule, nodes): (&Tableau, &K::PerNode<u32>),
        ends: [&State<S>; 2],
        recount: &mut Recount<S>,
    ) {
        let own = in_state.balance_between(nodes, ends);
        let mut found = S::zero();
        for (stage, &weight) in rule.weights.iter().enumerate() {
            let terms = self.own.conjugates[stage].entries();
            let work = terms.zip(self.own.rates[stage].entries());
            let work = work.fold(S::zero(), |sum, (a, rate)| sum + a * rate);
            found += S::from_f64(weight) * (work - self.own.drags[stage].heat);
        }
        recount.element(in_state.element, own.by_values, own.by_differences, found);
    }
}

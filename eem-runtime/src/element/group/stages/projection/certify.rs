//! What an element with projected conjugates contributes to the certificate of a step.

use super::ProjectedMember;
use super::closing::Booked;
use crate::element::group::arms::along;
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::Kinematics;
use crate::element::recount::Recount;
use crate::element::state::State;
use crate::element::tableau::Tableau;
use crate::element::tally::{Care, Tally};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

impl<S, M, K, const D: usize> ProjectedMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Counts its forces, and judges the balances of its internal variables, given the magnitude of the
    /// terms of its energy, J.
    pub(super) fn certify(
        &self,
        point: &StatePoint<S, M, K, D>,
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
                let index = M::MEASURES + k;
                let eta = self.own.viscosities[stage].0[k];
                let drag = eta * view.per_step * self.own.rates[stage][index];
                let force = self.own.conjugates[stage][index];
                let terms = drag.abs() + self.known_to([stage, index], tally.care);
                tally.balance(drag + force, terms);
            }
            if !M::THERMAL {
                continue;
            }
            let last = M::Variables::LEN - 1;
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
            if self.site.contacts.is_some()
                && let Some(slot) = point.slots().thermal
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
        for index in 0..M::MEASURES + M::DASHPOTS {
            let end = own.end[index];
            sum += S::EPSILON * own.metric[index] * end * end;
            // λ ∂e/∂λ = 2 C ∂ê/∂C
            let [old_slopes, new_slopes] = &own.end_slopes;
            let ends = (old_slopes[index] * own.old[index]).abs() + (new_slopes[index] * end).abs();
            sum += ends + ends;
            for (stage, &weight) in rule.weights.iter().enumerate() {
                let work = own.conjugates[stage][index] * own.rates[stage][index];
                sum += S::from_f64(weight) * work.abs();
            }
        }
        if care == Care::Quick {
            return sum;
        }
        for (stage, &weight) in rule.weights.iter().enumerate() {
            for index in 0..M::Variables::LEN {
                let work = own.resolution[stage][index] * own.rates[stage][index];
                sum += S::from_f64(weight) * work.abs();
            }
        }
        sum
    }

    /// `|f|λ + Σ|g||γ|` of the new state, which the amplitude has for both ends, J.
    pub(super) fn forces_at_end(&self) -> S {
        let own = &self.own;
        (0..M::MEASURES + M::DASHPOTS).fold(S::zero(), |sum, index| {
            let work = (own.end_slopes[1][index] * own.end[index]).abs();
            // λ ∂e/∂λ = 2 C ∂ê/∂C
            sum + if index < M::MEASURES {
                work + work
            } else {
                work
            }
        })
    }

    /// `h Σ b |F|`, N s.
    fn impulse(&self, rule: &Tableau, step: S) -> S {
        let mut sum = S::zero();
        for (stage, &weight) in rule.weights.iter().enumerate() {
            let force = self.own.conjugates[stage][0].abs() * self.length_at(stage);
            sum += step * S::from_f64(weight) * (force + force);
        }
        sum
    }

    /// The magnitude of what the forces of the stages are computed from in a step, N s.
    pub(super) fn magnitude_of_impulse(&self, rule: &Tableau, step: S) -> S {
        let mut largest = S::zero();
        for stage in 0..rule.stages() {
            let own = &self.own;
            let known = own.conjugates[stage][0].abs() + own.resolution[stage][0];
            largest = largest.maximum(known * self.length_at(stage));
        }
        step * (largest + largest)
    }

    /// `|d_i|`, m.
    fn length_at(&self, stage: usize) -> S {
        let twice = &self.own.directions[stage];
        S::from_f64(0.5) * along::<K, S, D>(twice, twice).sqrt()
    }

    /// Its balance of energy between two states.
    pub(super) fn recount_energy(
        &self,
        point: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        ends: [&State<S>; 2],
        recount: &mut Recount<S>,
    ) {
        let nodes = &self.site.common().nodes;
        let own = point.balance_between(nodes, ends);
        let mut found = S::zero();
        for (stage, &weight) in rule.weights.iter().enumerate() {
            let terms = self.own.conjugates[stage].as_ref().iter();
            let work = terms.zip(self.own.rates[stage].as_ref());
            let work = work.fold(S::zero(), |sum, (&a, &rate)| sum + a * rate);
            found += S::from_f64(weight) * work;
        }
        recount.element(point.element, own.by_values, own.by_differences, found);
    }
}

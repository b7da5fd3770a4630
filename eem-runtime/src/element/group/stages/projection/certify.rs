//! What an element with projected conjugates contributes to the certificate of a step.

use super::Projections;
use super::closing::Booked;
use super::vector::Vector;
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{PerStrain, QuadraticStrain};
use crate::element::tally::{Care, Tally};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> Projections<S, M, K, D> {
    /// Adds its forces, and checks the balances of its internal variables, given the magnitude of the terms of its
    /// energy, J.
    pub(super) fn certify(
        &self,
        in_state: &StatePoint<S, M, K, D>,
        (view, trial): (&StepView<'_, S>, &Trial<S, D>),
        (booked, energy): (&Booked<S>, S),
        tally: &mut Tally<S>,
    ) {
        let weights = self.point.rule.weights;
        let forces = self.amplitude(tally.care);
        tally.force(forces);
        // h Σ b |F|
        let impulse = weights.iter().enumerate();
        let impulse = impulse.fold(S::zero(), |sum, (stage, &weight)| {
            let force = self.force_size(stage, |q| self.conjugates[stage][q].abs());
            sum + view.step * S::from_f64(weight) * force
        });
        tally.exchange(impulse);
        for ((stage, &weight), received) in weights.iter().enumerate().zip(booked) {
            for k in 0..M::DASHPOTS {
                let index = Vector::<S, M, K, D>::STRAINS + k;
                let eta = self.viscosities[stage].0[k];
                let drag = eta * view.per_step * self.rates[stage][index];
                let force = self.conjugates[stage][index];
                let terms = drag.abs() + self.size_of_conjugate([stage, index], tally.care);
                tally.balance(drag + force, terms);
            }
            if !M::THERMAL {
                continue;
            }
            let last = Vector::<S, M, K, D>::ENTROPY;
            let theta = self.mean_temperature(stage);
            if self.point.prescribed.is_none() {
                let taken = S::from_f64(weight) * theta * self.rates[stage][last];
                let defect = taken - theta * received.entropy;
                let terms = theta * received.terms;
                tally.balance(defect, taken.abs() + terms + energy + forces);
            }
            if self.point.contacts.is_some()
                && let Some(slot) = in_state.slots().thermal
            {
                let seen = trial.seen.values()[trial.seen_of_set(stage, slot)];
                let terms = self.size_of_conjugate([stage, last], tally.care);
                tally.balance(seen - theta, terms);
            }
        }
    }

    /// The size of a conjugate, for a thorough bound with its conditioning error, in units of ε.
    fn size_of_conjugate(&self, [stage, index]: [usize; 2], care: Care) -> S {
        let size = self.conjugates[stage][index].abs();
        match care {
            Care::Quick => size,
            Care::Thorough => size + self.resolution[stage][index],
        }
    }

    /// What its forces contribute to A and, for a thorough bound, to A⁺, J:
    ///
    /// ```text
    /// |∇ê⁰||y⁰| + |∇ê¹||y¹| + Σ b |a||R| + ε Σ |W| y¹²,     Σ b |∂²ê/∂x∂y| |y| |R_x|
    /// ```
    fn amplitude(&self, care: Care) -> S {
        let weights = self.point.rule.weights;
        let mut sum = S::zero();
        for index in 0..Vector::<S, M, K, D>::ENTROPY {
            let [old, new] = [0, 1].map(|end| self.size_at_end(end, index));
            sum += S::EPSILON * self.metric[index] * new * new;
            // λ ∂e/∂λ = 2 C ∂ê/∂C
            let [old_slopes, new_slopes] = &self.end_slopes;
            let ends = (old_slopes[index] * old).abs() + (new_slopes[index] * new).abs();
            sum += ends + ends;
            for (stage, &weight) in weights.iter().enumerate() {
                let work = self.conjugates[stage][index] * self.rates[stage][index];
                sum += S::from_f64(weight) * work.abs();
            }
        }
        // Strains of solids are ratios, whose sizes are unrelated to the motion.
        if K::IS_SPRING && care == Care::Quick {
            return sum;
        }
        for (stage, &weight) in weights.iter().enumerate() {
            for index in 0..Vector::<S, M, K, D>::LEN {
                let work = self.resolution[stage][index] * self.rates[stage][index];
                sum += S::from_f64(weight) * work.abs();
            }
        }
        sum
    }

    /// The magnitude of the terms of a variable at one of the ends.
    fn size_at_end(&self, end: usize, index: usize) -> S {
        if index < Vector::<S, M, K, D>::STRAINS {
            self.end_sizes[end][index]
        } else {
            [&self.old, &self.end][end][index]
        }
    }

    /// `Σ|f||π| + Σ|g||γ|` of the new state, which the amplitude has for both ends, J.
    pub(super) fn forces_at_end(&self) -> S {
        let strains = Vector::<S, M, K, D>::STRAINS;
        (0..Vector::<S, M, K, D>::ENTROPY).fold(S::zero(), |sum, index| {
            let size = self.size_at_end(1, index);
            let work = (self.end_slopes[1][index] * size).abs();
            // λ ∂e/∂λ = 2 C ∂ê/∂C
            sum + if index < strains { work + work } else { work }
        })
    }

    /// The magnitude of the terms of the force on the nodes at a stage, given that of each conjugate of the strain, N.
    pub(super) fn force_size(&self, stage: usize, of: impl Fn(usize) -> S) -> S {
        let mut sizes = PerStrain::<K, S, D>::filled(S::zero());
        for (q, size) in sizes.as_mut().iter_mut().enumerate() {
            *size = of(q);
        }
        let arms = &self.arms[stage];
        self.point.kinematics.strain_force_size(arms, &sizes)
    }
}

//! Conjugates that are projections of the derivatives of the energy along the path through a step, TC-cG(k).
//!
//! With `C = λ²`, `ê(C, γ, s) = e(√C, γ, s)` and the polynomials through the increments `R_i = h(Ċ, γ̇, ṡ)_i`,
//!
//! ```text
//! Ċ_i = 2 d_i·ḋ_i       (½N, −G, Θ)_i = a_i = Σ_r projection_ir ∇ê(y(τ_r)) + μ W R_i
//! μ = (Δê − Σ b_i a_i·R_i)/Σ b_i R_i·W R_i
//!
//! F_i = N_i d_i,   γ̇_i = G_i/η(Θ_i),   Θ_i ṡ_i = Σ η γ̇_i² + Σ κ(Θ_f − Θ)_i
//! ```
//!
//! (Groß & Betsch 2011; `C` as an independent path: Betsch & Steinmann 2001). As `2 d·ḋ` has the degree `2k − 1`,
//! the path of C ends at `|d¹|²`; so μ, which vanishes with the error of the quadrature, makes
//! `Σ b_i a_i·R_i` the change of the energy of the element. `Δê` is that of discrete derivatives between the
//! ends, without a difference of energies.
//!
//! The local unknowns are the increments of γ and s at all stages, the inputs those of C and heat.

mod begin;
mod certify;
mod closing;
mod exact;
mod local;
mod path;

use super::heat;
use super::local::LocalStages;
use super::member::{StageMember, StatePoint};
use super::site::PerPair;
use super::source::Source;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, along, scale};
use crate::element::group::closing::pull;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Blocks, Kinematics, Weights};
use crate::element::recount::Recount;
use crate::element::state::State;
use crate::element::tableau::{MOST_POINTS, MOST_SETS, MOST_STAGES, Tableau};
use crate::element::tally::Tally;
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

/// The path of a spring through a step, and what is projected from it.
pub(crate) struct Projections<S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, const D: usize> {
    /// `y⁰ = (C, γ…, s)`, and what the discrete derivatives need of `(λ, γ, θ)⁰`.
    old: M::Variables,
    old_form: M::TemperatureFormOld,
    /// λ⁰, m.
    old_stretch: S,
    /// The units of the increments: C⁰, λ⁰, the old heat capacity.
    units: M::Variables,
    /// The diagonal of W.
    metric: M::Variables,
    /// R: the increments h ẏ at the stages.
    rates: [M::Variables; MOST_STAGES],
    /// The same before the last correction, and the correction, without those of C.
    previous: [M::Variables; MOST_STAGES],
    correction: [M::Variables; MOST_STAGES],
    /// The temperatures of the points of the path, and that of its end, K.
    temperatures: [S; MOST_POINTS + 1],
    /// y¹, and `∇ê` at both ends.
    end: M::Variables,
    end_slopes: [M::Variables; 2],
    /// a.
    conjugates: [M::Variables; MOST_STAGES],
    /// `∂a_i/∂R_j`.
    by_rates: PerPair<M::Hessian>,
    /// `Σ_r |projection_ir| Σ_y |∂²ê/∂x∂y| |y|`: times ε, to what the conjugates are known.
    resolution: [M::Variables; MOST_STAGES],
    /// `η_k` and `dη_k/dθ` at `Θ_i`.
    viscosities: [(M::Viscosities, M::Viscosities); MOST_STAGES],
    /// Heat from other elements at the stages, W.
    received: [S; MOST_STAGES],
    /// `∂C/∂d = 2 d_i` and `h ḋ_i`, m.
    directions: [Arms<K, S, D>; MOST_STAGES],
    motions: [Arms<K, S, D>; MOST_STAGES],
}

/// An element with such conjugates.
pub(super) type ProjectedMember<S, M, K, const D: usize> =
    StageMember<S, M, K, Projections<S, M, K, D>, D>;

impl<S, M, K, const D: usize> Source<S, M, K, D> for Projections<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    fn new() -> Self {
        let zeros = M::Variables::filled(S::zero());
        let viscosities = M::Viscosities::filled(S::zero());
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        Self {
            old: zeros,
            old_form: M::TemperatureFormOld::filled(S::zero()),
            old_stretch: S::zero(),
            units: zeros,
            metric: zeros,
            rates: [zeros; MOST_STAGES],
            previous: [zeros; MOST_STAGES],
            correction: [zeros; MOST_STAGES],
            temperatures: [S::zero(); MOST_POINTS + 1],
            end: zeros,
            end_slopes: [zeros; 2],
            conjugates: [zeros; MOST_STAGES],
            by_rates: [[M::Hessian::filled(zeros); MOST_SETS]; MOST_SETS],
            resolution: [zeros; MOST_STAGES],
            viscosities: [(viscosities, viscosities); MOST_STAGES],
            received: [S::zero(); MOST_STAGES],
            directions: [nowhere; MOST_STAGES],
            motions: [nowhere; MOST_STAGES],
        }
    }

    fn begin(
        member: &mut ProjectedMember<S, M, K, D>,
        point: &StatePoint<S, M, K, D>,
        view: &StepView<'_, S>,
    ) {
        member.begin_path(point, view);
    }

    fn evaluate(
        member: &mut ProjectedMember<S, M, K, D>,
        own: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
    ) -> Result<(), StateError> {
        if let Some(slot) = own.slots().thermal {
            for stage in 0..rule.stages() {
                member.own.received[stage] = heat::received(rule, stage, slot, view, trial);
            }
        }
        member.move_along(own, rule, trial)?;
        member.project(own, rule)?;
        let end = member.reach_end(own, rule)?;
        member.make_exact(rule, &end);
        member.find_viscosities(own, rule)
    }

    fn write_equations(
        member: &mut ProjectedMember<S, M, K, D>,
        own: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        view: &StepView<'_, S>,
    ) {
        member.write_path(own, rule, local, view);
    }

    fn force(
        member: &ProjectedMember<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        stage: usize,
        measure: usize,
    ) -> S {
        member.eliminate(rule, local, [stage, measure]);
        member.own.conjugates[stage][measure]
    }

    fn direction(member: &ProjectedMember<S, M, K, D>, stage: usize, _: usize) -> &Arms<K, S, D> {
        &member.own.directions[stage]
    }

    // F = ½N ∂C/∂d, ∂²C/∂d² = 2
    fn turn(
        member: &ProjectedMember<S, M, K, D>,
        _: &Tableau,
        set: usize,
        _: &Trial<S, D>,
    ) -> Blocks<K, S, D> {
        let mut blocks = Blocks::<K, S, D>::filled(K::PerArm::filled([[S::zero(); D]; D]));
        let weights = Self::secant(member, set);
        for axis in 0..D {
            blocks[0][0][axis][axis] = weights[0][0];
        }
        blocks
    }

    fn temperature(
        member: &ProjectedMember<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        set: usize,
    ) -> S {
        member.eliminate(rule, local, [set, M::Variables::LEN - 1]);
        member.mean_temperature(set)
    }

    // ∂(hĊ_i)/∂d_j = 2 δ_ij h ḋ_i + 2 motion_ij d_i
    fn by_arms(
        member: &ProjectedMember<S, M, K, D>,
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> [Arms<K, S, D>; MOST_SETS] {
        let mut by_arms = [Arms::<K, S, D>::filled([S::zero(); D]); MOST_SETS];
        for (stage, row) in rule.motion.iter().enumerate() {
            let by = local.row[1 + stage * M::MEASURES];
            let own = &member.own;
            let mut turning = own.motions[stage];
            scale::<K, S, D>(&mut turning, by + by);
            add_scaled::<K, S, D>(&mut by_arms[stage], S::one(), &turning);
            for (sum, &share) in by_arms.iter_mut().zip(*row) {
                let by = by * S::from_f64(share);
                add_scaled::<K, S, D>(sum, by, &own.directions[stage]);
            }
        }
        by_arms
    }

    fn inputs(
        member: &ProjectedMember<S, M, K, D>,
        rule: &Tableau,
        motions: &[Arms<K, S, D>; MOST_SETS],
        inputs: &mut [S],
    ) {
        for (stage, row) in rule.motion.iter().enumerate() {
            let own = &member.own;
            let turned = along::<K, S, D>(&own.motions[stage], &motions[stage]);
            let mut change = turned + turned;
            for (motion, &share) in motions.iter().zip(*row) {
                let along = along::<K, S, D>(&own.directions[stage], motion);
                change += S::from_f64(share) * along;
            }
            inputs[stage * M::MEASURES] = change;
        }
    }

    fn hold(member: &mut ProjectedMember<S, M, K, D>) {
        member.own.previous = member.own.rates;
        member.own.correction = [M::Variables::filled(S::zero()); MOST_STAGES];
    }

    fn correct(
        member: &mut ProjectedMember<S, M, K, D>,
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> S {
        let creeping = rule.sets() * M::DASHPOTS;
        let mut largest = S::zero();
        for unknown in 0..local.unknowns() {
            let change = local.change(&member.solved, unknown);
            let (stage, index) = if unknown < creeping {
                (unknown / M::DASHPOTS, M::MEASURES + unknown % M::DASHPOTS)
            } else {
                (unknown - creeping, M::Variables::LEN - 1)
            };
            member.own.correction[stage][index] = member.own.units[index] * change;
            largest = largest.maximum(change.abs());
        }
        largest
    }

    fn apply(member: &mut ProjectedMember<S, M, K, D>, rule: &Tableau, share: S) {
        let own = &mut member.own;
        for stage in 0..rule.stages() {
            for index in M::MEASURES..M::Variables::LEN {
                let change = share * own.correction[stage][index];
                own.rates[stage][index] = own.previous[stage][index] + change;
            }
        }
    }

    fn pull(
        member: &ProjectedMember<S, M, K, D>,
        _: &Tableau,
        stage: usize,
        _: &Trial<S, D>,
    ) -> K::PerNode<[S; D]> {
        let mut weights = Self::secant(member, stage);
        // Directions are twice the arms.
        weights[0][0] *= S::from_f64(0.5);
        pull::<K, S, D>(&weights, &member.own.directions[stage])
    }

    fn secant(member: &ProjectedMember<S, M, K, D>, stage: usize) -> Weights<K, S, D> {
        let mut weights = Weights::<K, S, D>::filled(K::PerArm::filled(S::zero()));
        let half_tension = member.own.conjugates[stage][0];
        weights[0][0] = half_tension + half_tension;
        weights
    }

    fn magnitude(member: &ProjectedMember<S, M, K, D>, rule: &Tableau, step: S) -> S {
        member.magnitude_of_impulse(rule, step)
    }

    fn close(
        member: &mut ProjectedMember<S, M, K, D>,
        own: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        (view, trial, r1): (&StepView<'_, S>, &Trial<S, D>, &Arms<K, S, D>),
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError> {
        let booked = member.book(own, rule, (view, trial), next, tally);
        let near = member.own.temperatures[MOST_POINTS];
        if let Some(entropy) = own.settle(r1, view, near, next)? {
            member.book_thermostat(rule, &booked, entropy, next);
        }
        let energy = &mut next.energies[own.element.index()];
        energy.terms += member.forces_at_end();
        let magnitude = energy.magnitude;
        member.certify(own, rule, (view, trial), (&booked, magnitude), tally);
        Ok(())
    }

    fn recount(
        member: &ProjectedMember<S, M, K, D>,
        own: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        ends: [&State<S>; 2],
        recount: &mut Recount<S>,
    ) {
        member.recount_energy(own, rule, ends, recount);
    }
}

impl<S, M, K, const D: usize> ProjectedMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Θ of a stage, K; zero without temperature.
    fn mean_temperature(&self, stage: usize) -> S {
        if M::THERMAL {
            self.own.conjugates[stage][M::Variables::LEN - 1]
        } else {
            S::zero()
        }
    }

    /// `Σ_j shares_j R_j`.
    fn increments(&self, shares: &[f64]) -> M::Variables {
        let mut sum = M::Variables::filled(S::zero());
        for (rates, &share) in self.own.rates.iter().zip(shares) {
            for (sum, &rate) in sum.as_mut().iter_mut().zip(rates.as_ref()) {
                *sum += S::from_f64(share) * rate;
            }
        }
        sum
    }
}

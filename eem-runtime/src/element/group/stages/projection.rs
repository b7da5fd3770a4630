//! Conjugates that are projections of the derivatives of the energy along the path through a step, TC-cG(k).
//!
//! With the [strain](QuadraticStrain) C, `ê(C, γ, s) = e(π(C), γ, s)` and the polynomials through the increments `R_i = h(Ċ, γ̇, ṡ)_i`,
//!
//! ```text
//! Ċ_i = ∂C/∂d_i·ḋ_i     (N, −G, Θ)_i = a_i = Σ_r projection_ir ∇ê(y(τ_r)) + μ W R_i
//! μ = (Δê − Σ b_i a_i·R_i)/Σ b_i R_i·W R_i
//!
//! F_i = N_i ∂C/∂d_i,   γ̇_i = G_i/η(Θ_i),   Θ_i ṡ_i = Σ η γ̇_i² + Σ κ(Θ_f − Θ)_i
//! ```
//!
//! (Groß & Betsch 2011; `C` as an independent path: Betsch & Steinmann 2001). As Ċ has the degree `2k − 1`,
//! the path of C ends at the strain of d¹; so μ, which vanishes with the error of the quadrature, makes
//! `Σ b_i a_i·R_i` the change of the energy of the element. `Δê` is that of discrete derivatives between the
//! ends, without a difference of energies.
//!
//! The local unknowns are the increments of γ and s at all stages, the inputs those of C and heat.

mod begin;
mod certify;
mod closing;
mod derivatives;
mod drag;
mod drag_heat;
mod exact;
mod local;
mod path;
mod vector;

use super::heat;
use super::local::LocalStages;
use super::member::{StageArms, StagePoint, StatePoint};
use super::site::PerPair;
use super::source::Source;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, spread};
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Blocks, PerStrain, QuadraticStrain};
use crate::element::state::State;
use crate::element::tableau::{MOST_POINTS, MOST_SETS, MOST_STAGES, Tableau};
use crate::element::tally::{Recount, Tally};
use drag_heat::DragHeat;
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::Real;
use vector::{Matrix, Vector};

/// The path of a point through a step, and what is projected from it.
pub(crate) struct Projections<S: Real, M: FreeEnergy<S>, K: QuadraticStrain<S, D>, const D: usize> {
    /// `y⁰ = (C, γ…, s)`, and what the discrete derivatives need of `(π, γ, θ)⁰`.
    old: Vector<S, M, K, D>,
    old_form: M::TemperatureFormOld,
    /// The units of the increments of γ and s: that of viscous stretches, the old heat capacity.
    units: Vector<S, M, K, D>,
    /// The diagonal of W.
    metric: Vector<S, M, K, D>,
    /// R: the increments h ẏ at the stages.
    rates: [Vector<S, M, K, D>; MOST_STAGES],
    /// The same before the last correction, and the correction, without those of C.
    previous: [Vector<S, M, K, D>; MOST_STAGES],
    correction: [Vector<S, M, K, D>; MOST_STAGES],
    /// The temperatures of the points of the path, and that of its end, K.
    temperatures: [S; MOST_POINTS + 1],
    /// y¹, and `∇ê` and the magnitudes of the terms of C at both ends.
    end: Vector<S, M, K, D>,
    end_slopes: [Vector<S, M, K, D>; 2],
    end_sizes: [PerStrain<K, S, D>; 2],
    /// a.
    conjugates: [Vector<S, M, K, D>; MOST_STAGES],
    /// `∂a_i/∂R_j`.
    by_rates: Box<PerPair<Matrix<S, M, K, D>>>,
    /// `Σ_r |projection_ir| Σ_y |∂²ê/∂x∂y| |y|`: times ε, to what the conjugates are known.
    resolution: [Vector<S, M, K, D>; MOST_STAGES],
    /// `η_k` and `dη_k/dθ` at `Θ_i`.
    viscosities: [(M::Viscosities, M::Viscosities); MOST_STAGES],
    drags: [DragHeat<S, K, D>; MOST_STAGES],
    /// Heat from other elements at the stages, W.
    received: [S; MOST_STAGES],
    /// `d_i` and `h ḋ_i`, m.
    arms: [Arms<K, S, D>; MOST_STAGES],
    motions: [Arms<K, S, D>; MOST_STAGES],
}

/// Along which arms the components of the strain act at the stages: `∂C_q/∂d_i`, and the same for `h ḋ_i`.
pub(crate) struct Directions<K: QuadraticStrain<S, D>, S: Real, const D: usize> {
    along: [K::PerStrain<Arms<K, S, D>>; MOST_STAGES],
    turning: [K::PerStrain<Arms<K, S, D>>; MOST_STAGES],
}

/// A point with such conjugates.
pub(super) type ProjectedPoint<S, M, K, const D: usize> =
    StagePoint<S, M, K, Projections<S, M, K, D>, D>;

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> Source<S, M, K, D>
    for Projections<S, M, K, D>
{
    const FORCES: usize = Vector::<S, M, K, D>::STRAINS;

    type Bases = Directions<K, S, D>;

    fn new() -> Self {
        let zeros = Vector::zero();
        let viscosities = M::Viscosities::filled(S::zero());
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        Self {
            old: zeros,
            old_form: M::TemperatureFormOld::filled(S::zero()),
            units: zeros,
            metric: zeros,
            rates: [zeros; MOST_STAGES],
            previous: [zeros; MOST_STAGES],
            correction: [zeros; MOST_STAGES],
            temperatures: [S::zero(); MOST_POINTS + 1],
            end: zeros,
            end_slopes: [zeros; 2],
            end_sizes: [PerStrain::<K, S, D>::filled(S::zero()); 2],
            conjugates: [zeros; MOST_STAGES],
            by_rates: Box::new([[Matrix::zero(); MOST_SETS]; MOST_SETS]),
            resolution: [zeros; MOST_STAGES],
            viscosities: [(viscosities, viscosities); MOST_STAGES],
            drags: [(); MOST_STAGES].map(|()| DragHeat::zero()),
            received: [S::zero(); MOST_STAGES],
            arms: [nowhere; MOST_STAGES],
            motions: [nowhere; MOST_STAGES],
        }
    }

    fn begin(
        point: &mut ProjectedPoint<S, M, K, D>,
        in_state: &StatePoint<S, M, K, D>,
        view: &StepView<'_, S>,
        r0: &Arms<K, S, D>,
    ) {
        point.begin_path(in_state, view, r0);
    }

    fn evaluate(
        point: &mut ProjectedPoint<S, M, K, D>,
        in_state: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        (view, trial): (&StepView<'_, S>, &Trial<S, D>),
        arms: &StageArms<K, S, D>,
    ) -> Result<(), StateError> {
        if let Some(slot) = in_state.slots().thermal {
            for stage in 0..rule.stages() {
                point.own.received[stage] = heat::received(rule, stage, slot, view, trial);
            }
        }
        point.move_along(in_state, rule, arms)?;
        point.project(in_state, rule)?;
        let end = point.reach_end(in_state, rule)?;
        point.make_exact(rule, &end);
        point.find_viscosities(in_state, rule)?;
        point.add_drag(in_state, rule, view.per_step)
    }

    fn write_equations(
        point: &mut ProjectedPoint<S, M, K, D>,
        in_state: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        view: &StepView<'_, S>,
    ) -> Result<(), StateError> {
        point.write_path(in_state, rule, local, view)
    }

    fn force(
        point: &ProjectedPoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        [stage, component]: [usize; 2],
    ) -> S {
        point.eliminate(rule, local, [stage, component]);
        point.own.conjugates[stage][component]
    }

    fn bases(point: &ProjectedPoint<S, M, K, D>, rule: &Tableau) -> Directions<K, S, D> {
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        let none = [K::PerStrain::filled(nowhere); MOST_STAGES];
        let mut bases: Directions<K, S, D> = Directions {
            along: none,
            turning: none,
        };
        let (own, kinematics) = (&point.own, &point.kinematics);
        for stage in 0..rule.stages() {
            let along = bases.along[stage].as_mut().iter_mut();
            let pairs = along.zip(bases.turning[stage].as_mut());
            for (component, (along, turning)) in pairs.enumerate() {
                let mut unit = PerStrain::<K, S, D>::filled(S::zero());
                unit[component] = S::one();
                *along = kinematics.strain_force(&own.arms[stage], &unit);
                *turning = kinematics.strain_force(&own.motions[stage], &unit);
            }
        }
        bases
    }

    fn direction<'a>(
        _: &'a ProjectedPoint<S, M, K, D>,
        bases: &'a Directions<K, S, D>,
        [stage, component]: [usize; 2],
    ) -> &'a Arms<K, S, D> {
        &bases.along[stage].as_ref()[component]
    }

    fn turn(
        point: &ProjectedPoint<S, M, K, D>,
        _: &Tableau,
        set: usize,
        _: &StageArms<K, S, D>,
    ) -> Blocks<K, S, D> {
        let mut blocks = Blocks::<K, S, D>::filled(K::PerArm::filled([[S::zero(); D]; D]));
        let stress = point.own.conjugates[set].strain;
        let weights = point.kinematics.strain_stiffness(&stress);
        for (row, weights) in blocks.as_mut().iter_mut().zip(weights.as_ref()) {
            for (block, &weight) in row.as_mut().iter_mut().zip(weights.as_ref()) {
                for (axis, row) in block.iter_mut().enumerate() {
                    row[axis] = weight;
                }
            }
        }
        blocks
    }

    fn temperature(
        point: &ProjectedPoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        set: usize,
    ) -> S {
        point.eliminate(rule, local, [set, Vector::<S, M, K, D>::ENTROPY]);
        point.mean_temperature(set)
    }

    // ∂(hĊ_i)/∂d_j = δ_ij ∂²C/∂d² h ḋ_i + motion_ij ∂C/∂d_i
    fn by_arms(
        _: &ProjectedPoint<S, M, K, D>,
        bases: &Directions<K, S, D>,
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> [Arms<K, S, D>; MOST_SETS] {
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        let mut by_arms = [nowhere; MOST_SETS];
        for (stage, row) in rule.motion.iter().enumerate() {
            let mut along = nowhere;
            let rows = bases.along[stage].as_ref().iter();
            let rows = rows.zip(bases.turning[stage].as_ref());
            for ((own, turning), &by) in rows.zip(&local.row[1 + stage * Self::FORCES..]) {
                add_scaled::<K, S, D>(&mut along, by, own);
                add_scaled::<K, S, D>(&mut by_arms[stage], by, turning);
            }
            for (sum, &share) in by_arms.iter_mut().zip(*row) {
                add_scaled::<K, S, D>(sum, S::from_f64(share), &along);
            }
        }
        by_arms
    }

    fn inputs(
        point: &ProjectedPoint<S, M, K, D>,
        rule: &Tableau,
        motions: &[Arms<K, S, D>; MOST_SETS],
        inputs: &mut [S],
    ) {
        let (own, kinematics) = (&point.own, &point.kinematics);
        for (stage, row) in rule.motion.iter().enumerate() {
            let turned = kinematics.strain_rate(&own.motions[stage], &motions[stage]);
            let mut change = Arms::<K, S, D>::filled([S::zero(); D]);
            for (motion, &share) in motions.iter().zip(*row) {
                add_scaled::<K, S, D>(&mut change, S::from_f64(share), motion);
            }
            let moved = kinematics.strain_rate(&own.arms[stage], &change);
            for q in 0..Self::FORCES {
                inputs[stage * Self::FORCES + q] = turned[q] + moved[q];
            }
        }
    }

    fn hold(point: &mut ProjectedPoint<S, M, K, D>) {
        point.own.previous = point.own.rates;
        point.own.correction = [Vector::zero(); MOST_STAGES];
    }

    fn correct(
        point: &mut ProjectedPoint<S, M, K, D>,
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> S {
        let creeping = rule.sets() * M::DASHPOTS;
        let mut largest = S::zero();
        for unknown in 0..local.unknowns() {
            let change = local.change(&point.solved, unknown);
            let (stage, index) = if unknown < creeping {
                (unknown / M::DASHPOTS, Self::FORCES + unknown % M::DASHPOTS)
            } else {
                (unknown - creeping, Vector::<S, M, K, D>::ENTROPY)
            };
            point.own.correction[stage][index] = point.own.units[index] * change;
            largest = largest.maximum(change.abs());
        }
        largest
    }

    fn apply(point: &mut ProjectedPoint<S, M, K, D>, rule: &Tableau, share: S) {
        let own = &mut point.own;
        for stage in 0..rule.stages() {
            for index in Self::FORCES..Vector::<S, M, K, D>::LEN {
                let change = share * own.correction[stage][index];
                own.rates[stage][index] = own.previous[stage][index] + change;
            }
        }
    }

    fn pull(
        point: &ProjectedPoint<S, M, K, D>,
        _: &Tableau,
        stage: usize,
        _: &StageArms<K, S, D>,
    ) -> K::PerNode<[S; D]> {
        let stress = &point.own.conjugates[stage].strain;
        let arms = &point.own.arms[stage];
        spread::<K, S, D>(&point.kinematics.strain_force(arms, stress))
    }

    fn magnitude(point: &ProjectedPoint<S, M, K, D>, rule: &Tableau, step: S) -> S {
        point.magnitude_of_impulse(rule, step)
    }

    fn close(
        point: &mut ProjectedPoint<S, M, K, D>,
        in_state: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        (view, trial, r1): (&StepView<'_, S>, &Trial<S, D>, &Arms<K, S, D>),
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError> {
        let booked = point.book(in_state, rule, (view, trial), next, tally);
        let near = point.own.temperatures[MOST_POINTS];
        if let Some(entropy) = in_state.settle(r1, view, near, next)? {
            point.book_thermostat(rule, &booked, entropy, next);
        }
        let energy = &mut next.energies[in_state.element.index()];
        energy.terms += point.forces_at_end();
        let magnitude = energy.magnitude;
        point.certify(in_state, rule, (view, trial), (&booked, magnitude), tally);
        Ok(())
    }

    fn recount(
        point: &ProjectedPoint<S, M, K, D>,
        in_state: &StatePoint<S, M, K, D>,
        of_step: (&Tableau, &K::PerNode<u32>),
        ends: [&State<S>; 2],
        recount: &mut Recount<S>,
    ) {
        point.recount_energy(in_state, of_step, ends, recount);
    }
}

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> ProjectedPoint<S, M, K, D> {
    /// Θ of a stage, K; zero without temperature.
    fn mean_temperature(&self, stage: usize) -> S {
        if M::THERMAL {
            self.own.conjugates[stage][Vector::<S, M, K, D>::ENTROPY]
        } else {
            S::zero()
        }
    }

    /// `Σ_j shares_j R_j`.
    fn increments(&self, shares: &[f64]) -> Vector<S, M, K, D> {
        let mut sum = Vector::zero();
        for (rates, &share) in self.own.rates.iter().zip(shares) {
            for index in 0..Vector::<S, M, K, D>::LEN {
                sum[index] += S::from_f64(share) * rates[index];
            }
        }
        sum
    }
}

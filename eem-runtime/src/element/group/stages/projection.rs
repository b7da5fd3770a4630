//! Conjugates that are projections of the derivatives of the energy along the path through a step, TC-cG(k).
//!
//! With the [strain](QuadraticStrain) C, `ê(C, γ, s) = e(π(C), γ, s)` and the polynomials through the increments
//! `R_i = h(Ċ, γ̇, ṡ)_i`,
//!
//! ```text
//! Ċ_i = ∂C/∂d_i·ḋ_i     (N, −G, Θ)_i = a_i = Σ_r projection_ir ∇ê(y(τ_r)) + μ W R_i
//! μ = (Δê − Σ b_i a_i·R_i)/Σ b_i R_i·W R_i
//!
//! F_i = N_i ∂C/∂d_i,   γ̇_i = G_i/η(Θ_i),   Θ_i ṡ_i = Σ η γ̇_i² + Σ κ(Θ_f − Θ)_i
//! ```
//!
//! (Groß & Betsch 2011; `C` as an independent path: Betsch & Steinmann 2001). As Ċ has the degree `2k − 1`, the path of C ends
//! at the strain of d¹; so μ, which vanishes with the error of the quadrature, makes `Σ b_i a_i·R_i` the change of the energy
//! of the element. `Δê` comes from discrete derivatives between the ends, without a difference of energies.
//!
//! The local unknowns are the increments of γ and s at all stages, the inputs those of C and heat.
//!
//! Where a thermostat prescribes the temperature, `θ(τ)` is the polynomial through the prescribed values, and the path is one of
//! `(C, γ)` at these temperatures:
//!
//! ```text
//! (N, −G)_i = Σ_r projection_ir ∇ψ(C, γ, θ)(τ_r) + μ W R_i     Θ_i = θ(c_i)     μ = (Δê − Σ b_i a_i·R_i)/(Σ b_i R_i·W R_i + w)
//! w = Σ b_i (hθ̇)_i² c/θ        heat = Σ b_i Θ_i R_s,i + μ w
//! ```
//!
//! At a constant temperature w vanishes: the work of N and G is then `Δψ`, and the heat `θ Δs`. Where nothing moves, the heat is
//! `Δê`.

mod closing;
mod exact;
mod kelvin_voigt;
mod local;
mod path;
mod rounding;
mod vector;

use super::point::{LocalStages, StageArms, StagePoint, StatePoint, heat_received};
use super::site::PerPair;
use super::source::Source;
use crate::element::conjugates::Any;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, spread};
use crate::element::group::view::{StepView, Trial};
use crate::element::group::ways::StageWays;
use crate::element::kinematics::{Arms, Blocks, PerStrain, QuadraticStrain};
use crate::element::state::State;
use crate::element::tableau::{MOST_POINTS, MOST_SETS, MOST_STAGES};
use crate::element::tally::{Reevaluation, Tally};
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::Scalar;
use vector::{Matrix, Vector, derivatives, steepness};

/// A point with its path through a step, and the projections from it.
pub(crate) struct Projections<M: FreeEnergy<f64>, K: QuadraticStrain<D>, const D: usize> {
    point: StagePoint<K, D>,
    /// `y⁰ = (C, γ…, s)`, and the data of `(π, γ, θ)⁰` for the discrete derivatives.
    old: Vector<M, K, D>,
    old_form: M::TemperatureFormOld,
    /// The units of the increments of γ and s: that of viscous stretches, the old heat capacity.
    units: Vector<M, K, D>,
    /// The diagonal of W.
    metric: Vector<M, K, D>,
    /// R: the increments h ẏ at the stages.
    rates: [Vector<M, K, D>; MOST_STAGES],
    /// R before the last correction, and the correction, both without C.
    previous: [Vector<M, K, D>; MOST_STAGES],
    correction: [Vector<M, K, D>; MOST_STAGES],
    /// The temperatures of the points of the path, and that of its end, K; constant in a step if they are prescribed.
    temperatures: [f64; MOST_POINTS + 1],
    /// w, of prescribed temperatures, and μ w, J.
    warming: f64,
    heat_beyond: f64,
    /// y¹, and `∇ê` and the magnitudes of the terms of C at both ends.
    end: Vector<M, K, D>,
    end_slopes: [Vector<M, K, D>; 2],
    end_sizes: [PerStrain<K, D>; 2],
    /// a.
    conjugates: [Vector<M, K, D>; MOST_STAGES],
    /// `∂a_i/∂R_j`.
    by_rates: Box<PerPair<Matrix<M, K, D>>>,
    /// `Σ_r |projection_ir| Σ_y |∂²ê/∂x∂y| |y|`: times ε, the conditioning error of the conjugates.
    conditioning: [Vector<M, K, D>; MOST_STAGES],
    /// `|∂²ψ/∂γ_k²|` in the old state, N/m.
    stiffness: M::Viscosities,
    /// `η_k` and `dη_k/dθ` at `Θ_i`.
    viscosities: [(M::Viscosities, M::Viscosities); MOST_STAGES],
    /// The heat `f ν` of the Kelvin–Voigt dashpot at the stages, J, and its derivatives with respect to the temperature
    /// and, at constant temperature, to the increments of C.
    viscous_heat: [f64; MOST_STAGES],
    heat_by_theta: [f64; MOST_STAGES],
    heat_by_strain: PerPair<PerStrain<K, D>>,
    /// Heat from other elements at the stages, W.
    received: [f64; MOST_STAGES],
    /// `d_i` and `h ḋ_i`, m.
    arms: [Arms<K, D>; MOST_STAGES],
    motions: [Arms<K, D>; MOST_STAGES],
}

/// The directions of the components of the strain at the stages: `∂C_q/∂d_i`, and the same for `h ḋ_i`.
pub(crate) struct Directions<K: QuadraticStrain<D>, const D: usize> {
    along: [K::PerStrain<Arms<K, D>>; MOST_STAGES],
    turning: [K::PerStrain<Arms<K, D>>; MOST_STAGES],
}

impl<M: Material, K: QuadraticStrain<D>, const D: usize> Source<M, K, D> for Projections<M, K, D> {
    const FORCES: usize = Vector::<M, K, D>::STRAINS;

    type Bases = Directions<K, D>;

    fn new(point: StagePoint<K, D>) -> Self {
        let (none, zeros) = (0.0, Vector::zero());
        let viscosities = M::Viscosities::filled(none);
        let strain = PerStrain::<K, D>::filled(none);
        let nowhere = Arms::<K, D>::filled([none; D]);
        Self {
            point,
            old: zeros,
            old_form: M::TemperatureFormOld::filled(none),
            units: zeros,
            metric: zeros,
            rates: [zeros; MOST_STAGES],
            previous: [zeros; MOST_STAGES],
            correction: [zeros; MOST_STAGES],
            temperatures: [none; MOST_POINTS + 1],
            warming: none,
            heat_beyond: none,
            end: zeros,
            end_slopes: [zeros; 2],
            end_sizes: [strain; 2],
            conjugates: [zeros; MOST_STAGES],
            by_rates: Box::new([[Matrix::zero(); MOST_SETS]; MOST_SETS]),
            conditioning: [zeros; MOST_STAGES],
            stiffness: viscosities,
            viscosities: [(viscosities, viscosities); MOST_STAGES],
            viscous_heat: [none; MOST_STAGES],
            heat_by_theta: [none; MOST_STAGES],
            heat_by_strain: [[strain; MOST_SETS]; MOST_SETS],
            received: [none; MOST_STAGES],
            arms: [nowhere; MOST_STAGES],
            motions: [nowhere; MOST_STAGES],
        }
    }

    fn point(&self) -> &StagePoint<K, D> {
        &self.point
    }

    fn point_mut(&mut self) -> &mut StagePoint<K, D> {
        &mut self.point
    }

    fn begin(&mut self, in_state: &StatePoint<M, K, D>, x0: &M::Variables, r0: &Arms<K, D>) {
        let (kinematics, last) = (&self.point.kinematics, M::Variables::LEN - 1);
        let (gradient, hessian) = in_state.model.hessian(x0);
        self.old_form = in_state.model.temperature_form_old(x0);
        (self.old.rest, self.old.strain) = (*x0, kinematics.strain(r0));
        for k in 0..self.point.dashpots {
            let row = M::MEASURES + k;
            self.stiffness[k] = hessian[row][row].abs();
        }
        let strain = &self.old.strain;
        let of_model = (x0, &gradient, &hessian);
        let (slopes, curvatures) = derivatives(kinematics, strain, of_model, self.is_held());
        self.end_slopes[0] = slopes;
        self.end_sizes[0] = kinematics.strain_sizes(strain);
        let strains = 0..Self::STRAINS;
        let (counts, unit) = kinematics.strain_metric(strain);
        let derivatives = (&slopes, &curvatures);
        let of_strain = steepness(derivatives, strains.clone(), |q| counts[q], unit);
        for q in strains.clone() {
            self.metric[q] = counts[q] * of_strain;
        }
        let entropy = Self::ENTROPY;
        let components = entropy - M::VISCOUS_STRAIN..entropy;
        for index in strains.end..components.start {
            let unit = self.point.viscous_unit;
            self.units[index] = unit;
            self.metric[index] = steepness(derivatives, index..index + 1, |_| 1.0, unit);
        }
        // Components of a tensor count alike, whatever the axes are.
        let of_components = steepness(derivatives, components.clone(), |_| 1.0, 1.0);
        for index in components {
            self.units[index] = self.point.viscous_unit;
            self.metric[index] = of_components;
        }
        if M::THERMAL {
            let theta = x0[last];
            self.old[entropy] = self.point.entropy;
            self.units[entropy] = -theta * hessian[last][last];
            self.metric[entropy] = curvatures.at([entropy, entropy]);
            self.temperatures = [theta; MOST_POINTS + 1];
            self.warming = 0.0;
            if let Some(prescribed) = self.point.prescribed {
                let course = self.point.rule.course(theta, &prescribed);
                if let Some((temperatures, squares)) = course {
                    self.temperatures = temperatures;
                    self.warming = -hessian[last][last] * squares;
                }
            }
        }
        self.rates = [Vector::zero(); MOST_STAGES];
    }

    fn evaluate(
        &mut self,
        in_state: &mut StatePoint<M, K, D>,
        (view, trial): (&StepView<'_>, &Trial<D>),
        arms: &StageArms<K, D>,
    ) -> Result<(), StateError> {
        if let Some(slot) = in_state.slots().thermal {
            let rule = self.point.rule;
            for (stage, received) in self.received.iter_mut().enumerate().take(rule.stages()) {
                *received = heat_received(rule, stage, slot, (view, trial));
            }
        }
        self.move_along(in_state, arms)?;
        self.project(in_state)?;
        let end = self.reach_end(in_state)?;
        self.make_exact(&end);
        self.find_viscosities(in_state)?;
        self.add_kelvin_voigt(in_state, view.per_step)
    }

    // All in J; the unknowns are in their units.
    fn write_equations(
        &mut self,
        in_state: &StatePoint<M, K, D>,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError> {
        let stages = 0..self.point.rule.stages();
        for stage in stages.clone() {
            for k in 0..self.point.dashpots {
                self.write_creep(local, [stage, k], view.per_step);
            }
        }
        let Some(slot) = in_state.slots().thermal else {
            return Ok(());
        };
        if let Some(prescribed) = self.point.prescribed {
            return self.prescribe(in_state, local, &prescribed);
        }
        for stage in stages {
            let theta = self.mean_temperature(stage);
            let flow = view.conduction.reservoir_flow(slot, theta);
            let heat = flow.heat + self.received[stage];
            let has_drag = in_state.drags() > 0;
            self.write_heat(local, stage, (view, [heat, flow.conductance]), has_drag);
        }
        Ok(())
    }

    fn force(&self, local: &mut LocalStages, [stage, component]: [usize; 2]) -> f64 {
        self.differentiate(local, [stage, component]);
        self.point.eliminate(local);
        self.conjugates[stage][component]
    }

    fn bases(&self) -> Directions<K, D> {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        let none = [K::PerStrain::filled(nowhere); MOST_STAGES];
        let (mut along, mut turning) = (none, none);
        for stage in 0..self.point.rule.stages() {
            for component in 0..Self::FORCES {
                let mut unit = PerStrain::<K, D>::filled(0.0);
                unit[component] = 1.0;
                let force = |arms| self.point.kinematics.strain_force(arms, &unit);
                along[stage][component] = force(&self.arms[stage]);
                turning[stage][component] = force(&self.motions[stage]);
            }
        }
        Directions { along, turning }
    }

    fn direction<'a>(
        &'a self,
        bases: &'a Directions<K, D>,
        [stage, component]: [usize; 2],
    ) -> &'a Arms<K, D> {
        &bases.along[stage].as_ref()[component]
    }

    fn geometric_stiffness(&self, set: usize, _: &StageArms<K, D>) -> Blocks<K, D> {
        let mut blocks = Blocks::<K, D>::filled(K::PerArm::filled([[0.0; D]; D]));
        let stress = &self.conjugates[set].strain;
        let weights = self.point.kinematics.strain_stiffness(stress);
        for (row, weights) in blocks.as_mut().iter_mut().zip(weights.as_ref()) {
            for (block, &weight) in row.as_mut().iter_mut().zip(weights.as_ref()) {
                for (axis, row) in block.iter_mut().enumerate() {
                    row[axis] = weight;
                }
            }
        }
        blocks
    }

    fn temperature(&self, local: &mut LocalStages, set: usize) -> f64 {
        self.differentiate(local, [set, Self::ENTROPY]);
        self.point.eliminate(local);
        self.mean_temperature(set)
    }

    // ∂(hĊ_i)/∂d_j = δ_ij ∂²C/∂d² h ḋ_i + motion_ij ∂C/∂d_i
    fn by_arms(&self, bases: &Directions<K, D>, local: &LocalStages) -> [Arms<K, D>; MOST_SETS] {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        let mut by_arms = [nowhere; MOST_SETS];
        for (stage, row) in self.point.rule.motion.iter().enumerate() {
            let mut along = nowhere;
            let rows = bases.along[stage].as_ref().iter();
            let rows = rows.zip(bases.turning[stage].as_ref());
            for ((own, turning), &by) in rows.zip(&local.row[1 + stage * Self::FORCES..]) {
                add_scaled::<K, D>(&mut along, by, own);
                add_scaled::<K, D>(&mut by_arms[stage], by, turning);
            }
            for (sum, &share) in by_arms.iter_mut().zip(*row) {
                add_scaled::<K, D>(sum, share, &along);
            }
        }
        by_arms
    }

    fn inputs(&self, motions: &[Arms<K, D>; MOST_SETS], inputs: &mut [f64]) {
        let kinematics = &self.point.kinematics;
        for (stage, row) in self.point.rule.motion.iter().enumerate() {
            let turned = kinematics.strain_rate(&self.motions[stage], &motions[stage]);
            let change = combined::<K, D>(row, motions);
            let moved = kinematics.strain_rate(&self.arms[stage], &change);
            for q in 0..Self::FORCES {
                inputs[stage * Self::FORCES + q] = turned[q] + moved[q];
            }
        }
    }

    fn hold(&mut self) {
        self.previous = self.rates;
        self.correction = [Vector::zero(); MOST_STAGES];
    }

    fn correct(&mut self, local: &LocalStages) -> f64 {
        let entropies = self.point.rule.sets() * self.point.dashpots;
        let mut largest = 0.0;
        for unknown in 0..local.unknowns() {
            let change = local.change(&self.point.solved, unknown);
            let (stage, index) = if unknown < entropies {
                (
                    unknown / self.point.dashpots,
                    Self::FORCES + unknown % self.point.dashpots,
                )
            } else {
                (unknown - entropies, Self::ENTROPY)
            };
            self.correction[stage][index] = self.units[index] * change;
            largest = Scalar::maximum(largest, change.abs());
        }
        largest
    }

    fn apply(&mut self, fraction: f64) {
        for stage in 0..self.point.rule.stages() {
            for index in Self::FORCES..Self::LEN {
                let change = fraction * self.correction[stage][index];
                self.rates[stage][index] = self.previous[stage][index] + change;
            }
        }
    }

    fn nodal_force(&self, stage: usize, _: &StageArms<K, D>) -> K::PerNode<[f64; D]> {
        let (kinematics, stress) = (&self.point.kinematics, &self.conjugates[stage].strain);
        spread::<K, D>(&kinematics.strain_force(&self.arms[stage], stress))
    }

    fn impulse_size(&mut self, in_state: &StatePoint<M, K, D>, step: f64) -> f64 {
        self.add_conditioning_of_path(in_state);
        let known =
            |stage: usize, q: usize| self.conjugates[stage][q].abs() + self.conditioning[stage][q];
        let stages = 0..self.point.rule.stages();
        let forces = stages.map(|stage| self.force_size(&self.arms[stage], |q| known(stage, q)));
        step * forces.fold(0.0, Scalar::maximum)
    }

    fn work_along(&self, ways: &StageWays, new_arms: &Arms<K, D>) -> f64 {
        self.work_of_rounding(ways, new_arms)
    }

    fn close(
        &mut self,
        in_state: &mut StatePoint<M, K, D>,
        (view, trial, r1): (&StepView<'_>, &Trial<D>, &Arms<K, D>),
        next: &mut State,
        tally: &mut Tally,
    ) -> Result<(), StateError> {
        let booked = self.book(in_state, (view, trial), next, tally);
        let near = self.temperatures[MOST_POINTS];
        let measures = in_state.admissible_measures(r1)?;
        if let Some(entropy) =
            in_state.recover_temperature::<Any>(&measures, view, (near, None), next)?
        {
            self.book_thermostat(&booked, entropy, next);
        }
        let energy = &mut next.energies[in_state.element.index()];
        energy.terms += self.forces_at_end();
        let magnitude = energy.magnitude;
        self.certify(in_state, (view, trial), (&booked, magnitude), tally);
        Ok(())
    }

    fn reevaluate(
        &self,
        in_state: &StatePoint<M, K, D>,
        nodes: &K::PerNode<u32>,
        ends: [&State; 2],
        reevaluation: &mut Reevaluation,
    ) {
        let own = in_state.balance_between(nodes, ends);
        let mut found = 0.0;
        for (stage, &weight) in self.point.rule.weights.iter().enumerate() {
            let work = self.conjugates[stage].dot(&self.rates[stage]);
            found += weight * (work - self.viscous_heat[stage]);
        }
        found += self.heat_beyond;
        reevaluation.element(in_state.element, own.by_values, own.by_differences, found);
    }
}

impl<M: Material, K: QuadraticStrain<D>, const D: usize> Projections<M, K, D> {
    /// Number of variables y, of components of the strain among them, and the index of the entropy.
    const LEN: usize = Vector::<M, K, D>::LEN;
    const STRAINS: usize = Vector::<M, K, D>::STRAINS;
    const ENTROPY: usize = Vector::<M, K, D>::ENTROPY;

    /// Whether a thermostat prescribes its temperature.
    fn is_held(&self) -> bool {
        self.point.prescribed.is_some()
    }

    /// Θ of a stage, K; zero without temperature.
    fn mean_temperature(&self, stage: usize) -> f64 {
        if M::THERMAL {
            self.conjugates[stage][Self::ENTROPY]
        } else {
            0.0
        }
    }

    /// `Σ_j shares_j R_j`.
    fn increments(&self, shares: &[f64]) -> Vector<M, K, D> {
        let mut sum = Vector::zero();
        for (rates, &share) in self.rates.iter().zip(shares) {
            for index in 0..Self::LEN {
                sum[index] += share * rates[index];
            }
        }
        sum
    }

    /// `y = (C, γ, s)` at the point of the path after these fractions of the increments.
    fn path_at(&self, shares: &[f64]) -> Vector<M, K, D> {
        let mut y = self.increments(shares);
        for index in 0..Self::LEN {
            y[index] += self.old[index];
        }
        y
    }
}

/// `Σ_j shares_j arms_j`.
fn combined<K: QuadraticStrain<D>, const D: usize>(
    shares: &[f64],
    arms: &[Arms<K, D>],
) -> Arms<K, D> {
    let mut sum = Arms::<K, D>::filled([0.0; D]);
    for (arms, &share) in arms.iter().zip(shares) {
        add_scaled::<K, D>(&mut sum, share, arms);
    }
    sum
}

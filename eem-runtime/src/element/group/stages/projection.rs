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
pub(in crate::element::group) mod path;
mod rounding;
mod vector;

use super::geometry::{At, AtMut, Geometry};
use super::models::{PathModels, StrainOf};
use super::point::{LocalStages, StageArms};
use crate::element::conduction::InterfaceTemperatures;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, spread};
use crate::element::group::placed::admissible;
use crate::element::group::view::StepView;
use crate::element::group::ways::StageWays;
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Blocks, Measures, QuadraticStrain, StrainMeasures};
use crate::element::tableau::{MOST_SETS, MOST_STAGES, Tableau};
use crate::element::tally::Tally;
use eem_material::free_energy::Array;
use eem_material::number::scalar::Scalar;

/// A point among its nodes on its path through a step.
pub(crate) struct Projections<K: QuadraticStrain<D>, const D: usize> {
    rule: &'static Tableau,
    kinematics: K,
    /// `d_i` and `h ḋ_i`, m.
    arms: [Arms<K, D>; MOST_STAGES],
    motions: [Arms<K, D>; MOST_STAGES],
}

/// The directions of the components of the strain at the stages: `∂C_q/∂d_i`, and the same for `h ḋ_i`.
pub(crate) struct Directions<K: QuadraticStrain<D>, const D: usize> {
    along: [PerComponent<K, Arms<K, D>, D>; MOST_STAGES],
    turning: [PerComponent<K, Arms<K, D>, D>; MOST_STAGES],
}

/// `[T; number of components of the strain]`.
type PerComponent<K, T, const D: usize> =
    <<K as QuadraticStrain<D>>::Strain as StrainMeasures>::PerStrain<T>;

impl<K: QuadraticStrain<D>, const D: usize> Geometry<K, D> for Projections<K, D> {
    type Models = dyn PathModels<K::Strain>;

    type Bases = Directions<K, D>;

    const FORCES: usize = StrainOf::<K, D>::LEN;

    fn new(rule: &'static Tableau, kinematics: K) -> Self {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        Self {
            rule,
            kinematics,
            arms: [nowhere; MOST_STAGES],
            motions: [nowhere; MOST_STAGES],
        }
    }

    fn kinematics(&self) -> &K {
        &self.kinematics
    }

    fn begin(
        &mut self,
        (models, place): AtMut<'_, Self::Models>,
        (r0, measures): (&Arms<K, D>, &Measures<K, D>),
        view: &StepView<'_>,
    ) {
        let strain = self.kinematics.strain(r0);
        models.begin(place, (measures, strain.as_ref()), view);
    }

    fn evaluate(
        &mut self,
        (models, place): AtMut<'_, Self::Models>,
        element: Element,
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
        arms: &StageArms<K, D>,
    ) -> Result<(), StateError> {
        let kinematics = &self.kinematics;
        let mut strain_rates = [StrainOf::<K, D>::filled(0.0); MOST_STAGES];
        for (stage, row) in self.rule.motion.iter().enumerate() {
            let r = arms.of_set(stage);
            admissible(kinematics, element, &r)?;
            let motion = combined::<K, D>(row, &arms.changes);
            strain_rates[stage] = kinematics.strain_rate(&r, &motion);
            (self.arms[stage], self.motions[stage]) = (r, motion);
        }
        models.evaluate(place, &strain_rates, view_and_interface)
    }

    fn bases(&self) -> Directions<K, D> {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        let none = [PerComponent::<K, _, D>::filled(nowhere); MOST_STAGES];
        let (mut along, mut turning) = (none, none);
        for stage in 0..self.rule.stages() {
            for component in 0..Self::FORCES {
                let mut unit = StrainOf::<K, D>::filled(0.0);
                unit[component] = 1.0;
                let force = |arms| self.kinematics.strain_force(arms, &unit);
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

    fn geometric_stiffness(
        &self,
        (models, place): At<'_, Self::Models>,
        set: usize,
        _: &StageArms<K, D>,
    ) -> Blocks<K, D> {
        let mut blocks = Blocks::<K, D>::filled(K::PerArm::filled([[0.0; D]; D]));
        let weights = self.kinematics.strain_stiffness(&models.stress(place, set));
        for (row, weights) in blocks.as_mut().iter_mut().zip(weights.as_ref()) {
            for (block, &weight) in row.as_mut().iter_mut().zip(weights.as_ref()) {
                for (axis, row) in block.iter_mut().enumerate() {
                    row[axis] = weight;
                }
            }
        }
        blocks
    }

    // ∂(hĊ_i)/∂d_j = δ_ij ∂²C/∂d² h ḋ_i + motion_ij ∂C/∂d_i
    fn by_arms(&self, bases: &Directions<K, D>, local: &LocalStages) -> [Arms<K, D>; MOST_SETS] {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        let mut by_arms = [nowhere; MOST_SETS];
        for (stage, row) in self.rule.motion.iter().enumerate() {
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
        let kinematics = &self.kinematics;
        for (stage, row) in self.rule.motion.iter().enumerate() {
            let turned = kinematics.strain_rate(&self.motions[stage], &motions[stage]);
            let change = combined::<K, D>(row, motions);
            let moved = kinematics.strain_rate(&self.arms[stage], &change);
            for q in 0..Self::FORCES {
                inputs[stage * Self::FORCES + q] = turned[q] + moved[q];
            }
        }
    }

    fn nodal_force(
        &self,
        (models, place): At<'_, Self::Models>,
        stage: usize,
        _: &StageArms<K, D>,
    ) -> K::PerNode<[f64; D]> {
        let stress = models.stress(place, stage);
        spread::<K, D>(&self.kinematics.strain_force(&self.arms[stage], &stress))
    }

    fn impulse_size(&self, (models, place): AtMut<'_, Self::Models>, step: f64) -> f64 {
        let sizes = models.conditioned_stress(place);
        let stages = sizes.iter().zip(&self.arms).take(self.rule.stages());
        let forces = stages.map(|(sizes, arms)| self.force_size(arms, sizes));
        step * forces.fold(0.0, Scalar::maximum)
    }

    /// ```text
    /// Σ_j b_j (|F_j| Σ |h q̇_j| + |∇ê¹ ∂C/∂d_j| |h ḋ_j|) + |F¹| times the way of the end
    /// ```
    ///
    /// with the terms of `R_j = ∂C/∂d_j·h ḋ_j`, by which the path misses the new arms.
    #[cold]
    fn work_along(
        &self,
        (models, place): At<'_, Self::Models>,
        ways: &StageWays,
        new_arms: &Arms<K, D>,
    ) -> f64 {
        let end = models.stress_at_end(place);
        let mut work = self.force_size(new_arms, &end) * ways.of_end;
        for (stage, &weight) in self.rule.weights.iter().enumerate() {
            let arms = &self.arms[stage];
            let force = self.force_size(arms, &models.stress(place, stage));
            let motion = self.motions[stage].as_ref().as_flattened().iter();
            let motion = motion.fold(0.0, |sum, x| sum + x.abs());
            work += weight * (force * ways.at_stages[stage] + self.force_size(arms, &end) * motion);
        }
        work
    }

    /// h Σ b |F|, each F limited by those at the ends: the rounding of larger forces, which cancel, is an error.
    fn see_impulse(&self, (models, place): At<'_, Self::Models>, step: f64, tally: &mut Tally) {
        let impulse = self.rule.weights.iter().enumerate();
        let impulse = impulse.fold(0.0, |sum, (stage, &weight)| {
            let sizes = models.limited_stress(place, stage);
            sum + step * weight * self.force_size(&self.arms[stage], &sizes)
        });
        tally.exchange(impulse);
    }
}

impl<K: QuadraticStrain<D>, const D: usize> Projections<K, D> {
    /// The magnitude of the terms of the force on the nodes with these arms, given conjugates of the strain, N.
    fn force_size(&self, arms: &Arms<K, D>, conjugates: &StrainOf<K, D>) -> f64 {
        let mut sizes = *conjugates;
        for size in sizes.as_mut() {
            *size = size.abs();
        }
        self.kinematics.strain_force_size(arms, &sizes)
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

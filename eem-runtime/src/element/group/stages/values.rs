//! Conjugates that are values of the free energy at the stages.
//!
//! ```text
//! r_γi = γ_i − γ⁰ − h Σ_j a_ij γ̇_j                              for every dashpot and set
//! r_sk = Σ_i e_ki s_i − e_k s⁰ − h Σ_i w_ki Φ_i                  for every set
//! ```
//!
//! with the numbers of the [`Tableau`](crate::element::tableau::Tableau) are the local equations of `u = (γ…, Θ)` of all
//! sets; their inputs are `y = (π…, Q…)`.

mod at_stage;
mod local;

use super::point::{LocalStages, Outside, StageArms, StagePoint, StatePoint};
use super::source::Source;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, along, measures_in, resultant};
use crate::element::group::closing::pull;
use crate::element::group::view::StepView;
use crate::element::kinematics::{Arms, Blocks, Ends, Gradient, Kinematics, Weights};
use crate::element::state::State;
use crate::element::tableau::{Ending, MOST_SETS, MOST_STAGES};
use crate::element::tally::Tally;
use eem_material::free_energy::{Array, FreeEnergy, Material};
use local::StageValues;

/// A point among its nodes with its variables and the model at the stages.
pub(crate) struct Values<M: FreeEnergy<f64>, K: Kinematics<D>, const D: usize> {
    kinematics: K,
    equations: StageValues<M>,
    /// `∂π/∂r`.
    gradients: [Gradient<K, D>; MOST_STAGES],
}

impl<M: Material, K: Kinematics<D>, const D: usize> Source<M, K, D> for Values<M, K, D> {
    type Equations = StageValues<M>;

    type Bases = ();

    fn new(kinematics: K, point: StagePoint) -> Self {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        Self {
            kinematics,
            equations: StageValues::new(point),
            gradients: [Gradient::<K, D>::filled(nowhere); MOST_STAGES],
        }
    }

    fn equations(&self) -> &StageValues<M> {
        &self.equations
    }

    fn equations_mut(&mut self) -> &mut StageValues<M> {
        &mut self.equations
    }

    fn begin(&mut self, _: &StatePoint<M, K, D>, x0: &M::Variables, r0: &Arms<K, D>) {
        let gradient = (self.kinematics).gradient(r0, &measures_in::<K::Measures>(x0));
        self.gradients = [gradient; MOST_STAGES];
        self.equations.begin(x0);
    }

    fn evaluate(
        &mut self,
        in_state: &mut StatePoint<M, K, D>,
        (view, interface): (&StepView<'_>, &InterfaceTemperatures),
        arms: &StageArms<K, D>,
    ) -> Result<(), StateError> {
        let (rule, kinematics) = (self.equations.point.rule, self.kinematics);
        for stage in 0..rule.stages() {
            // The measures of a known stage are those of the old state.
            if let Some(set) = rule.set_of(stage) {
                let r = arms.of_set(set);
                let measures = in_state.admissible_measures(&r)?;
                self.gradients[stage] = kinematics.gradient(&r, &measures);
                self.equations.set_measures(stage, measures.as_ref());
            }
            self.equations
                .evaluate(&mut in_state.point, stage, (view, interface))?;
        }
        Ok(())
    }

    fn bases(&self) {}

    fn direction<'a>(&'a self, (): &'a (), [stage, measure]: [usize; 2]) -> &'a Arms<K, D> {
        &self.gradients[stage].as_ref()[measure]
    }

    fn geometric_stiffness(&self, set: usize, arms: &StageArms<K, D>) -> Blocks<K, D> {
        let stage = self.equations.point.rule.stage_of(set);
        let [measures, forces] = self.equations.measures_and_forces::<K::Measures>(stage);
        let r = arms.of_set(set);
        self.kinematics.curvature(&r, &measures, &forces)
    }

    fn by_arms(&self, (): &(), local: &LocalStages) -> [Arms<K, D>; MOST_SETS] {
        let rule = self.equations.point.rule;
        let measures = local.row[1..].chunks_exact(M::MEASURES);
        let mut by_arm = [Arms::<K, D>::filled([0.0; D]); MOST_SETS];
        let sets = by_arm.iter_mut().take(rule.sets()).zip(measures);
        for (set, (sum, measures)) in sets.enumerate() {
            let rows = self.gradients[rule.stage_of(set)].as_ref().iter();
            for (row, &by) in rows.zip(measures) {
                add_scaled::<K, D>(sum, by, row);
            }
        }
        by_arm
    }

    fn inputs(&self, motions: &[Arms<K, D>; MOST_SETS], inputs: &mut [f64]) {
        for (set, measures) in inputs.chunks_exact_mut(M::MEASURES).enumerate() {
            let rows = self.gradients[self.equations.point.rule.stage_of(set)].as_ref();
            for (input, row) in measures.iter_mut().zip(rows) {
                *input = along::<K, D>(row, &motions[set]);
            }
        }
    }

    /// With the forces of the last evaluation, along the directions at the trial.
    fn nodal_force(&self, stage: usize, arms: &StageArms<K, D>) -> K::PerNode<[f64; D]> {
        let (rule, kinematics) = (self.equations.point.rule, &self.kinematics);
        let set = rule.set_of(stage);
        let r = set.map_or(arms.old, |set| arms.of_set(set));
        let depends_on_itself = set.is_some_and(|set| rule.positions[set][stage] != 0.0);
        if depends_on_itself && matches!(rule.ending, Ending::StageByStage) {
            return pull::<K, D>(&self.secant(stage), &r);
        }
        let gradient = kinematics.gradient(&r, &kinematics.measure(&r));
        let [_, forces] = self.equations.measures_and_forces::<K::Measures>(stage);
        resultant::<K, D>(&gradient, &forces)
    }

    fn secant(&self, stage: usize) -> Weights<K, D> {
        let [measures, forces] = self.equations.measures_and_forces::<K::Measures>(stage);
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        // At rest in the stage; the secant of an element with one point does not depend on the arms.
        let ends = Ends::new(&self.kinematics, [nowhere; 2], [measures; 2]);
        self.kinematics.secant(&ends, &forces)
    }

    fn close(
        &mut self,
        in_state: &mut StatePoint<M, K, D>,
        r1: &Arms<K, D>,
        (view, _): (&StepView<'_>, Outside<'_>),
        (next, _): (&mut State, &mut Tally),
    ) -> Result<(), StateError> {
        let measures = in_state.admissible_measures(r1)?;
        self.equations
            .close(&mut in_state.point, &measures, view, next)
    }
}

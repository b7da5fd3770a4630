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
pub(in crate::element::group) mod local;

use super::geometry::{At, AtMut, Geometry};
use super::models::ValueModels;
use super::point::{LocalStages, StageArms};
use crate::element::conduction::InterfaceTemperatures;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, along, resultant};
use crate::element::group::closing::pull;
use crate::element::group::placed::admissible;
use crate::element::group::view::StepView;
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Blocks, Ends, Gradient, Kinematics, Measures, Weights};
use crate::element::tableau::{Ending, MOST_SETS, MOST_STAGES, Tableau};
use eem_material::free_energy::Array;

/// A point among its nodes at the stages.
pub(crate) struct Values<K: Kinematics<D>, const D: usize> {
    rule: &'static Tableau,
    kinematics: K,
    /// `∂π/∂r`.
    gradients: [Gradient<K, D>; MOST_STAGES],
}

impl<K: Kinematics<D>, const D: usize> Geometry<K, D> for Values<K, D> {
    type Models = dyn ValueModels<K::Measures>;

    type Bases = ();

    const FORCES: usize = Measures::<K, D>::LEN;

    fn new(rule: &'static Tableau, kinematics: K) -> Self {
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        Self {
            rule,
            kinematics,
            gradients: [Gradient::<K, D>::filled(nowhere); MOST_STAGES],
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
        self.gradients = [self.kinematics.gradient(r0, measures); MOST_STAGES];
        models.begin(place, (measures, &[]), view);
    }

    fn evaluate(
        &mut self,
        (models, place): AtMut<'_, Self::Models>,
        element: Element,
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
        arms: &StageArms<K, D>,
    ) -> Result<(), StateError> {
        for stage in 0..self.rule.stages() {
            // The measures of a known stage are those of the old state.
            let mut measures = None;
            if let Some(set) = self.rule.set_of(stage) {
                let r = arms.of_set(set);
                let found = admissible(&self.kinematics, element, &r)?;
                self.gradients[stage] = self.kinematics.gradient(&r, &found);
                measures = Some(found);
            }
            models.evaluate(place, (stage, measures.as_ref()), view_and_interface)?;
        }
        Ok(())
    }

    fn bases(&self) {}

    fn direction<'a>(&'a self, (): &'a (), [stage, measure]: [usize; 2]) -> &'a Arms<K, D> {
        &self.gradients[stage].as_ref()[measure]
    }

    fn geometric_stiffness(
        &self,
        (models, place): At<'_, Self::Models>,
        set: usize,
        arms: &StageArms<K, D>,
    ) -> Blocks<K, D> {
        let stage = self.rule.stage_of(set);
        let [measures, forces] = models.measures_and_forces(place, stage);
        let r = arms.of_set(set);
        self.kinematics.curvature(&r, &measures, &forces)
    }

    fn by_arms(&self, (): &(), local: &LocalStages) -> [Arms<K, D>; MOST_SETS] {
        let rule = self.rule;
        let measures = local.row[1..].chunks_exact(Self::FORCES);
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
        for (set, measures) in inputs.chunks_exact_mut(Self::FORCES).enumerate() {
            let rows = self.gradients[self.rule.stage_of(set)].as_ref();
            for (input, row) in measures.iter_mut().zip(rows) {
                *input = along::<K, D>(row, &motions[set]);
            }
        }
    }

    /// With the forces of the last evaluation, along the directions at the trial.
    fn nodal_force(
        &self,
        (models, place): At<'_, Self::Models>,
        stage: usize,
        arms: &StageArms<K, D>,
    ) -> K::PerNode<[f64; D]> {
        let (rule, kinematics) = (self.rule, &self.kinematics);
        let set = rule.set_of(stage);
        let r = set.map_or(arms.old, |set| arms.of_set(set));
        let depends_on_itself = set.is_some_and(|set| rule.positions[set][stage] != 0.0);
        if depends_on_itself && matches!(rule.ending, Ending::StageByStage) {
            return pull::<K, D>(&self.secant((models, place), stage), &r);
        }
        let gradient = kinematics.gradient(&r, &kinematics.measure(&r));
        let [_, forces] = models.measures_and_forces(place, stage);
        resultant::<K, D>(&gradient, &forces)
    }

    fn secant(&self, (models, place): At<'_, Self::Models>, stage: usize) -> Weights<K, D> {
        let [measures, forces] = models.measures_and_forces(place, stage);
        let nowhere = Arms::<K, D>::filled([0.0; D]);
        // At rest in the stage; the secant of an element with one point does not depend on the arms.
        let ends = Ends::new(&self.kinematics, [nowhere; 2], [measures; 2]);
        self.kinematics.secant(&ends, &forces)
    }
}

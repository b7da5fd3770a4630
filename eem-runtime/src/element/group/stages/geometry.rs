//! The nodes of a point at the stages.

use super::models::StageModels;
use super::point::{LocalStages, StageArms};
use crate::element::conduction::InterfaceTemperatures;
use crate::element::error::StateError;
use crate::element::group::view::StepView;
use crate::element::group::ways::StageWays;
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Blocks, Kinematics, Measures, Weights};
use crate::element::tableau::{MOST_SETS, Tableau};
use crate::element::tally::Tally;
use eem_material::free_energy::Array;

/// The models of a group, and the index of a point among them.
pub(crate) type At<'a, S> = (&'a S, usize);

/// The same, mutable.
pub(crate) type AtMut<'a, S> = (&'a mut S, usize);

/// What turns the forces of a point at the stages into forces on its nodes, and positions into what its model needs.
pub(crate) trait Geometry<K: Kinematics<D>, const D: usize>:
    Sized + Send + Sync + 'static
{
    /// The models of all points.
    type Models: StageModels<K::Measures> + ?Sized + 'static;

    /// The common part of [`direction`](Self::direction) and [`by_arms`](Self::by_arms).
    type Bases;

    /// Number of forces of a stage.
    const FORCES: usize;

    fn new(rule: &'static Tableau, kinematics: K) -> Self;

    fn kinematics(&self) -> &K;

    /// Starts the trial at the old arms, which have these measures.
    fn begin(
        &mut self,
        at: AtMut<'_, Self::Models>,
        old: (&Arms<K, D>, &Measures<K, D>),
        view: &StepView<'_>,
    );

    /// Evaluates the model of a point at a trial.
    fn evaluate(
        &mut self,
        at: AtMut<'_, Self::Models>,
        element: Element,
        view_and_interface: (&StepView<'_>, &InterfaceTemperatures),
        arms: &StageArms<K, D>,
    ) -> Result<(), StateError>;

    /// See [`Bases`](Self::Bases), at an evaluated trial.
    fn bases(&self) -> Self::Bases;

    /// The arms along which a force acts.
    fn direction<'a>(
        &'a self,
        bases: &'a Self::Bases,
        stage_and_force: [usize; 2],
    ) -> &'a Arms<K, D>;

    /// The forces at the stage of a set times the derivative of their directions with respect to the arms.
    fn geometric_stiffness(
        &self,
        at: At<'_, Self::Models>,
        set: usize,
        arms: &StageArms<K, D>,
    ) -> Blocks<K, D>;

    /// The derivatives of the quantity in the row with respect to the arms of each set.
    fn by_arms(&self, bases: &Self::Bases, local: &LocalStages) -> [Arms<K, D>; MOST_SETS];

    /// The changes of the inputs that belong to forces, for changes of the arms of each set.
    fn inputs(&self, motions: &[Arms<K, D>; MOST_SETS], inputs: &mut [f64]);

    /// The forces on the nodes at a stage, N.
    fn nodal_force(
        &self,
        at: At<'_, Self::Models>,
        stage: usize,
        arms: &StageArms<K, D>,
    ) -> K::PerNode<[f64; D]>;

    /// A of the nodal force `A q_i` at a stage, where stages are closed one after the other.
    fn secant(&self, _: At<'_, Self::Models>, _stage: usize) -> Weights<K, D> {
        Weights::<K, D>::filled(K::PerArm::filled(0.0))
    }

    /// The magnitude of the terms of the impulses of the forces in a step, N s; zero if the scheme is not certified.
    fn impulse_size(&self, _: AtMut<'_, Self::Models>, _step: f64) -> f64 {
        0.0
    }

    /// The work of its forces along the ways of its nodes, whose new arms are given, J: times ε, what rounding of sums of
    /// forces and of the new positions does; zero if the scheme is not certified.
    fn work_along(&self, _: At<'_, Self::Models>, _: &StageWays, _new_arms: &Arms<K, D>) -> f64 {
        0.0
    }

    /// Adds the impulses of the forces to what is exchanged in the step, if the scheme is certified.
    fn see_impulse(&self, _: At<'_, Self::Models>, _step: f64, _: &mut Tally) {}
}

//! The sources of the conjugates of the stages.

use super::point::{LocalStages, Outside, StageArms, StagePoint, StatePoint};
use crate::element::conduction::InterfaceTemperatures;
use crate::element::error::StateError;
use crate::element::group::point::Point;
use crate::element::group::view::StepView;
use crate::element::group::ways::StageWays;
use crate::element::kinematics::{Arms, Blocks, Kinematics, MeasureSet, Weights};
use crate::element::state::State;
use crate::element::tableau::{MOST_SETS, Tableau};
use crate::element::tally::{Reevaluation, Tally};
use eem_material::free_energy::{Array, Material};

/// The part of a [source](Source) that knows no nodes, and so is the same in any number of dimensions: the
/// internal variables of a point at the stages, their equations, and the conjugates as functions of them.
pub(crate) trait StageEquations<M: Material, Q: MeasureSet> {
    /// Number of forces of a stage.
    const FORCES: usize;

    /// Number of local unknowns: the viscous stretches, set after set, then a temperature or entropy per set.
    fn unknowns_of(rule: &Tableau, dashpots: usize) -> usize {
        rule.sets() * (dashpots + usize::from(M::THERMAL))
    }

    /// Number of inputs: one per force, set after set, and the heat Q from other elements, stage after stage.
    fn inputs_of(rule: &Tableau) -> usize {
        rule.sets() * Self::FORCES + rule.stages() * usize::from(M::THERMAL)
    }

    fn point_mut(&mut self) -> &mut StagePoint;

    /// Writes the local equations at an evaluated trial: residuals and their derivatives with respect to
    /// local unknowns and inputs.
    fn write_equations(
        &mut self,
        in_state: &Point<M, Q>,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError>;

    /// Eliminates the internal variables at an evaluated trial.
    fn condense(
        &mut self,
        in_state: &Point<M, Q>,
        local: &mut LocalStages,
        view: &StepView<'_>,
    ) -> Result<(), StateError> {
        if local.unknowns() == 0 {
            return Ok(());
        }
        local.matrix.fill(0.0);
        self.point_mut().solved.fill(0.0);
        self.write_equations(in_state, local, view)?;
        // A finite local system is singular only where the model has no derivative.
        let solved = self.point_mut().solve(local);
        solved.map_err(|_| StateError::NotFinite {
            element: in_state.element,
            quantity: "inverse of the local tangent",
            value: f64::INFINITY,
        })
    }

    /// One of the forces of a stage; its derivatives, with the local unknowns eliminated, are written to the row of the
    /// workspace.
    fn force(&self, local: &mut LocalStages, stage_and_force: [usize; 2]) -> f64;

    /// The temperature of a set, K; its derivatives are written like those of a [force](Self::force).
    fn temperature(&self, local: &mut LocalStages, set: usize) -> f64;

    /// Starts the next correction, of zero, from the present trial.
    fn hold(&mut self);

    /// Takes the correction from the solved local system; returns the largest in its unit.
    fn correct(&mut self, local: &LocalStages) -> f64;

    /// Applies a fraction of the correction.
    fn apply(&mut self, fraction: f64);
}

/// A point of an element at the stages of a step: forces, temperatures and rates of the stages, with their derivatives.
pub(crate) trait Source<M, K, const D: usize>: Sized + Send + Sync + 'static
where
    M: Material,
    K: Kinematics<D>,
{
    /// Its local equations.
    type Equations: StageEquations<M, K::Measures>;

    /// Number of forces of a stage.
    const FORCES: usize = <Self::Equations as StageEquations<M, K::Measures>>::FORCES;

    /// The common part of [`direction`](Self::direction) and [`by_arms`](Self::by_arms).
    type Bases;

    fn new(kinematics: K, point: StagePoint) -> Self;

    fn equations(&self) -> &Self::Equations;

    fn equations_mut(&mut self) -> &mut Self::Equations;

    /// Starts the trial at the old variables `(π, γ, θ)⁰` and arms.
    fn begin(&mut self, in_state: &StatePoint<M, K, D>, x0: &M::Variables, r0: &Arms<K, D>);

    /// Evaluates the model at a trial.
    fn evaluate(
        &mut self,
        in_state: &mut StatePoint<M, K, D>,
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
    fn geometric_stiffness(&self, set: usize, arms: &StageArms<K, D>) -> Blocks<K, D>;

    /// The derivatives of the quantity in the row with respect to the arms of each set.
    fn by_arms(&self, bases: &Self::Bases, local: &LocalStages) -> [Arms<K, D>; MOST_SETS];

    /// The changes of the inputs that belong to forces, for changes of the arms of each set.
    fn inputs(&self, motions: &[Arms<K, D>; MOST_SETS], inputs: &mut [f64]);

    /// The forces on the nodes at a stage, N.
    fn nodal_force(&self, stage: usize, arms: &StageArms<K, D>) -> K::PerNode<[f64; D]>;

    /// A of the nodal force `A q_i` at a stage, where stages are closed one after the other.
    fn secant(&self, _stage: usize) -> Weights<K, D> {
        Weights::<K, D>::filled(K::PerArm::filled(0.0))
    }

    /// The magnitude of the terms of the impulses of the forces in a step, N s; zero if the scheme is not certified.
    fn impulse_size(&mut self, _: &StatePoint<M, K, D>, _step: f64) -> f64 {
        0.0
    }

    /// The work of its forces along the ways of its nodes, whose new arms are given, J: times ε, what rounding of sums of
    /// forces and of the new positions does; zero if the scheme is not certified.
    fn work_along(&self, _ways: &StageWays, _new_arms: &Arms<K, D>) -> f64 {
        0.0
    }

    /// Books the increments of the internal variables and of the reservoirs, and finds the temperature of the new state,
    /// whose arms are given.
    fn close(
        &mut self,
        in_state: &mut StatePoint<M, K, D>,
        new_arms: &Arms<K, D>,
        view_and_outside: (&StepView<'_>, Outside<'_>),
        next_and_tally: (&mut State, &mut Tally),
    ) -> Result<(), StateError>;

    /// Adds the energy balance of the point in the last step, given its nodes; only if the scheme is certified.
    fn reevaluate(
        &self,
        _: &StatePoint<M, K, D>,
        _: &K::PerNode<u32>,
        _: [&State; 2],
        _: &mut Reevaluation,
    ) {
    }
}

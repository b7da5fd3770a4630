//! Where the conjugates of the stages of an element come from.

use super::local::LocalStages;
use super::member::{StageArms, StagePoint, StatePoint};
use crate::element::error::StateError;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Blocks, Kinematics, Weights};
use crate::element::state::State;
use crate::element::tableau::{MOST_SETS, Tableau};
use crate::element::tally::{Recount, Tally};
use eem_material::free_energy::{Array, Material};
use eem_material::number::scalar::Real;

/// What one step needs to remember of a point besides what every rule does, and what follows from it: forces,
/// temperatures and rates of the stages, with their derivatives.
pub(crate) trait Source<S, M, K, const D: usize>: Sized + Send + Sync + 'static
where
    S: Real,
    M: Material<S>,
    K: Kinematics<S, D>,
{
    /// How many forces a stage has.
    const FORCES: usize;

    /// Number of inputs, which other elements and the nodes decide: one per force, set after set, and Q stage after
    /// stage.
    fn inputs_of(rule: &Tableau) -> usize {
        rule.sets() * Self::FORCES + rule.stages() * usize::from(M::THERMAL)
    }

    /// Memory.
    fn new() -> Self;

    /// Takes what it needs from the old state, where the trial starts, given its arms.
    fn begin(
        point: &mut StagePoint<S, M, K, Self, D>,
        in_state: &StatePoint<S, M, K, D>,
        view: &StepView<'_, S>,
        r0: &Arms<K, S, D>,
    );

    /// Evaluates the model at a trial.
    fn evaluate(
        point: &mut StagePoint<S, M, K, Self, D>,
        in_state: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        view_and_trial: (&StepView<'_, S>, &Trial<S, D>),
        arms: &StageArms<K, S, D>,
    ) -> Result<(), StateError>;

    /// Writes the local equations at a trial that has been evaluated: residuals and their derivatives by the
    /// local unknowns and by the inputs.
    fn write_equations(
        point: &mut StagePoint<S, M, K, Self, D>,
        in_state: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        view: &StepView<'_, S>,
    ) -> Result<(), StateError>;

    /// One of the forces of a stage; its derivatives go to the row of the local memory.
    fn force(
        point: &StagePoint<S, M, K, Self, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        stage_and_force: [usize; 2],
    ) -> S;

    /// What the next two are found from.
    type Bases;

    /// That at a trial that has been evaluated.
    fn bases(point: &StagePoint<S, M, K, Self, D>, rule: &Tableau) -> Self::Bases;

    /// The arms along which a force acts.
    fn direction<'a>(
        point: &'a StagePoint<S, M, K, Self, D>,
        bases: &'a Self::Bases,
        stage_and_force: [usize; 2],
    ) -> &'a Arms<K, S, D>;

    /// What the forces of the stage of a set do when their directions turn.
    fn turn(
        point: &StagePoint<S, M, K, Self, D>,
        rule: &Tableau,
        set: usize,
        arms: &StageArms<K, S, D>,
    ) -> Blocks<K, S, D>;

    /// The temperature of a set, K; its derivatives go to the row of the local memory.
    fn temperature(
        point: &StagePoint<S, M, K, Self, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        set: usize,
    ) -> S;

    /// The derivatives by the arms of each set of the quantity that has been eliminated last.
    fn by_arms(
        point: &StagePoint<S, M, K, Self, D>,
        bases: &Self::Bases,
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> [Arms<K, S, D>; MOST_SETS];

    /// The changes of the inputs that go with changes of the arms of each set.
    fn inputs(
        point: &StagePoint<S, M, K, Self, D>,
        rule: &Tableau,
        motions: &[Arms<K, S, D>; MOST_SETS],
        inputs: &mut [S],
    );

    /// Starts the next correction from the present trial, with none.
    fn hold(point: &mut StagePoint<S, M, K, Self, D>);

    /// Takes the correction from the solved local system; the largest in its unit.
    fn correct(
        point: &mut StagePoint<S, M, K, Self, D>,
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> S;

    /// Applies a share of the correction.
    fn apply(point: &mut StagePoint<S, M, K, Self, D>, rule: &Tableau, share: S);

    /// The forces on the nodes at a stage, N.
    fn pull(
        point: &StagePoint<S, M, K, Self, D>,
        rule: &Tableau,
        stage: usize,
        arms: &StageArms<K, S, D>,
    ) -> K::PerNode<[S; D]>;

    /// A of the nodal force `A q_i` of the found stage, where stages are closed one after the other.
    fn secant(_: &StagePoint<S, M, K, Self, D>, _stage: usize) -> Weights<K, S, D> {
        Weights::<K, S, D>::filled(K::PerArm::filled(S::zero()))
    }

    /// The magnitude of what they are computed from in a step, N s; only where steps are certified.
    fn magnitude(_: &StagePoint<S, M, K, Self, D>, _: &Tableau, _step: S) -> S {
        S::zero()
    }

    /// Books the increments of the internal variables and of the reservoirs, and finds the temperature of the
    /// new state, whose arms are given.
    fn close(
        point: &mut StagePoint<S, M, K, Self, D>,
        in_state: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        view_trial_and_new_arms: (&StepView<'_, S>, &Trial<S, D>, &Arms<K, S, D>),
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError>;

    /// The balance of energy of the point in the last step, given its nodes; only where steps are certified.
    fn recount(
        _: &StagePoint<S, M, K, Self, D>,
        _: &StatePoint<S, M, K, D>,
        _: (&Tableau, &K::PerNode<u32>),
        _: [&State<S>; 2],
        _: &mut Recount<S>,
    ) {
    }
}

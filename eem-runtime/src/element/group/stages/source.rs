//! Where the conjugates of the stages of an element come from.

use super::local::LocalStages;
use super::member::{StageMember, StatePoint};
use crate::element::error::StateError;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Blocks, Kinematics, Weights};
use crate::element::recount::Recount;
use crate::element::state::State;
use crate::element::tableau::{MOST_SETS, Tableau};
use crate::element::tally::Tally;
use crate::material::free_energy::FreeEnergy;
use crate::number::scalar::Real;

/// What one step needs to remember of an element besides what every rule does, and what follows from it: forces,
/// temperatures and rates of the stages, with their derivatives.
pub(crate) trait Source<S, M, K, const D: usize>: Sized + Send + Sync + 'static
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Memory.
    fn new() -> Self;

    /// Takes what it needs from the old state, where the trial starts.
    fn begin(
        member: &mut StageMember<S, M, K, Self, D>,
        own: &StatePoint<S, M, K, D>,
        view: &StepView<'_, S>,
    );

    /// Evaluates the model at a trial.
    fn evaluate(
        member: &mut StageMember<S, M, K, Self, D>,
        own: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
    ) -> Result<(), StateError>;

    /// Writes the local equations at a trial that has been evaluated: residuals and their derivatives by the
    /// local unknowns and by the inputs.
    fn write_equations(
        member: &mut StageMember<S, M, K, Self, D>,
        own: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        view: &StepView<'_, S>,
    );

    /// The conjugate of a measure at a stage; its derivatives go to the row of the local memory.
    fn force(
        member: &StageMember<S, M, K, Self, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        stage: usize,
        measure: usize,
    ) -> S;

    /// The arms along which it acts.
    fn direction(
        member: &StageMember<S, M, K, Self, D>,
        stage: usize,
        measure: usize,
    ) -> &Arms<K, S, D>;

    /// What the forces of the stage of a set do when their directions turn.
    fn turn(
        member: &StageMember<S, M, K, Self, D>,
        rule: &Tableau,
        set: usize,
        trial: &Trial<S, D>,
    ) -> Blocks<K, S, D>;

    /// The temperature of a set, K; its derivatives go to the row of the local memory.
    fn temperature(
        member: &StageMember<S, M, K, Self, D>,
        rule: &Tableau,
        local: &mut LocalStages<S>,
        set: usize,
    ) -> S;

    /// The derivatives by the arms of each set of the quantity that has been eliminated last.
    fn by_arms(
        member: &StageMember<S, M, K, Self, D>,
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> [Arms<K, S, D>; MOST_SETS];

    /// The changes of the inputs that go with changes of the arms of each set.
    fn inputs(
        member: &StageMember<S, M, K, Self, D>,
        rule: &Tableau,
        motions: &[Arms<K, S, D>; MOST_SETS],
        inputs: &mut [S],
    );

    /// Starts the next correction from the present trial, with none.
    fn hold(member: &mut StageMember<S, M, K, Self, D>);

    /// Takes the correction from the solved local system; the largest in its unit.
    fn correct(
        member: &mut StageMember<S, M, K, Self, D>,
        rule: &Tableau,
        local: &LocalStages<S>,
    ) -> S;

    /// Applies a share of the correction.
    fn apply(member: &mut StageMember<S, M, K, Self, D>, rule: &Tableau, share: S);

    /// The forces on the nodes at a stage, N.
    fn pull(
        member: &StageMember<S, M, K, Self, D>,
        rule: &Tableau,
        stage: usize,
        trial: &Trial<S, D>,
    ) -> K::PerNode<[S; D]>;

    /// A of the nodal force `A q_i` of the found stage.
    fn secant(member: &StageMember<S, M, K, Self, D>, stage: usize) -> Weights<K, S, D>;

    /// The magnitude of what they are computed from in a step, N s; only where steps are certified.
    fn magnitude(_: &StageMember<S, M, K, Self, D>, _: &Tableau, _step: S) -> S {
        S::zero()
    }

    /// Books the increments of the internal variables and of the reservoirs, and finds the temperature of the
    /// new state, whose arms are given.
    fn close(
        member: &mut StageMember<S, M, K, Self, D>,
        own: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
        view_trial_and_new_arms: (&StepView<'_, S>, &Trial<S, D>, &Arms<K, S, D>),
        next: &mut State<S>,
        tally: &mut Tally<S>,
    ) -> Result<(), StateError>;

    /// The balance of energy of the element in the last step; only where steps are certified.
    fn recount(
        _: &StageMember<S, M, K, Self, D>,
        _: &StatePoint<S, M, K, D>,
        _: &Tableau,
        _: [&State<S>; 2],
        _: &mut Recount<S>,
    ) {
    }
}

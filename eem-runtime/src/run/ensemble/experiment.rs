//! An ensemble described for numbers of any type, so that several of its members can move together.

use core::marker::PhantomData;

use super::error::MemberFailure;
use crate::number::scalar::Real;
use crate::run::simulation::Simulation;
use crate::scene::Scene;

/// A scene and its observation, with numbers that differ between the members of an ensemble.
///
/// Written once for any number type S, it can be run with one member at a time and with one member
/// per SIMD lane; see [`Ensemble::run_experiment`](crate::Ensemble::run_experiment). Everything that
/// is no number is common to all members: nodes, elements, contacts, kinds of material, number of
/// steps. The parameters of a material may differ if its struct has them as fields of the type S.
///
/// What a comparison of numbers decides is common too: `a.less(b).decide()?` is one `bool`, or the error
/// [`Discord`](crate::Discord) where members would decide differently. After that error, or any other
/// error of the simulation, the members are run one by one; both methods may therefore be called a second
/// time for an input. They should pass errors on and not panic on them, as a step of members together may
/// fail that succeeds alone. `==` is not for decisions: of members that differ it says nothing. Numbers
/// leave the experiment by [`Members::outputs`]: several of them have no one value in double precision,
/// so that members with a [`Recorder`](crate::Recorder) or with events
/// ([`Simulation::run_until_event`]) always run one by one.
pub trait Experiment<const D: usize>: Sync {
    /// What a member is made from.
    type Input: Sync;
    /// What observing needs to find its way in the scene: handles, or `()`.
    type Handles;
    /// What is to be kept of a member.
    type Output: Send;

    /// The scene, whose numbers come from the inputs by [`Members::number`].
    fn build<S: Real>(&self, members: Members<'_, Self::Input, S>) -> (Scene<D, S>, Self::Handles);

    /// Steps the simulation and returns what is to be kept, by [`Members::outputs`].
    ///
    /// Members that move together need as many Newton iterations as the slowest of them, which is
    /// what [`StepReport::iterations`](crate::StepReport::iterations) says; no other number depends
    /// on which members move together.
    ///
    /// # Errors
    ///
    /// Those of the simulation, by `?`, or [`MemberFailure::other`].
    fn observe<S: Real>(
        &self,
        run: &mut Simulation<D, S>,
        handles: Self::Handles,
        members: Members<'_, Self::Input, S>,
    ) -> Result<Outputs<Self::Output>, MemberFailure>;
}

/// The members of an ensemble that a scene with numbers S stands for: one if S is `f64`.
#[derive(Debug)]
pub struct Members<'a, I, S> {
    inputs: &'a [I],
    numbers: PhantomData<S>,
}

impl<I, S> Clone for Members<'_, I, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I, S> Copy for Members<'_, I, S> {}

impl<'a, I, S: Real> Members<'a, I, S> {
    /// At least one, and not more than S has numbers; what is left over repeats the last one.
    pub(super) fn new(inputs: &'a [I]) -> Self {
        Self {
            inputs,
            numbers: PhantomData,
        }
    }

    /// The numbers that inputs say, in one.
    #[must_use]
    pub fn number(self, of: impl Fn(&I) -> f64) -> S {
        let last = self.inputs.len() - 1;
        S::pack(|lane| of(&self.inputs[lane.min(last)]))
    }

    /// Outputs made from the input of each member and a function that takes its number out of a
    /// number S.
    pub fn outputs<T>(self, mut output: impl FnMut(&I, &dyn Fn(S) -> f64) -> T) -> Outputs<T> {
        let inputs = self.inputs.iter().enumerate();
        let outputs = inputs.map(|(lane, input)| output(input, &|number| number.lane(lane)));
        Outputs(outputs.collect())
    }
}

/// An output for each member that moved together.
#[derive(Debug)]
pub struct Outputs<T>(pub(super) Vec<T>);

//! Experiments: an ensemble described for any number type, so that its members can run in SIMD lanes.

use core::marker::PhantomData;

use super::error::MemberFailure;
use crate::run::simulation::Simulation;
use crate::scene::Scene;

/// A scene and its observation, generic in the number type, for
/// [`Ensemble::run_experiment`](crate::Ensemble::run_experiment).
///
/// It runs one member at a time, or one member per SIMD lane. Only numbers differ between members in lanes; nodes,
/// elements, conduction, materials and the number of steps are common. Parameters of a material can differ if its
/// fields have the type S.
///
/// Decisions are common too: `a.less(b).decide()?` is a `bool`, or the error [`Discord`](crate::Discord) if members
/// differ. After any error the members are run one by one, so both methods may be called a second time for an
/// input. Return errors instead of panicking: a step in lanes may fail although it succeeds alone. Do not decide
/// with `==`. Numbers leave the experiment through [`Members::outputs`], because several members have no single
/// value; therefore members with a [`Recorder`](crate::Recorder) or with events ([`Simulation::run_until_event`])
/// run one by one.
pub trait Experiment<const D: usize>: Sync {
    /// The input of a member.
    type Input: Sync;
    /// The handles needed to observe, or `()`.
    type Handles;
    /// The result of a member.
    type Output: Send;

    /// Builds the scene. Numbers come from the inputs through [`Members::number`].
    fn build(&self, members: Members<'_, Self::Input>) -> (Scene<D>, Self::Handles);

    /// Steps the simulation and returns the results through [`Members::outputs`].
    ///
    /// Members in lanes make as many Newton iterations as the slowest of them, which
    /// [`StepReport::iterations`](crate::StepReport::iterations) counts; no other number depends on the lanes.
    ///
    /// # Errors
    ///
    /// Those of the simulation, by `?`, or [`MemberFailure::other`].
    fn observe(
        &self,
        run: &mut Simulation<D>,
        handles: Self::Handles,
        members: Members<'_, Self::Input>,
    ) -> Result<Outputs<Self::Output>, MemberFailure>;
}

/// The members that a scene with numbers S represents: one if S is `f64`.
#[derive(Debug)]
pub struct Members<'a, I> {
    inputs: &'a [I],
    numbers: PhantomData<f64>,
}

impl<I> Clone for Members<'_, I> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I> Copy for Members<'_, I> {}

impl<'a, I> Members<'a, I> {
    /// From one to as many inputs as S has lanes; further lanes repeat the last one.
    pub(super) fn new(inputs: &'a [I]) -> Self {
        Self {
            inputs,
            numbers: PhantomData,
        }
    }

    /// A number of type S from the inputs.
    #[must_use]
    pub fn number(self, of: impl Fn(&I) -> f64) -> f64 {
        let last = self.inputs.len() - 1;
        S::pack(|lane| of(&self.inputs[lane.min(last)]))
    }

    /// Results from the input of each member and a function that extracts its number from a number S.
    pub fn outputs<T>(self, mut output: impl FnMut(&I, &dyn Fn(f64) -> f64) -> T) -> Outputs<T> {
        let inputs = self.inputs.iter().enumerate();
        let outputs = inputs.map(|(lane, input)| output(input, &|number| number.lane(lane)));
        Outputs(outputs.collect())
    }
}

/// An output for each member.
#[derive(Debug)]
pub struct Outputs<T>(pub(super) Vec<T>);

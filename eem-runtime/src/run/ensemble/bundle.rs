//! Running an experiment with one member, or with several in SIMD lanes.

use core::slice;
use core::sync::atomic::{AtomicBool, Ordering};

use super::error::MemberFailure;
use super::experiment::{Experiment, Members};
use crate::run::simulation::Simulation;
use crate::scene::error::SceneError;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;
#[cfg(feature = "lanes")]
use eem_material::number::lanes::Lanes;

/// How members are stepped, and whether they can be stepped in lanes.
#[derive(Debug)]
pub(super) struct Bundles {
    pub(super) scheme: Scheme,
    pub(super) step: f64,
    pub(super) newton: NewtonSettings,
    /// Whether a scene did not suit lanes; all scenes are alike in this.
    pub(super) is_unsuited: AtomicBool,
}

/// The number of members that are stepped together.
#[cfg(feature = "lanes")]
pub(super) const SIZE: usize = Lanes::LANES;
#[cfg(not(feature = "lanes"))]
pub(super) const SIZE: usize = 1;

impl Bundles {
    /// The results of at most [`SIZE`] members.
    pub(super) fn run<const D: usize, E: Experiment<D>>(
        &self,
        experiment: &E,
        inputs: &[E::Input],
    ) -> Vec<Result<E::Output, MemberFailure>> {
        #[cfg(feature = "lanes")]
        if inputs.len() > 1
            && !self.is_unsuited.load(Ordering::Relaxed)
            && let Ok(outputs) = self.run_as::<Lanes, D, E>(experiment, inputs)
            && outputs.len() == inputs.len()
        {
            return outputs.into_iter().map(Ok).collect();
        }
        let one = |input| {
            let output = self
                .run_as::<f64, D, E>(experiment, slice::from_ref(input))?
                .pop();
            output.ok_or_else(|| MemberFailure::other("the experiment has no output"))
        };
        inputs.iter().map(one).collect()
    }

    /// The outputs of members in one number S; an error if one of them fails, or lanes diverge.
    fn run_as<const D: usize, E: Experiment<D>>(
        &self,
        experiment: &E,
        inputs: &[E::Input],
    ) -> Result<Vec<E::Output>, MemberFailure> {
        let members = Members::new(inputs);
        let (scene, handles) = experiment.build(members);
        let run = Simulation::new(scene, self.scheme, self.step);
        let mut run = run.map_err(SceneError::from)?;
        run.set_newton_settings(NewtonSettings {
            max_iterations: self.newton.max_iterations,
            tolerance: self.newton.tolerance,
        })?;
        let outputs = experiment.observe(&mut run, handles, members)?;
        if run.has_diverged() {
            // The experiment has ignored an error.
            return Err(Discord.into());
        }
        Ok(outputs.0)
    }
}

//! One experiment on one member, or on several that move together.

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
use eem_material::number::scalar::{Discord, Real};

/// How members are stepped, and whether they can move together.
#[derive(Debug)]
pub(super) struct Bundles {
    scheme: Scheme,
    step: f64,
    newton: NewtonSettings<f64>,
    /// Whether a scene has been found that cannot be stepped in lanes; the others are like it.
    is_unsuited: AtomicBool,
}

impl Bundles {
    /// With this scheme, time step and settings.
    pub(super) fn new(scheme: Scheme, step: f64, newton: NewtonSettings<f64>) -> Self {
        Self {
            scheme,
            step,
            newton,
            is_unsuited: AtomicBool::new(false),
        }
    }

    /// How many members move together.
    pub(super) const fn size() -> usize {
        #[cfg(feature = "lanes")]
        return Lanes::LANES;
        #[cfg(not(feature = "lanes"))]
        return 1;
    }

    /// The outcome of each of at most so many members.
    pub(super) fn run<const D: usize, E: Experiment<D>>(
        &self,
        experiment: &E,
        inputs: &[E::Input],
    ) -> Vec<Result<E::Output, MemberFailure>> {
        #[cfg(feature = "lanes")]
        if let Some(outputs) = self.run_together(experiment, inputs) {
            return outputs.into_iter().map(Ok).collect();
        }
        let inputs = inputs.iter();
        inputs
            .map(|input| self.run_one(experiment, input))
            .collect()
    }

    fn run_one<const D: usize, E: Experiment<D>>(
        &self,
        experiment: &E,
        input: &E::Input,
    ) -> Result<E::Output, MemberFailure> {
        let mut outputs = self.run_as::<f64, D, E>(experiment, slice::from_ref(input))?;
        let output = outputs.pop();
        output.ok_or_else(|| MemberFailure::other("the experiment has no output"))
    }

    /// The outputs of all members, moved together; nothing if one of them fails, or if they do not
    /// go the same way.
    #[cfg(feature = "lanes")]
    fn run_together<const D: usize, E: Experiment<D>>(
        &self,
        experiment: &E,
        inputs: &[E::Input],
    ) -> Option<Vec<E::Output>> {
        if inputs.len() == 1 || self.is_unsuited.load(Ordering::Relaxed) {
            return None;
        }
        let outputs = self.run_as::<Lanes, D, E>(experiment, inputs).ok();
        outputs.filter(|outputs| outputs.len() == inputs.len())
    }

    /// The experiment with numbers S.
    fn run_as<S: Real, const D: usize, E: Experiment<D>>(
        &self,
        experiment: &E,
        inputs: &[E::Input],
    ) -> Result<Vec<E::Output>, MemberFailure> {
        let members = Members::new(inputs);
        let (scene, handles) = experiment.build(members);
        let run = Simulation::new(scene, self.scheme, S::from_f64(self.step));
        let mut run = run.map_err(SceneError::from)?;
        run.set_newton_settings(NewtonSettings {
            max_iterations: self.newton.max_iterations,
            tolerance: S::from_f64(self.newton.tolerance),
        })?;
        if S::LANES > 1 && !run.suits_lanes() {
            self.is_unsuited.store(true, Ordering::Relaxed);
            return Err(MemberFailure::other("the scene does not suit lanes"));
        }
        let outputs = experiment.observe(&mut run, handles, members)?;
        if run.has_parted() {
            // The experiment has gone on after an error.
            return Err(Discord.into());
        }
        Ok(outputs.0)
    }
}

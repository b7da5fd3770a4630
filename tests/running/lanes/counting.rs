//! An experiment whose course depends on its numbers: it counts steps until something happens.

use eem::prelude::*;
use eem::{Experiment, Mask, MemberFailure, Members, Outputs, Real};

use super::scenes::Driven;
use super::watched::{Case, Input, Parts};

/// What ends the counting.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Until {
    /// A step fails, which is no failure of the member.
    StepFails,
    /// The second spring is colder than this, K.
    Colder(f64),
}

impl Experiment<2> for Until {
    type Input = Input;
    type Handles = Parts;
    type Output = usize;

    fn build<S: Real>(&self, members: Members<'_, Input, S>) -> (Scene<2, S>, Parts) {
        Driven.scene([0, 1, 2].map(|k| members.number(|input| input[k])))
    }

    fn observe<S: Real>(
        &self,
        run: &mut Simulation<2, S>,
        parts: Parts,
        members: Members<'_, Input, S>,
    ) -> Result<Outputs<usize>, MemberFailure> {
        let mut steps = 0;
        loop {
            match *self {
                Self::StepFails => {
                    if run.step().is_err() {
                        break;
                    }
                }
                Self::Colder(limit) => {
                    run.step()?;
                    let theta = run.temperature(parts.elements[1])?;
                    if theta.less(S::from_f64(limit)).decide()? {
                        break;
                    }
                }
            }
            steps += 1;
        }
        Ok(members.outputs(|_, _| steps))
    }
}

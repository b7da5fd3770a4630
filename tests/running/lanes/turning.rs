//! Masses that swing against each other, so that what one of them waits for never comes for all at once.

use eem::prelude::*;
use eem::{Experiment, Mask, MemberFailure, Members, Outputs, Real};

/// A spring whose force is linear: opposite speeds are opposite motions.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
struct Linear {
    stiffness: f64,
    length: f64,
}

/// Counts steps until a mass, started at the speed of the input in m/s, moves towards its hook.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Turning {
    /// Found by a decision of all members.
    ByDecision,
    /// Found in the column of a recorder.
    ByRecord,
}

impl Experiment<1> for Turning {
    type Input = f64;
    type Handles = Node;
    type Output = usize;

    fn build<S: Real>(&self, members: Members<'_, f64, S>) -> (Scene<1, S>, Node) {
        let mut scene = Scene::default();
        let hook = scene.anchor([S::zero()]);
        let speed = members.number(|&speed| speed);
        let mass = scene.mass(S::one(), [S::from_f64(2.0)], [speed]);
        let (stiffness, length) = (1.0, 2.0);
        scene.spring(Linear { stiffness, length }, [hook, mass]);
        (scene, mass)
    }

    fn observe<S: Real>(
        &self,
        run: &mut Simulation<1, S>,
        mass: Node,
        members: Members<'_, f64, S>,
    ) -> Result<Outputs<usize>, MemberFailure> {
        let mut steps = 0;
        let momentum = [("p", Quantity::Momentum(mass))];
        let mut recorder = Recorder::new(run, momentum).map_err(MemberFailure::other)?;
        loop {
            run.step()?;
            steps += 1;
            let momentum = run.momentum(mass)?.x;
            let is_back = match self {
                Self::ByDecision => momentum.less(S::zero()).decide()?,
                Self::ByRecord => {
                    recorder.record(run)?;
                    let column = recorder.column("p").or(recorder.column("p_x"));
                    column.and_then(<[f64]>::last) < Some(&0.0)
                }
            };
            if is_back {
                return Ok(members.outputs(|_, _| steps));
            }
        }
    }
}

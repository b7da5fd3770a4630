//! The cases of this package as scenes of the library.

use clap::ValueEnum;
use eem::prelude::*;
use eem::{EndState, StateQuantity};

use crate::systems::State;
use crate::{double_pendulum, single_pendulum};

/// Those of the example `work_precision` that fix all their data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CaseName {
    /// A thermo-visco-elastic pendulum.
    Single,
    /// A double pendulum of stiff springs: fast oscillations, chaotic after some seconds.
    Krueger,
    /// A double pendulum of springs that soften when hot.
    Log,
}

impl CaseName {
    /// The name on the command line and in pictures.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Krueger => "krueger",
            Self::Log => "log",
        }
    }

    /// The data, unless it is the single pendulum.
    pub(crate) const fn double(self) -> Option<double_pendulum::Case> {
        match self {
            Self::Single => None,
            Self::Krueger => Some(double_pendulum::KRUEGER),
            Self::Log => Some(double_pendulum::LOG),
        }
    }

    /// A run of the library, which calls `see` at the start and after every step.
    pub(crate) fn run(
        self,
        scheme: Scheme,
        steps: u32,
        end: f64,
        see: impl FnMut(&State),
    ) -> Result<(), Box<dyn std::error::Error>> {
        let step = end / f64::from(steps.max(1));
        match self.double() {
            None => {
                let (scene, _) = single_pendulum::scene(single_pendulum::CONDUCTANCE);
                go(Simulation::new(scene, scheme, step)?, steps, see)
            }
            Some(case) => go(Simulation::new(case.scene().0, scheme, step)?, steps, see),
        }
    }

    /// The state at t = 0.
    pub(crate) fn start(self) -> Result<State, Box<dyn std::error::Error>> {
        let mut start = State::default();
        self.run(Scheme::Gauss4, 0, 1.0, |state| start.clone_from(state))?;
        Ok(start)
    }
}

fn go<const D: usize>(
    mut run: Simulation<D>,
    steps: u32,
    mut see: impl FnMut(&State),
) -> Result<(), Box<dyn std::error::Error>> {
    see(&state(&run));
    for _ in 0..steps {
        run.step()?;
        see(&state(&run));
    }
    Ok(())
}

/// The state of a run.
pub(crate) fn state<const D: usize>(run: &Simulation<D>) -> State {
    let end = EndState::of(run);
    let values = |quantity| end.values(quantity).to_vec();
    State {
        positions: values(StateQuantity::Positions),
        momenta: values(StateQuantity::Momenta),
        temperatures: values(StateQuantity::Temperatures),
        viscous: values(StateQuantity::ViscousStretches),
    }
}

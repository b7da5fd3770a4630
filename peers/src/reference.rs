//! What errors are measured against: two solutions that have nothing in common.
//!
//! One is the library's, by Gauss collocation of fourth order in equal steps, with equations that the derive
//! generated, in entropy variables; the other is by DOP853 with the equations of this package in temperature
//! variables. The steps of the first are halved until the two come no closer. An error is measured from the first,
//! and stated if the two differ by at most a hundredth of it, as in the library's study.

use std::error::Error;

use eem::Scheme;

use crate::cases::CaseName;
use crate::solvers::{Solver, Task};
use crate::systems::{Double, Single, State, System, Variables, larger, norm};

/// As tight as makes sense: rounding adds as much.
const TIGHT: f64 = 1e-14;

/// The first steps, s.
const FIRST_STEP: f64 = 2e-3;

/// Halving has helped if the difference shrinks so much; by fourth order it should by 16.
const HELPS: f64 = 0.5;

/// No more steps than this, a minute's work.
const MOST_STEPS: u32 = 1 << 20;

/// A part of an error that the references may differ by.
const DOUBT: f64 = 0.01;

/// The library's state at the end time, and how well it is known.
#[derive(Clone, Debug)]
pub(crate) struct Reference {
    pub(crate) start: State,
    pub(crate) state: State,
    /// How far the other reference is from it: of q, p and θ.
    pub(crate) doubts: [f64; 3],
    /// The largest |p|₂ of the run, kg m/s.
    pub(crate) momentum: f64,
    /// Steps of the library.
    pub(crate) steps: u32,
}

impl Reference {
    /// That of a case at a time, s.
    pub(crate) fn of(case: CaseName, end: f64) -> Result<Self, Box<dyn Error>> {
        let start = case.start()?;
        let mut steps = first_steps(end);
        let mut best = library(case, end, steps, &start)?;
        let (other, _) = best.dop853(case, end, TIGHT)?;
        best.doubts = other.errors(&best.state);
        while steps < MOST_STEPS {
            steps *= 2;
            let mut next = library(case, end, steps, &start)?;
            next.doubts = other.errors(&next.state);
            let worst = |doubts: [f64; 3]| doubts.into_iter().fold(0.0, larger);
            let helped = worst(next.doubts) <= HELPS * worst(best.doubts);
            if worst(next.doubts) < worst(best.doubts) {
                best = next;
            }
            if !helped {
                break;
            }
        }
        Ok(best)
    }

    /// The state by DOP853 alone, at its tightest tolerance: for errors far above 10⁻¹².
    pub(crate) fn by_dop853(case: CaseName, end: f64) -> Result<Self, Box<dyn Error>> {
        // The run of the library finds the momentum.
        let mut reference = library(case, end, first_steps(end), &case.start()?)?;
        let (state, _) = reference.dop853(case, end, TIGHT)?;
        reference.doubts = state.errors(&reference.state);
        reference.state = state;
        Ok(reference)
    }

    /// The state at the end of a run of DOP853 in temperature variables, and the time of its steps, s.
    pub(crate) fn dop853(
        &self,
        case: CaseName,
        end: f64,
        tolerance: f64,
    ) -> Result<(State, f64), String> {
        let (variables, start) = (Variables::Temperature, self.start.clone());
        match case.double() {
            None => solve(
                &Single::new(variables, start),
                end,
                self.momentum,
                tolerance,
            ),
            Some(case) => solve(
                &Double::new(&case, variables, start),
                end,
                self.momentum,
                tolerance,
            ),
        }
    }

    /// The errors of a state, where the references are close enough to tell.
    pub(crate) fn errors(&self, state: &State) -> [Option<f64>; 3] {
        let errors = state.errors(&self.state);
        let stated = |i: usize| (self.doubts[i] <= DOUBT * errors[i]).then_some(errors[i]);
        [stated(0), stated(1), stated(2)]
    }

    /// The largest error of all kinds, if the largest doubt is small enough beside it.
    pub(crate) fn largest_error(&self, state: &State) -> Option<f64> {
        let largest = |values: [f64; 3]| values.into_iter().fold(0.0, larger);
        let error = largest(state.errors(&self.state));
        (largest(self.doubts) <= DOUBT * error).then_some(error)
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to 1 … 2²⁰"
)]
fn first_steps(end: f64) -> u32 {
    (end / FIRST_STEP).ceil().clamp(1.0, f64::from(MOST_STEPS)) as u32
}

/// A run of the library.
fn library(
    case: CaseName,
    end: f64,
    steps: u32,
    start: &State,
) -> Result<Reference, Box<dyn Error>> {
    let (mut state, mut momentum) = (State::default(), 0.0);
    case.run(Scheme::Gauss4, steps, end, |now| {
        momentum = larger(momentum, norm(&now.momenta));
        state.clone_from(now);
    })?;
    Ok(Reference {
        start: start.clone(),
        state,
        doubts: [f64::INFINITY; 3],
        momentum,
        steps,
    })
}

fn solve<const N: usize>(
    system: &impl System<N>,
    end: f64,
    momentum: f64,
    tolerance: f64,
) -> Result<(State, f64), String> {
    let task = Task {
        system,
        sizes: system.sizes(momentum),
        end,
        tolerance,
    };
    let solved = Solver::Dop853.solve(&task, |_| ())?;
    Ok((system.state(&solved.y), solved.seconds))
}

//! Runs of the three sides. Times are those of the steps alone.

use std::error::Error;
use std::hint::black_box;
use std::time::{Duration, Instant};

use clap::ValueEnum;
use eem::Tolerance;
use eem::prelude::*;
use eem_studies::pendulums::{self, Double};

use crate::cases::{CaseName, state};
use crate::prototype::{Pendulum, Run, TemperatureRun};
use crate::reference::Reference;
use crate::systems::{State, larger};

/// What a run found, and the time of its steps.
pub(super) type Timed<T> = Result<(T, Duration), Box<dyn Error>>;

/// Calls a function for the prototype of a case.
macro_rules! of_case {
    ($case:expr, $function:ident($($argument:expr),*)) => {
        match $case {
            CaseName::Single => $function::<$crate::prototype::Single, 6, 3>($($argument),*),
            CaseName::Krueger => $function::<$crate::prototype::Krueger, 14, 2>($($argument),*),
            CaseName::Log => $function::<$crate::prototype::Log, 14, 2>($($argument),*),
        }
    };
}

pub(super) use of_case;

/// What is stepped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Form {
    /// `eem-explicit`.
    Explicit,
    /// `eem-temperature`, of the case `log` only.
    Temperature,
}

impl Form {
    const fn scheme(self) -> Scheme {
        match self {
            Self::Explicit => Scheme::EemExplicit,
            Self::Temperature => Scheme::EemTemperature,
        }
    }
}

/// The fixed step of a case, s; that of the study `hot_cases`.
pub(super) const fn step(case: CaseName, form: Form) -> f64 {
    match (form, case) {
        (Form::Temperature, _) => 0.01,
        (Form::Explicit, CaseName::Single | CaseName::Log) => 0.05,
        (Form::Explicit, CaseName::Krueger) => 0.1,
    }
}

/// How long the library runs.
#[derive(Clone, Copy, Debug)]
enum Length {
    Steps(u32),
    Until(f64),
}

/// Fixed steps of the library from the start; their time.
pub(super) fn library_steps(
    case: CaseName,
    form: Form,
    steps: u32,
) -> Result<Duration, Box<dyn Error>> {
    let (_, time) = library_after(case, form, step(case, form), steps)?;
    Ok(time)
}

/// The library's state after some steps of one size.
pub(super) fn library_after(case: CaseName, form: Form, step: f64, steps: u32) -> Timed<State> {
    library(case, form, step, None, Length::Steps(steps))
}

/// A run of the library's explicit scheme with a tolerance.
pub(super) fn library_run(case: CaseName, end: f64, tolerance: f64) -> Timed<State> {
    let step = step(case, Form::Explicit);
    library(
        case,
        Form::Explicit,
        step,
        Some(tolerance),
        Length::Until(end),
    )
}

fn library(
    case: CaseName,
    form: Form,
    step: f64,
    tolerance: Option<f64>,
    length: Length,
) -> Timed<State> {
    let scheme = form.scheme();
    match case {
        CaseName::Single => {
            let scene = pendulums::single(1.0).scene;
            go(Simulation::new(scene, scheme, step)?, tolerance, length)
        }
        CaseName::Krueger => {
            let scene = Double::KRUEGER.build(1.0).scene;
            go(Simulation::new(scene, scheme, step)?, tolerance, length)
        }
        CaseName::Log => {
            let scene = Double::LOG.build(1.0).scene;
            go(Simulation::new(scene, scheme, step)?, tolerance, length)
        }
    }
}

fn go<const D: usize>(
    mut run: Simulation<D>,
    tolerance: Option<f64>,
    length: Length,
) -> Timed<State> {
    if let Some(tolerance) = tolerance {
        run.control_steps(Tolerance::new(tolerance))?;
    }
    let started = Instant::now();
    match length {
        Length::Steps(steps) => {
            for _ in 0..steps {
                run.step()?;
            }
        }
        Length::Until(end) => run.run_until(end)?,
    }
    let time = started.elapsed();
    Ok((state(&run), time))
}

/// Fixed steps of the prototype from the start; their time.
pub(super) fn prototype_steps(
    case: CaseName,
    form: Form,
    steps: u32,
) -> Result<Duration, Box<dyn Error>> {
    let step = step(case, form);
    match form {
        Form::Explicit => of_case!(case, explicit_steps(step, steps)),
        Form::Temperature => {
            let (run, time) = temperature_after(case, step, steps)?;
            black_box(run);
            Ok(time)
        }
    }
}

/// The prototype in temperature form after some steps of one size.
pub(super) fn temperature_after(case: CaseName, step: f64, steps: u32) -> Timed<TemperatureRun> {
    if case != CaseName::Log {
        return Err("the prototype in temperature form has the case log only".into());
    }
    let mut run = black_box(TemperatureRun::new());
    let started = Instant::now();
    for _ in 0..steps {
        run.step(step).ok_or("Newton's method does not converge")?;
    }
    let time = started.elapsed();
    Ok((run, time))
}

fn explicit_steps<C: Pendulum<N, X>, const N: usize, const X: usize>(
    step: f64,
    steps: u32,
) -> Result<Duration, Box<dyn Error>> {
    let mut run = black_box(Run::<C, N, X>::new());
    let started = Instant::now();
    for _ in 0..steps {
        run.step(step, None)
            .map_err(|_| "the prototype rejects a step")?;
    }
    let time = started.elapsed();
    black_box(run);
    Ok(time)
}

/// A run of the prototype with a tolerance.
pub(super) fn prototype_run(case: CaseName, end: f64, tolerance: f64) -> Timed<State> {
    of_case!(case, tolerant_run(end, tolerance))
}

fn tolerant_run<C: Pendulum<N, X>, const N: usize, const X: usize>(
    end: f64,
    tolerance: f64,
) -> Timed<State> {
    let mut run = black_box(Run::<C, N, X>::new());
    let started = Instant::now();
    if !run.run_until(end, tolerance) {
        return Err("the prototype does not reach the end".into());
    }
    let time = started.elapsed();
    Ok((run.state(), time))
}

/// DOP853 of the crate `differential-equations`, in temperature variables.
#[derive(Debug)]
pub(super) struct Dop853 {
    case: CaseName,
    /// With the state of the crate's DOP853 at its tightest tolerance.
    reference: Reference,
    end: f64,
}

impl Dop853 {
    pub(super) fn new(case: CaseName, end: f64) -> Result<Self, Box<dyn Error>> {
        let reference = Reference::by_dop853(case, end)?;
        Ok(Self {
            case,
            reference,
            end,
        })
    }

    /// The largest of the errors of a state.
    pub(super) fn error(&self, state: &State) -> f64 {
        let errors = state.errors(&self.reference.state);
        errors.into_iter().fold(0.0, larger)
    }

    pub(super) fn run(&self, tolerance: f64) -> Timed<State> {
        let (state, seconds) = self.reference.dop853(self.case, self.end, tolerance)?;
        Ok((state, Duration::from_secs_f64(seconds)))
    }
}

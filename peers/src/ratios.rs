//! The library's explicit scheme and the prototype in turn: fixed steps, and runs with a tolerance.

pub(crate) mod agreement;
mod clock;
mod runs;

use std::error::Error;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use eem_studies::{command_line, table, terminal};

use crate::cases::CaseName;
use crate::exit_code;
use crate::summary::time_for;
use runs::Form;

const ABOUT: &str = "The library's explicit scheme and a prototype written by hand, in turn";

/// Runs with a tolerance end here, s.
const END: f64 = 5.0;

/// The state error at which runs with a tolerance are compared.
const ERROR: f64 = 1e-6;

/// Tolerances are 10^(−k/2) with k from the first number to the second: errors on both sides of [`ERROR`].
const TOLERANCES: [u8; 2] = [4, 20];

#[derive(Debug, Parser)]
struct Options {
    /// Which scene; all of them unless given.
    #[arg(long, value_name = "NAME")]
    case: Option<CaseName>,
    /// Makes fixed steps of one side only, without clock or table, to count their instructions.
    #[arg(long, value_name = "SIDE", requires = "case")]
    only: Option<Side>,
    /// Which scheme, with `--only`.
    #[arg(
        long,
        value_name = "FORM",
        default_value = "explicit",
        requires = "only"
    )]
    form: Form,
    /// How many steps a run with fixed steps makes.
    #[arg(long, value_name = "N", default_value_t = 400)]
    steps: u32,
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Side {
    Library,
    Prototype,
}

/// The program `ratios`.
#[must_use]
pub fn ratios() -> ExitCode {
    exit_code(run(&command_line::read(ABOUT)))
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let steps = options.steps;
    if let (Some(case), Some(side)) = (options.case, options.only) {
        match side {
            Side::Library => runs::library_steps(case, options.form, steps)?,
            Side::Prototype => runs::prototype_steps(case, options.form, steps)?,
        };
        return Ok(());
    }
    let cases = options.case.map_or_else(
        || vec![CaseName::Single, CaseName::Krueger, CaseName::Log],
        |case| vec![case],
    );
    for &case in &cases {
        agreement::check(case)?;
    }
    fixed_steps(&cases, Form::Explicit, steps)?;
    if cases.contains(&CaseName::Log) {
        agreement::check_temperature(CaseName::Log)?;
        fixed_steps(&[CaseName::Log], Form::Temperature, steps)?;
    }
    equal_errors(&cases)
}

/// The table of times per step.
fn fixed_steps(cases: &[CaseName], form: Form, steps: u32) -> Result<(), Box<dyn Error>> {
    let title = match form {
        Form::Explicit => "eem-explicit, fixed steps",
        Form::Temperature => "eem-temperature, fixed steps",
    };
    let mut rows = table::headed([title, "library ns/step", "prototype ns/step", "ratio"]);
    for &case in cases {
        let [library, prototype] =
            clock::in_turn([&mut || runs::library_steps(case, form, steps), &mut || {
                runs::prototype_steps(case, form, steps)
            }])?;
        let nanoseconds = |seconds: f64| format!("{:.0}", 1e9 * seconds / f64::from(steps));
        rows.add_row([
            format!("{}, h = {} s", case.name(), runs::step(case, form)),
            nanoseconds(library),
            nanoseconds(prototype),
            format!("{:.2}", library / prototype),
        ]);
    }
    terminal::say(format_args!("{rows}\n"));
    Ok(())
}

/// The table of times of runs with a tolerance.
fn equal_errors(cases: &[CaseName]) -> Result<(), Box<dyn Error>> {
    let mut rows = table::headed([
        "eem-explicit, error 1e-6 at 5 s",
        "library µs",
        "prototype µs",
        "dop853 µs",
        "library / prototype",
        "dop853 / library",
    ]);
    for &case in cases {
        let [library, prototype, dop853] = times_for_error(case)?;
        let microseconds =
            |time: Option<f64>| table::cell(time, |time| format!("{:.1}", 1e6 * time));
        let ratio = |a: Option<f64>, b: Option<f64>| {
            table::cell(a.zip(b), |(a, b)| format!("{:.2}", a / b))
        };
        rows.add_row([
            case.name().to_owned(),
            microseconds(library),
            microseconds(prototype),
            microseconds(dop853),
            ratio(library, prototype),
            ratio(dop853, library),
        ]);
    }
    terminal::say(rows);
    Ok(())
}

/// The times of library, prototype and DOP853 for [`ERROR`] at [`END`], s.
fn times_for_error(case: CaseName) -> Result<[Option<f64>; 3], Box<dyn Error>> {
    let dop853 = runs::Dop853::new(case, END)?;
    let mut points: [Vec<(f64, f64)>; 3] = Default::default();
    let [first, last] = TOLERANCES;
    for k in first..=last {
        let tolerance = 10.0_f64.powf(-0.5 * f64::from(k));
        let mut errors = [f64::NAN; 3];
        let [library, prototype, other] = &mut errors;
        let times = clock::in_turn([
            &mut || {
                let (state, time) = runs::library_run(case, END, tolerance)?;
                *library = dop853.error(&state);
                Ok(time)
            },
            &mut || {
                let (state, time) = runs::prototype_run(case, END, tolerance)?;
                *prototype = dop853.error(&state);
                Ok(time)
            },
            &mut || {
                let (state, time) = dop853.run(tolerance)?;
                *other = dop853.error(&state);
                Ok(time)
            },
        ])?;
        for ((points, error), time) in points.iter_mut().zip(errors).zip(times) {
            points.push((error, time));
        }
    }
    Ok(points.map(|points| time_for(&points, ERROR)))
}

//! Which scheme and which step for which accuracy: what every setting costs, and how accurate it is.
//!
//! A small step is accurate and slow, a large one fast and wrong; which scheme is the better bargain depends on
//! the scene and on the accuracy that is wanted. The library's [`Study`] runs all settings of a scene to a common
//! end time and measures their errors there:
//!
//! ```text
//! error of q = max |Δq|/|q|₂,   of p = max |Δp|/max |p|₂,   of θ = max |Δθ|/θ,   of γ = max |Δγ|/|q|₂
//! energy defect = max |B − B₀|/E over the run,   B = E − work − heat,   E = max(|E₀|, kinetic energy, |work|, |heat|)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | q, p | positions and momenta of the masses | m, kg m/s |
//! | θ, γ | temperatures of the elements, viscous stretches of the dashpots | K, m |
//! | E, B | total energy, and what the first law keeps of it | J |
//! | h | step | s |
//!
//! Differences are those from the first of two references, by Gauss collocation and by a variational integrator,
//! both of fourth order and in far smaller steps. An error is stated only where the references differ by at most
//! a hundredth of it: for a chaotic motion nobody knows the exact positions.
//!
//! | case | scene | source |
//! |---|---|---|
//! | single | the pendulum of the example `single_pendulum` | García Orden & Romero (2012) |
//! | romero, krueger, log | those of the example `double_pendulum` | Conde Martín, Betsch & García Orden (2016) |
//! | chain | 16 springs of `single_pendulum` in a row, in thermal contact, that hang on one end | chosen |
//! | stiff-chain | 12 springs of the case krueger in a row, every other one ten thousand times stiffer | chosen |
//! | shock | the quarter car of the example `shock_absorber` on its road | chosen |
//!
//! Pictures, by powers of ten: error over wall time, where lower and further left is better and the band marks
//! the settings that no other beats in both; error over the step; error over the tolerance, for the schemes that
//! also choose their steps. All show the largest error of all kinds.
//!
//! What the example claims, and fails without: the schemes that prove their laws keep energy, less work and heat,
//! to rounding with every step, and what is recommended is as accurate as it is said to be.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use eem::prelude::*;
use eem::{Advice, Setting, StateQuantity, Study, StudyReport, StudyRow};

#[path = "../shock_absorber/car.rs"]
mod car;
mod chains;
#[path = "../double_pendulum/cases.rs"]
mod double_pendulum;
mod pictures;
#[path = "../shock_absorber/road.rs"]
mod road;
#[path = "../single_pendulum/scene.rs"]
mod single_pendulum;

use eem_studies::claims::{self, Claims};
use eem_studies::command_line::{self, CommandLine};
use eem_studies::progress::Progress;
use eem_studies::{output, terminal};

const ABOUT: &str =
    "What every scheme and step costs, and how accurate it is; --step is the largest";
const HINT: &str = "Add --out DIR for the figures as CSV and two pictures.";

#[derive(Debug, Parser)]
struct Options {
    /// Which scene.
    #[arg(long, value_name = "NAME", default_value = "single")]
    case: CaseName,
    #[command(flatten)]
    common: CommandLine,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum CaseName {
    /// A thermo-visco-elastic pendulum.
    Single,
    /// A double pendulum of soft springs, strong conduction: slow.
    Romero,
    /// A double pendulum of stiff springs: fast oscillations, chaotic after some seconds.
    Krueger,
    /// A double pendulum of springs that soften when hot.
    Log,
    /// A chain of thermo-visco-elastic springs.
    Chain,
    /// A chain of thermoelastic springs, soft and stiff ones by turns.
    StiffChain,
    /// A quarter car on a rough road, whose shock absorber warms up.
    Shock,
}

/// The relative tolerance that the runs with tolerances begin with.
const LARGEST_TOLERANCE: f64 = 1e-2;

/// How many there are, each a tenth of the one before.
const TOLERANCES: u32 = 7;

/// How a case is run unless the command line says otherwise.
#[derive(Clone, Copy, Debug)]
struct Plan {
    /// s.
    end: f64,
    /// The largest step, s.
    step: f64,
    /// How often it is halved.
    halvings: u32,
}

impl CaseName {
    /// The published steps, or larger ones, halved until they resolve the fastest of the motion; the double
    /// pendulums end while they are not chaotic yet.
    const fn plan(self) -> Plan {
        let (end, step, halvings) = match self {
            Self::Single => (10.0, 0.2, 6),
            Self::Romero => (25.0, 0.25, 8),
            Self::Krueger => (double_pendulum::KRUEGER.comparable, 0.1, 6),
            Self::Log => (double_pendulum::LOG.comparable, 0.1, 6),
            Self::Chain => (2.0, 0.1, 6),
            Self::StiffChain => (0.5, 0.02, 7),
            Self::Shock => (2.0, 0.02, 6),
        };
        Plan {
            end,
            step,
            halvings,
        }
    }

    fn name(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

fn main() -> ExitCode {
    claims::verdict(run(&command_line::read(ABOUT)))
}

fn run(options: &Options) -> Result<Claims, Box<dyn Error>> {
    let plan = options.case.plan();
    let grid = options.common.time_grid(plan.step, plan.end);
    let directory = options.common.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;

    // Equal steps of at most the size asked for that hit the end time exactly.
    let end = options.common.end(plan.end);
    let largest = end / (grid.end() / grid.step).round();
    let schemes = options.common.schemes_of_any_step().into_iter();
    let mut settings: Vec<Setting> = schemes
        .flat_map(|scheme| settings(scheme, largest, plan.halvings + 1))
        .collect();
    if options.common.takes_all_schemes() {
        let chosen = Setting::by_decades(Scheme::Auto, LARGEST_TOLERANCE, TOLERANCES);
        settings.extend(chosen);
    }
    let report = study(options.case, &settings, end)?;
    terminal::say(format_args!("{report}"));
    match directory {
        Some(directory) => write(directory, &options.case.name(), &report)?,
        None => terminal::say(HINT),
    }
    check(&report)
}

/// Equal steps of many sizes; and for the schemes that keep the laws, steps that an accuracy chooses.
fn settings(scheme: Scheme, largest: f64, count: u32) -> Vec<Setting> {
    let mut settings: Vec<_> = Setting::halved(scheme, largest, count).collect();
    if scheme.is_exact() && scheme.order() > 1 {
        // A scheme of order 2 needs ten thousands of steps for what lies beyond.
        let count = if scheme.order() > 2 { TOLERANCES } else { 3 };
        settings.extend(Setting::by_decades(scheme, LARGEST_TOLERANCE, count));
    }
    settings
}

/// The study of a case.
fn study(case: CaseName, settings: &[Setting], end: f64) -> Result<StudyReport, Box<dyn Error>> {
    let double = |case: double_pendulum::Case| move || case.scene().0;
    match case {
        CaseName::Single => {
            let scene = || single_pendulum::scene(single_pendulum::CONDUCTANCE).0;
            run_study(scene, settings, end)
        }
        CaseName::Romero => run_study(double(double_pendulum::ROMERO), settings, end),
        CaseName::Krueger => run_study(double(double_pendulum::KRUEGER), settings, end),
        CaseName::Log => run_study(double(double_pendulum::LOG), settings, end),
        CaseName::Chain => run_study(chains::soft, settings, end),
        CaseName::StiffChain => run_study(chains::stiff, settings, end),
        CaseName::Shock => run_study(|| car::car(car::DAMPER).scene, settings, end),
    }
}

fn run_study<const D: usize>(
    scene: impl Fn() -> Scene<D>,
    settings: &[Setting],
    end: f64,
) -> Result<StudyReport, Box<dyn Error>> {
    let mut progress = Progress::new("study", 0);
    let study = Study::new(scene, end).settings(settings.iter().copied());
    let study = study.watch(|done, planned| {
        progress.advance_of(done, planned);
        ControlFlow::Continue(())
    });
    Ok(study.run()?)
}

/// CSV file and pictures.
fn write(directory: &Path, case: &str, report: &StudyReport) -> Result<(), Box<dyn Error>> {
    let rows: Vec<Vec<String>> = report.csv_rows().map(Vec::from).collect();
    output::write_texts(directory, "work_precision", &StudyReport::CSV_HEADS, &rows)?;
    pictures::write(directory, case, report)?;
    terminal::say(format_args!(
        "Figures and pictures: {}",
        directory.display()
    ));
    Ok(())
}

/// What rounding may do to the energy of a run, relative to itself: what it may do in one step, which the step
/// proves, adds up like a random walk.
fn energy_bound(row: &StudyRow) -> f64 {
    row.step_bound * f64::from(row.steps).sqrt()
}

/// The claims about the laws, and about what is recommended.
fn check(report: &StudyReport) -> Result<Claims, Box<dyn Error>> {
    let mut claims = Claims::default();
    for row in &report.rows {
        if row.setting.scheme.is_exact() && row.failure.is_none() {
            let what = format!("{}: the relative energy defect", row.setting);
            claims.at_most(&what, Some(row.energy_defect), energy_bound(row));
        }
    }
    for &accuracy in &report.accuracies {
        if let Advice::Take { fastest, lawful } = report.recommend(accuracy)?.advice {
            for row in [Some(fastest), lawful].into_iter().flatten() {
                let errors = StateQuantity::ALL.map(|quantity| row.error(quantity));
                let worst = errors.into_iter().flatten().fold(0.0, f64::max);
                let what = format!("{}: the largest error", row.setting);
                claims.at_most(&what, Some(worst), accuracy);
            }
        }
    }
    Ok(claims)
}

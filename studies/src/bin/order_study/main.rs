//! How the error shrinks with the step: the order of every scheme.
//!
//! The double pendulum of the example `double_pendulum --case romero`, soft springs that exchange
//! heat fast, is run to the end time in steps h, h/2, h/4, …, and compared there with a solution in
//! far smaller steps. On logarithmic axes the errors of a scheme of order n lie on a line of
//! slope n; two is the order of all schemes here but the staggered one, whose is one, and the
//! variational integrator of fourth order.
//!
//! ```text
//! error(h) = max over x ∈ {q, p, θ} of ‖x_h − x*‖/‖x*‖ at the end
//! ψ = C/2 ln²(λ/λ0) − β (θ − θr) ln(λ/λ0) + c (θ − θr − θ ln(θ/θr))
//! ```
//!
//! | symbol | meaning | value |
//! |---|---|---|
//! | q, p, m | positions, momenta, masses | q = (1, 0, 0), (2.2, 0, 0) m, p = (0, 2, 0), (1, 0, 0) kg m/s at t = 0; m = 1, 2 kg |
//! | λ, λ0 | lengths of the springs, natural lengths | λ0 = 2, 1 m |
//! | θ, θr | temperatures, that without thermal stress | θ = 380, 310 K at t = 0, θr = 300 K |
//! | C, β, c | stiffnesses, thermoelastic coupling, heat capacity | 0.1, 1 J; 0.2 J/K; 5 J/K |
//! | κ | heat conductance between the springs | 300 W/K |
//! | x* | the solution of fourth order in steps eight times smaller than the smallest | |
//!
//! Source: Conde Martín, Betsch & García Orden, Commun. Nonlinear Sci. Numer. Simul. 32 (2016),
//! §4.1, eq. 46 and figure 2. There one norm covers q, p and θ, whatever their units, so that the
//! temperatures decide; here each counts for itself.
//!
//! Heat flows between the springs with a time constant of c/2κ = 8 ms. Larger steps do not resolve
//! it, and their errors are not on the line yet: the slopes are those of the three smallest steps.
//!
//! What the example claims, and fails without: every slope is the order to within 0.1.

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use eem::prelude::*;

use eem_studies::claims::{self, Claims};
use eem_studies::command_line::CommandLine;
use eem_studies::comparison;
use eem_studies::figures::{Axes, Curve, Figure};
use eem_studies::record::Record;
use eem_studies::simulate::{self, Watched};
use eem_studies::time_grid::TimeGrid;
use eem_studies::{output, table, terminal};

const ABOUT: &str = "Errors over step sizes, and the order of every scheme; --step is the largest";
const HINT: &str = "Add --out DIR for the errors as CSV and a picture.";

/// End time of the paper, and the largest step, s.
const END: f64 = 25.0;
const STEP: f64 = 0.25;

/// How often the step is halved.
const HALVINGS: u32 = 8;

/// So many of the smallest steps decide the slope.
const FITTED: usize = 3;

/// The scheme of the reference.
const REFERENCE: Scheme = Scheme::Variational4;

/// The reference is of fourth order and halves the smallest step so often. Its error is then below
/// 1/4000 of all errors that it judges, which does not show in the slopes.
const REFERENCE_HALVINGS: u32 = 3;

/// The largest fitted step (s) for which slopes are claimed: twice c/2κ, which the midpoint of a
/// step resolves.
const RESOLVED: f64 = 2.0 * CAPACITY / (2.0 * CONDUCTANCE);

/// What a slope may differ from the order.
const SLOPE_TOLERANCE: f64 = 0.1;

const CONDUCTANCE: f64 = 300.0;
const CAPACITY: f64 = 5.0;

/// Thermoelastic spring with logarithmic strain.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    0.5 * stiffness * strain.powi(2)
        - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
struct ThermoelasticSpring {
    #[unit("J")]
    stiffness: f64,
    #[unit("J/K")]
    coupling: f64,
    #[unit("J/K")]
    capacity: f64,
    #[unit("m")]
    natural_length: f64,
    #[unit("K")]
    theta_ref: f64,
}

const SPRINGS: [ThermoelasticSpring; 2] = [
    ThermoelasticSpring {
        stiffness: 0.1,
        coupling: 0.2,
        capacity: CAPACITY,
        natural_length: 2.0,
        theta_ref: 300.0,
    },
    ThermoelasticSpring {
        stiffness: 1.0,
        coupling: 0.2,
        capacity: CAPACITY,
        natural_length: 1.0,
        theta_ref: 300.0,
    },
];

/// The pendulum at t = 0, and what to record of it.
fn pendulum(scheme: Scheme, step: f64) -> Result<(Simulation<3>, Watched), SceneError> {
    let mut scene = Scene::<3>::new();
    let anchor = scene.anchor([0.0; 3]);
    let first = scene.mass(1.0, [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
    let second = scene.mass(2.0, [2.2, 0.0, 0.0], [0.5, 0.0, 0.0]);
    let springs = [
        scene.spring(SPRINGS[0], [anchor, first]),
        scene.spring(SPRINGS[1], [first, second]),
    ];
    scene.set_temperature(springs[0], 380.0);
    scene.set_temperature(springs[1], 310.0);
    scene.conduct(springs[0], springs[1], CONDUCTANCE);
    let watched = Watched {
        masses: vec![first, second],
        elements: springs.to_vec(),
        has_reservoirs: false,
    };
    Ok((Simulation::new(scene, scheme, step)?, watched))
}

/// The errors of one scheme.
#[derive(Debug)]
struct Study {
    scheme: Scheme,
    /// Steps (s) and errors, the largest step first; not a number where the run failed.
    points: Vec<(f64, f64)>,
}

fn main() -> ExitCode {
    claims::verdict(run(&CommandLine::read(ABOUT)))
}

fn run(command_line: &CommandLine) -> Result<Claims, Box<dyn Error>> {
    let largest = command_line.time_grid(STEP, END);
    let directory = command_line.out.as_deref();
    directory.map_or(Ok(()), output::prepare)?;

    let exact = end_state(REFERENCE, largest.halved(HALVINGS + REFERENCE_HALVINGS))?;
    let mut studies = Vec::new();
    for scheme in command_line.schemes() {
        let mut points = Vec::new();
        for halvings in 0..=HALVINGS {
            let grid = largest.halved(halvings);
            points.push((grid.step, error(&end_state(scheme, grid)?, &exact)));
        }
        studies.push(Study { scheme, points });
    }
    print(&studies);
    match directory {
        Some(directory) => write(directory, &studies)?,
        None => terminal::say(HINT),
    }
    Ok(check(&studies))
}

/// The state at the end; only the initial one when the run fails.
fn end_state(scheme: Scheme, grid: TimeGrid) -> Result<Record, Box<dyn Error>> {
    let (mut simulation, watched) = pendulum(scheme, grid.step)?;
    let name = format!("{}, h = {:.2e} s", scheme.name(), grid.step);
    simulate::record(&name, &mut simulation, &watched, grid)
}

/// max over x ∈ {q, p, θ} of ‖x − x*‖/‖x*‖ at the end.
fn error(run: &Record, exact: &Record) -> f64 {
    if !(run.completed() && exact.completed()) {
        return f64::NAN;
    }
    let error_of = |name: &str| {
        let end = |record: &Record| record.vectors(|column| column.starts_with(name)).pop();
        let (x, exact) = (end(run)?, end(exact)?);
        let squares = x.iter().zip(&exact).map(|(x, exact)| (x - exact).powi(2));
        let size: f64 = exact.iter().map(|exact| exact.powi(2)).sum();
        Some((squares.sum::<f64>() / size).sqrt())
    };
    let errors = ["q", "p", "theta"].map(|name| error_of(name).unwrap_or(f64::NAN));
    errors.into_iter().fold(0.0, f64::max)
}

impl Study {
    /// The points that decide the slope.
    fn fitted(&self) -> &[(f64, f64)] {
        &self.points[self.points.len() - FITTED..]
    }

    /// The slope of the least-squares line through the smallest steps, on logarithmic axes.
    fn slope(&self) -> f64 {
        let points = || self.fitted().iter().map(|(h, error)| [h.ln(), error.ln()]);
        let count = points().map(|_| 1.0).sum::<f64>();
        let [x, y] = [0, 1].map(|axis| points().map(|point| point[axis]).sum::<f64>() / count);
        let above: f64 = points().map(|[h, error]| (h - x) * (error - y)).sum();
        let below: f64 = points().map(|[h, _]| (h - x).powi(2)).sum();
        above / below
    }

    fn is_resolved(&self) -> bool {
        self.fitted()[0].0 <= RESOLVED
    }
}

/// The table of errors and slopes.
fn print(studies: &[Study]) {
    let steps = studies.first().map_or(&[][..], |study| &study.points);
    let heads = steps
        .iter()
        .map(|(step, _)| format!("{:.2} ms", 1e3 * step));
    let mut table = table::headed(
        ["scheme".to_owned()]
            .into_iter()
            .chain(heads)
            .chain(["slope".to_owned()]),
    );
    for study in studies {
        let errors = study.points.iter().map(|(_, error)| format!("{error:.1e}"));
        table.add_row(
            [study.scheme.name().to_owned()]
                .into_iter()
                .chain(errors)
                .chain([format!("{:.3}", study.slope())]),
        );
    }
    terminal::say(format_args!("{table}\n"));
    terminal::say(format_args!(
        "Relative errors at the end; slopes of the {FITTED} smallest steps on logarithmic axes."
    ));
}

/// The claims about the slopes, if the steps are small enough to have one.
fn check(studies: &[Study]) -> Claims {
    let mut claims = Claims::default();
    if !studies.iter().all(Study::is_resolved) {
        terminal::say(format_args!(
            "Slopes are claimed when the fitted steps are at most {:.1} ms.",
            1e3 * RESOLVED
        ));
        return claims;
    }
    // One of higher order than the reference comes so close to it that its slope says nothing here.
    let judged = |study: &&Study| study.scheme.order() <= REFERENCE.order();
    for study in studies.iter().filter(judged) {
        claims.at_most(
            &format!("{}: |slope − order|", study.scheme.name()),
            Some((study.slope() - f64::from(study.scheme.order())).abs()),
            SLOPE_TOLERANCE,
        );
    }
    claims
}

/// The errors as CSV, and the picture.
fn write(directory: &Path, studies: &[Study]) -> Result<(), Box<dyn Error>> {
    let names = studies.iter().map(|study| study.scheme.name());
    let heads: Vec<&str> = ["step"].into_iter().chain(names).collect();
    let row = |halvings: usize| {
        let errors = studies.iter().map(|study| study.points[halvings].1);
        let step = studies.first().map(|study| study.points[halvings].0);
        step.into_iter().chain(errors).collect()
    };
    let rows: Vec<Vec<f64>> = (0..=HALVINGS as usize).map(row).collect();
    output::write_numbers(directory, "order_study", &heads, &rows)?;
    let figure = Figure {
        title: "Conde Martín et al. (2016), figure 2: errors, with fitted slopes".to_owned(),
        x_label: "step h (s)".to_owned(),
        y_label: "relative error".to_owned(),
        curves: guides(studies)
            .into_iter()
            .chain(studies.iter().map(Study::curve))
            .collect(),
        axes: Axes::DoublyLogarithmic,
    };
    figure.write_svg(&directory.join("conde_martin_2016_figure_02_errors.svg"))?;
    terminal::say(format_args!("Errors and picture: {}", directory.display()));
    Ok(())
}

impl Study {
    fn curve(&self) -> Curve {
        let name = self.scheme.name();
        Curve {
            label: format!("{name} ({:.2})", self.slope()),
            points: self.points.clone(),
            look: comparison::look(name),
            trusted: true,
            decisive: usize::MAX,
        }
    }
}

/// A line for every order, along the fitted steps of its most accurate scheme and below it.
fn guides(studies: &[Study]) -> Vec<Curve> {
    const BELOW: f64 = 0.5;
    let least = |study: &Study| study.points[HALVINGS as usize];
    let guide = |slope: f64| {
        let same = studies
            .iter()
            .filter(|study| f64::from(study.scheme.order()).total_cmp(&slope).is_eq());
        let best = same.min_by(|a, b| least(a).1.total_cmp(&least(b).1))?;
        let (step, error) = least(best);
        let line = |&(h, _): &(f64, f64)| (h, BELOW * error * (h / step).powf(slope));
        Some(Curve {
            label: format!("slope {slope}"),
            points: best.fitted().iter().map(line).collect(),
            look: 0,
            trusted: true,
            decisive: usize::MAX,
        })
    };
    [1.0, 2.0, 4.0].into_iter().filter_map(guide).collect()
}

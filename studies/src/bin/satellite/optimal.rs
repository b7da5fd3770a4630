//! The thrust over time that turns the satellite by an angle and leaves it at rest.
//!
//! ```text
//! J = ½ Σ (q − d)²/σ² + K/K_σ + ½ ∫ F²/F_σ² dt/T       at the end T, by 40 values of the thrust F, T/40 each
//! ```
//!
//! with the positions q of two nodes of the body and of the tips of both panels, their places d in a body that is turned and
//! stiff, and the kinetic energy K. One gradient of the run is the derivative by all 40 values, checked along the run; L-BFGS of the crate
//! `argmin` finds the least J from the thrust that would do for a stiff satellite: +F, then −F.

use std::error::Error;
use std::path::Path;

use eem::prelude::*;
use eem::{History, Objective};
use eem_studies::claims::Claims;
use eem_studies::figures::{Axes, Curve, Figure, write_stack};
use eem_studies::least;
use eem_studies::progress::Progress;
use eem_studies::record::Record;
use eem_studies::time_grid::TimeGrid;
use eem_studies::{simulate, table, terminal};

use super::balance::keeps_both_laws;
use super::scene::{self, Axis, Satellite, satellite};
use super::{ATTITUDE, watched};

/// Values of the thrust.
const VALUES: u8 = 40;

/// What positions (m), the kinetic energy (J) and the thrust (N) may be off by: 0.05° of the body, and hardly any thrust.
const LENGTH: f64 = 5e-4;
const ENERGY: f64 = 1e-6;
const FORCE: f64 = 10.0;

/// Moment of inertia of the satellite about the axis of the hinges as if it were stiff, kg m².
const INERTIA: f64 = 144.0;

/// In how many runs J must fall by how much.
const MOST_RUNS: usize = 40;
const FALL: f64 = 100.0;

/// Runs are so long for the fall to be claimed, s.
const LONG: f64 = scene::END;

/// What is run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    pub(crate) axis: Axis,
    pub(crate) scheme: Scheme,
    /// By how much it is to turn, rad.
    pub(crate) angle: f64,
    pub(crate) grid: TimeGrid,
    /// Most iterations of the optimiser.
    pub(crate) iterations: u64,
}

/// A thrust and what follows from it.
#[derive(Clone, Debug)]
struct Point {
    thrust: Vec<f64>,
    objective: f64,
    gradient: Vec<f64>,
    record: Record,
}

impl Aim {
    /// How long each value of the thrust is held, s.
    fn held(self) -> f64 {
        self.grid.end() / f64::from(VALUES)
    }

    /// +F for the first half of the time, −F for the second, which turns what is stiff by the angle: `F (T/2)² = I α` with arms
    /// of half a metre for two rockets.
    fn start(self) -> Vec<f64> {
        let half = 0.5 * self.grid.end();
        let force = INERTIA * self.angle / (half * half);
        (0..VALUES)
            .map(|i| if 2 * i < VALUES { force } else { -force })
            .collect()
    }

    /// Steps to the end with a thrust.
    fn run(self, thrust: &[f64]) -> Result<Point, Box<dyn Error>> {
        let (held, values) = (self.held(), thrust.to_vec());
        let at = move |t: f64| values[value_at(t, held)];
        let satellite = satellite(self.axis, at)?;
        let places = places(&satellite)?;
        let rockets = satellite.rockets;
        let (watched, further) = watched(&satellite, self.axis);
        let mut run = Simulation::new(satellite.scene, self.scheme, self.grid.step)?;
        let mut objective = Objective::at_end(Quantity::KineticEnergy).times(1.0 / ENERGY);
        for node in places {
            let at_start = run.position(node)?;
            let turned = self.axis.turned(at_start.into(), self.angle);
            for (i, place) in turned.into_iter().enumerate() {
                let data = [[self.grid.end(), place, LENGTH]];
                let off = Objective::misfit(Quantity::Position(node), data);
                objective = objective + off.component(i);
            }
        }
        run.keep_history(History::default());
        let name = self.scheme.name();
        let record = simulate::record_with(name, &mut run, &watched, self.grid, further)?;
        let found = run.gradient(&objective)?;
        run.check_gradient(&found, &objective)?;
        let share = 1.0 / (f64::from(VALUES) * FORCE * FORCE);
        let effort = 0.5 * share * thrust.iter().map(|f| f * f).sum::<f64>();
        let mut gradient: Vec<f64> = thrust.iter().map(|f| share * f).collect();
        for node in rockets {
            for &(time, by_thrust) in found.by_thrust(node, 0)?.iter() {
                gradient[value_at(time, held)] += by_thrust;
            }
        }
        Ok(Point {
            thrust: thrust.to_vec(),
            objective: found.value() + effort,
            gradient,
            record,
        })
    }
}

/// Which value the thrust has at a time.
fn value_at(time: f64, held: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "times are not negative, and there are 40 values"
    )]
    let value = (time / held) as usize;
    value.min(usize::from(VALUES) - 1)
}

/// Two nodes of the body and the tips of the panels.
fn places(satellite: &Satellite) -> Result<[Node; 4], Box<dyn Error>> {
    let [right, left] = &satellite.panels;
    let tips = [
        right.node_at([scene::TIP, 0.0, 0.0], 0.0)?,
        left.node_at([-scene::TIP, 0.0, 0.0], 0.0)?,
    ];
    let [tail, head] = satellite.line;
    Ok([tail, head, tips[0], tips[1]])
}

/// Finds the thrust, prints and draws it.
pub(crate) fn run(aim: Aim, directory: Option<&Path>) -> Result<Claims, Box<dyn Error>> {
    let start = aim.run(&aim.start())?;
    // The optimiser sees the thrust in a unit, N, that makes its first step, `−dJ/dx`, about that to the least value of a
    // parabola that touches 0: a power of two, so that nothing is rounded.
    let slope: f64 = start.gradient.iter().map(|g| g * g).sum();
    let unit = (0.5 * (2.0 * start.objective / slope).log2())
        .round()
        .exp2();
    let in_units = |point: Point| least::Point {
        place: point.thrust.iter().map(|f| f / unit).collect(),
        value: point.objective,
        gradient: point.gradient.iter().map(|g| g * unit).collect(),
        of: point,
    };
    let mut progress = Progress::new("runs", MOST_RUNS);
    let mut runs = 1;
    let until = (aim.iterations, f64::EPSILON);
    let mut made = least::search(in_units(start), until, |place| {
        let thrust: Vec<f64> = place.iter().map(|x| x * unit).collect();
        let point = aim.run(&thrust)?;
        runs += 1;
        progress.advance(runs);
        Ok(in_units(point))
    })?;
    made.truncate(MOST_RUNS);
    let ends = [made.first(), least::least(&made)];
    let ends = ends.map(|point| point.map(|point| &point.of).ok_or("nothing was run"));
    let [first, best] = [ends[0]?, ends[1]?];
    print([first, best], made.len());
    if let Some(directory) = directory {
        draw(aim, [first, best], directory)?;
    }
    let mut claims = Claims::default();
    for point in &made {
        keeps_both_laws(&point.of.record, &mut claims);
    }
    if aim.grid.end() >= LONG {
        let fall = first.objective / best.objective;
        claims.at_least("the fall of J", Some(fall), FALL);
    }
    Ok(claims)
}

const NAMES: [&str; 2] = ["for a stiff satellite", "optimal"];

fn print(points: [&Point; 2], runs: usize) {
    let mut table = table::headed([
        "thrust",
        "J",
        "turn (°)",
        "kinetic energy (J)",
        "largest thrust (N)",
        "off by (J)",
    ]);
    for (name, point) in NAMES.iter().zip(points) {
        let largest = point
            .thrust
            .iter()
            .fold(0.0_f64, |most, f| most.max(f.abs()));
        table.add_row([
            (*name).to_owned(),
            format!("{:.3e}", point.objective),
            table::last(&point.record, ATTITUDE, |turn| format!("{turn:.4}")),
            table::last(&point.record, "kinetic", |energy| format!("{energy:.2e}")),
            format!("{largest:.3}"),
            table::first_law_defect(&point.record),
        ]);
    }
    terminal::say(format_args!("{table}\n\n{runs} runs with their gradients."));
}

/// Thrust, attitude and kinetic energy over time.
fn draw(aim: Aim, points: [&Point; 2], directory: &Path) -> Result<(), Box<dyn Error>> {
    let figure =
        |what: &str, y_label: &str, points_of: &dyn Fn(&Point) -> Vec<(f64, f64)>| Figure {
            title: format!(
                "A satellite that turns by {:.0}°: {what}",
                aim.angle.to_degrees()
            ),
            x_label: "time (s)".to_owned(),
            y_label: y_label.to_owned(),
            curves: NAMES
                .iter()
                .zip(points)
                .enumerate()
                .map(|(look, (name, point))| {
                    let points = points_of(point);
                    Curve {
                        label: (*name).to_owned(),
                        decisive: points.len(),
                        points,
                        look,
                        trusted: true,
                    }
                })
                .collect(),
            axes: Axes::Even,
        };
    let thrust = |point: &Point| {
        let ends = point.thrust.iter().zip(0_u32..);
        ends.flat_map(|(&f, i)| [(f64::from(i), f), (f64::from(i + 1), f)])
            .map(|(i, f)| (i * aim.held(), f))
            .collect()
    };
    let figures = [
        figure("thrust of each rocket", "thrust (N)", &thrust),
        figure("its attitude", "turn of the body (°)", &|point| {
            point.record.points("time", ATTITUDE)
        }),
        figure("its motion", "kinetic energy (J)", &|point| {
            point.record.points("time", "kinetic")
        }),
    ];
    write_stack(&figures, &directory.join("optimal.svg"))
}

//! What steps cost on this machine: the tables of `docs/performance.md` and `docs/choosing.md`, as Markdown.
//!
//! ```text
//! cargo run --release -p eem-studies --bin cost_tables
//! ```
//!
//! Times are the fastest of several runs; they mean something on a machine that does nothing else. A time per step is
//! the mean over a whole run, with all Newton iterations; a time per iteration is that of a step in motion divided by its
//! iterations. The last table has, for each scheme and error, the fastest setting that reaches it: constant steps of many
//! sizes, and steps by tolerances.

use std::error::Error;
use std::ops::ControlFlow;
use std::time::Instant;

use eem::kinematics::Hex8;
use eem::materials::{SaintVenantKirchhoff, ThermoelasticSpring};
use eem::prelude::*;
use eem::{Setting, Study, StudyRow};
use eem_studies::pendulums::{self as single_pendulum, Double, single};
use eem_studies::progress::Progress;
use eem_studies::{table, terminal};

#[path = "satellite/scene.rs"]
#[allow(dead_code, reason = "the study uses all of it")]
mod satellite;

type Found<T> = Result<T, Box<dyn Error>>;

/// Runs of which the fastest counts.
const REPEATS: usize = 7;

/// Cells along the edges of the cubes, and nodes along those of the lattice.
const CUBES: [usize; 3] = [5, 10, 20];
const LATTICE: usize = 316;

/// Until when the settings are compared, s, and the errors that they have to reach.
const END: f64 = 5.0;
const ERRORS: [f64; 3] = [1e-2, 1e-4, 1e-6];

/// Whose settings are compared.
const COMPARED: [Scheme; 4] = [
    Scheme::EemTemperature,
    Scheme::Variational4,
    Scheme::EemEntropy6,
    Scheme::EemExplicit,
];

fn main() -> Found<()> {
    let mut progress = Progress::new("tables", 0);
    steps(&mut progress)?;
    iterations(&mut progress)?;
    errors(&mut progress)
}

/// The fastest time of a run that makes this many steps, divided by them, s.
fn per_step<const D: usize>(
    scene: impl Fn() -> Scene<D>,
    scheme: Scheme,
    [step, end]: [f64; 2],
) -> Found<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..REPEATS {
        let mut run = Simulation::new(scene(), scheme, step)?;
        let start = Instant::now();
        run.run_until(end)?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    Ok(least * step / end)
}

/// Of the published pendulums.
fn steps(progress: &mut Progress) -> Found<()> {
    let schemes = [
        Scheme::EemTemperature,
        Scheme::EemEntropy,
        Scheme::EemExplicit,
    ];
    let heads = schemes.map(|scheme| format!("`{scheme}`"));
    let mut table = table::headed(["case".to_owned()].into_iter().chain(heads));
    let mut add = |case: &str, time: &dyn Fn(Scheme) -> Found<f64>| -> Found<()> {
        let mut row = vec![case.to_owned()];
        for scheme in schemes {
            row.push(format!("{:.2} µs", 1e6 * time(scheme)?));
        }
        table.add_row(row);
        Ok(())
    };
    add("single", &|scheme| {
        per_step(|| single().scene, scheme, [0.01, 20.0])
    })?;
    // In steps in which the explicit scheme is stable, up to where all arrive.
    for (name, case, span) in [
        ("romero", Double::ROMERO, [0.02, 20.0]),
        ("krueger", Double::KRUEGER, [0.02, 5.0]),
        ("log", Double::LOG, [0.01, 5.0]),
    ] {
        add(name, &|scheme| {
            per_step(|| case.build().scene, scheme, span)
        })?;
        progress.advance(1);
    }
    terminal::say(format_args!("Time of a step:\n\n{table}\n"));
    Ok(())
}

/// The fastest time of an iteration of a step in motion, s, and how many unknowns it has.
fn per_iteration<const D: usize>(scene: Scene<D>, step: f64) -> Found<(f64, usize)> {
    let mut run = Simulation::new(scene, Scheme::EemTemperature, step)?;
    // The first step reserves the memory of the factors.
    run.step()?;
    let mut least = f64::INFINITY;
    for _ in 0..REPEATS {
        let start = Instant::now();
        let iterations = run.step()?.iterations;
        let time = start.elapsed().as_secs_f64();
        least = least.min(time / f64::from(u32::try_from(iterations)?));
    }
    Ok((least, run.unknowns()))
}

/// Of large systems.
fn iterations(progress: &mut Progress) -> Found<()> {
    let mut table = table::headed(["case", "unknowns", "time of an iteration"]);
    let mut add = |case: String, (time, unknowns): (f64, usize)| {
        table.add_row([case, unknowns.to_string(), format!("{:.2} ms", 1e3 * time)]);
        progress.advance(1);
    };
    let scene = satellite::satellite(satellite::Axis::Z, |t| satellite::thrust(t, false))?.scene;
    add(
        "satellite".to_owned(),
        per_iteration(scene, satellite::STEP)?,
    );
    for cells in CUBES {
        let case = format!("cube of {cells}³ hexahedra");
        add(case, per_iteration(cube(cells)?, 0.01)?);
    }
    let case = format!("lattice of {LATTICE}² nodes");
    add(case, per_iteration(lattice(LATTICE), 0.01)?);
    terminal::say(format_args!("Newton's method:\n\n{table}\n"));
    Ok(())
}

/// A cube of 1 m that turns and shears.
fn cube(cells: usize) -> Found<Scene<3>> {
    let mesh = Mesh::<Hex8, 3>::block([cells; 3], [[-0.5, 0.5]; 3])?;
    let mut scene = Scene::new();
    let rubber = SaintVenantKirchhoff {
        lame: 2000.0,
        shear: 1000.0,
    };
    let body = scene.solid(rubber, &mesh, &Bulk::new(10.0));
    for (&node, &[x, y, z]) in body.nodes().iter().zip(body.mesh().nodes()) {
        scene.set_velocity(node, [z - y + 0.1 * y * z, x, 0.1 * x - x]);
    }
    Ok(scene)
}

/// A square lattice of thermoelastic springs of 1 m, in motion.
fn lattice(side: usize) -> Scene<2> {
    let wave = |index: usize, phase: f64| {
        (0.7 * f64::from(u32::try_from(index).unwrap_or(0)) + phase).sin()
    };
    let mut scene = Scene::new();
    let mut nodes = Vec::new();
    for index in 0..side * side {
        let at = [index % side, index / side].map(|line| u32::try_from(line).unwrap_or(0));
        let position = [0, 1].map(|axis| {
            let phase = if axis == 0 { 0.0 } else { 1.0 };
            f64::from(at[axis]) + 0.02 * wave(index, phase)
        });
        nodes.push(scene.mass(1.0, position, [wave(index, 2.0), wave(index, 3.0)]));
    }
    for index in 0..nodes.len() {
        let right = (index % side + 1 < side).then_some(index + 1);
        for other in [right, Some(index + side)].into_iter().flatten() {
            if let Some(&end) = nodes.get(other) {
                let spring = scene.spring(SPRING, [nodes[index], end]);
                scene.set_temperature(spring, 300.0 + 10.0 * wave(index, 4.0));
            }
        }
    }
    scene
}

/// Of the lattice.
const SPRING: ThermoelasticSpring = ThermoelasticSpring {
    stiffness: 5000.0,
    natural_length: 1.0,
    coupling: 20.0,
    capacity: 2000.0,
    theta_ref: 300.0,
};

/// The fastest setting of each scheme for each error.
fn errors(progress: &mut Progress) -> Found<()> {
    let heads = COMPARED.map(|scheme| scheme.to_string());
    let heads = ["scene", "error"]
        .map(str::to_owned)
        .into_iter()
        .chain(heads);
    let mut table = table::headed(heads);
    let cases = [
        ("single", run(|| single().scene, 0.2, progress)?),
        (
            "krueger",
            run(|| Double::KRUEGER.build().scene, 0.1, progress)?,
        ),
        ("log", run(|| Double::LOG.build().scene, 0.1, progress)?),
    ];
    for (case, rows) in cases {
        for error in ERRORS {
            let fastest = COMPARED.map(|scheme| fastest(&rows, scheme, error));
            table.add_row(
                [case.to_owned(), format!("{error:.0e}")]
                    .into_iter()
                    .chain(fastest),
            );
        }
    }
    let what = format!("Time in ms, and number of steps, to simulate {END} s");
    terminal::say(format_args!("{what}:\n\n{table}"));
    Ok(())
}

/// The results of all settings, with constant steps from this one on.
fn run<const D: usize>(
    scene: impl Fn() -> Scene<D>,
    largest: f64,
    progress: &mut Progress,
) -> Found<Vec<StudyRow>> {
    let study = Study::new(scene, END).settings(settings(largest));
    let study = study.watch(|done, planned| {
        progress.advance_of(done, planned);
        ControlFlow::Continue(())
    });
    Ok(study.run()?.rows)
}

/// Time and number of steps of the fastest run of a scheme with at most this error.
fn fastest(rows: &[StudyRow], scheme: Scheme, error: f64) -> String {
    let own = rows.iter().filter(|row| row.setting.scheme == scheme);
    let accurate = own.filter(|row| row.largest_error().stated().is_some_and(|own| own <= error));
    let fastest = accurate.min_by(|a, b| a.seconds.total_cmp(&b.seconds));
    table::cell(fastest, |row| {
        format!("{:.2} ({})", 1e3 * row.seconds, row.steps)
    })
}

/// Constant steps from this one on, and steps by tolerances, for the schemes that can change them.
fn settings(largest: f64) -> impl Iterator<Item = Setting> {
    COMPARED.into_iter().flat_map(move |scheme| {
        let halved = Setting::halved(scheme, largest, 7);
        let count = if scheme.order() > 2 { 7 } else { 3 };
        let decades = Setting::by_decades(scheme, 1e-2, count);
        halved.chain(decades.filter(move |_| scheme.may_change_steps()))
    })
}

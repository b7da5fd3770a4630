//! The model: the quarter car with a damper of three unknown numbers, driven over its track.

use std::error::Error;

use eem::prelude::*;
use eem::{History, Input, MemberError, MemberFailure};

use super::car::{CLEARANCE, Car, DAMPER, Damper, car};
use eem_studies::time_grid::TimeGrid;

/// Takes equal steps whatever the stiffness is, and keeps both laws.
pub(crate) const SCHEME: Scheme = Scheme::EemEntropy;

/// What is recovered.
pub(crate) const UNKNOWNS: [Unknown; 3] = [
    unknown("stiffness μ", "stiffness μ (N/m)", "mount", DAMPER.mount),
    unknown("viscosity η0", "viscosity η0 (N s/m)", "eta0", DAMPER.eta0),
    unknown(
        "heat capacity c",
        "heat capacity c (J/K)",
        "capacity",
        DAMPER.capacity,
    ),
];

/// A number of the damper.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unknown {
    pub(crate) name: &'static str,
    pub(crate) label: &'static str,
    /// Its field.
    parameter: &'static str,
    /// What the recording is made with.
    pub(crate) truth: f64,
}

const fn unknown(
    name: &'static str,
    label: &'static str,
    parameter: &'static str,
    truth: f64,
) -> Unknown {
    Unknown {
        name,
        label,
        parameter,
        truth,
    }
}

/// Natural logarithms of the unknowns in the units of [`UNKNOWNS`]: all numbers are positive, and a change is
/// relative.
pub(crate) type Logs = [f64; 3];

/// The logarithms that the fit has to find.
pub(crate) fn truth() -> Logs {
    UNKNOWNS.map(|unknown| unknown.truth.ln())
}

/// What a damper with these numbers is.
fn damper(logs: &Logs) -> Damper {
    let mut damper = DAMPER;
    [damper.mount, damper.eta0, damper.capacity] = logs.map(f64::exp);
    damper
}

/// What sensors would show without noise, and how well the laws were kept.
#[derive(Clone, Debug, Default)]
pub(crate) struct Drive {
    /// Travel of the suspension, m.
    pub(crate) travel: Vec<f64>,
    /// Temperature of the damper, K.
    pub(crate) temperature: Vec<f64>,
    pub(crate) laws: Laws,
}

/// How well runs keep both laws.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Laws {
    /// max |B − B₀| with B = E − work − heat, as a share of the largest heat c θ in it.
    pub(crate) balance_defect: f64,
    /// The largest loss of S in a step as a share of |S|: negative by the second law.
    pub(crate) entropy_loss: f64,
}

impl Laws {
    /// No run yet.
    pub(crate) const NONE: Self = Self {
        balance_defect: 0.0,
        entropy_loss: f64::NEG_INFINITY,
    };

    /// The worse of both; not a number where one is not.
    pub(crate) fn and(self, other: Self) -> Self {
        let worse = |a: f64, b: f64| if a.is_nan() || a > b { a } else { b };
        Self {
            balance_defect: worse(self.balance_defect, other.balance_defect),
            entropy_loss: worse(self.entropy_loss, other.entropy_loss),
        }
    }
}

/// Drives dampers over the track: each run is a member of an ensemble.
pub(crate) fn drive(grid: TimeGrid, dampers: &[Logs]) -> Vec<Result<Drive, MemberError>> {
    Ensemble::new(SCHEME, grid.step).run(dampers, build, |run, parts, logs| {
        observe(run, parts, logs, grid)
    })
}

/// How travel and temperature change with each unknown.
type Changes = [[Vec<f64>; 2]; 3];

/// A drive, and how its travel, m, and temperature, K, change with the logarithm of each unknown.
pub(crate) fn follow(
    grid: TimeGrid,
    logs: &Logs,
) -> Result<(Drive, Changes), Box<dyn Error + Send + Sync>> {
    let (scene, damper) = build(logs);
    let mut run = Simulation::new(scene, SCHEME, grid.step)?;
    run.keep_history(History::default());
    let drive = observe(&mut run, damper, logs, grid)?;
    let inputs = UNKNOWNS.map(|unknown| Input::parameter(damper, unknown.parameter));
    let sensors = [
        ("travel", Quantity::Stretch(damper)),
        ("temperature", Quantity::Temperature(damper)),
    ];
    let table = run.sensitivities(&inputs, sensors)?;
    let changes = [0, 1, 2].map(|unknown| {
        [0, 1].map(|sensor| {
            let column = table.of(sensor, unknown).unwrap_or_default();
            let recorded = column.iter().step_by(grid.stride).skip(1);
            // ∂/∂ln p = p ∂/∂p
            recorded.map(|by| logs[unknown].exp() * by).collect()
        })
    });
    Ok((drive, changes))
}

/// The car at rest with this damper.
pub(crate) fn build(logs: &Logs) -> (Scene<1>, Element) {
    let Car {
        scene,
        parts: [_, _, damper],
        ..
    } = car(damper(logs));
    (scene, damper)
}

/// Runs to the end; one state of `grid.stride` is recorded, the laws are checked in every step.
pub(crate) fn observe(
    run: &mut Simulation<1>,
    damper: Element,
    logs: &Logs,
    grid: TimeGrid,
) -> Result<Drive, MemberFailure> {
    let start = run.ledger();
    let capacity = logs[2].exp();
    let mut entropy = start.entropy;
    let mut drive = Drive {
        laws: Laws::NONE,
        ..Drive::default()
    };
    for step in 1..=grid.steps {
        run.step()?;
        let ledger = run.ledger();
        let temperature = run.temperature(damper)?;
        drive.laws = drive.laws.and(Laws {
            balance_defect: (ledger.balance - start.balance).abs() / (capacity * temperature),
            entropy_loss: (entropy - ledger.entropy) / entropy.abs(),
        });
        entropy = ledger.entropy;
        if step % grid.stride == 0 {
            drive.travel.push(run.stretch(damper)? - CLEARANCE);
            drive.temperature.push(temperature);
        }
    }
    Ok(drive)
}

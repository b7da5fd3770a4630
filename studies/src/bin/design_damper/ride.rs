//! A car on its lap: how it is shaken, how much room the suspension takes, and the derivatives of both by the design.

use std::error::Error;

use eem::prelude::*;
use eem::{History, Objective};

use super::car::{BODY, CLEARANCE, Car, DAMPER, GRAVITY, SUSPENSION, car_on};
use eem_studies::record::Record;
use eem_studies::simulate::{self, Watched};
use eem_studies::time_grid::TimeGrid;

/// What the car has to carry besides, kg.
const LOAD: f64 = 75.0;

/// Natural logarithms of η0 (N s/m) and `k_s` (N/m), less those of the car as it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Design(pub(crate) [f64; 2]);

impl Design {
    /// The car as it was.
    pub(crate) const FIRST: Self = Self([0.0; 2]);

    /// η0, N s/m.
    pub(crate) fn viscosity(self) -> f64 {
        DAMPER.eta0 * self.0[0].exp()
    }

    /// `k_s`, N/m.
    pub(crate) fn stiffness(self) -> f64 {
        SUSPENSION * self.0[1].exp()
    }

    /// By how much a load lowers the car, m.
    fn sag(self) -> f64 {
        LOAD * GRAVITY / self.stiffness()
    }
}

/// What a ride is like.
#[derive(Clone, Debug)]
pub(crate) struct Ride {
    /// Root mean squares of the acceleration of the body, m/s², and of the travel, m.
    pub(crate) acceleration: f64,
    pub(crate) travel: f64,
    /// √(travel² + sag²), m.
    pub(crate) room: f64,
    /// Of the damper at the end, K.
    pub(crate) temperature: f64,
    pub(crate) record: Record,
}

/// A function of the squares of acceleration and room: its derivatives by both.
pub(crate) type Slopes = [f64; 2];

/// Drives a car; with slopes, also the derivatives of the function by the design.
pub(crate) fn drive(
    scheme: Scheme,
    grid: TimeGrid,
    design: Design,
    slopes: Option<Slopes>,
) -> Result<(Ride, [f64; 2]), Box<dyn Error>> {
    let mut damper = DAMPER;
    damper.eta0 = design.viscosity();
    let load = damper.load_beside();
    let Car {
        scene,
        wheel,
        body,
        parts,
        ..
    } = car_on(design.stiffness(), damper);
    let [_, spring, damper] = parts;
    let watched = Watched {
        masses: vec![wheel, body],
        elements: vec![damper],
        has_reservoirs: true,
    };
    let further = [
        ("length", Quantity::Stretch(spring)),
        ("work", Quantity::Ledger(|ledger| ledger.work)),
        ("balance", Quantity::Ledger(|ledger| ledger.balance)),
    ];
    let mut run = Simulation::new(scene, scheme, grid.step)?;
    if slopes.is_some() {
        run.keep_history(History::default());
    }
    let record = simulate::record_with(scheme.name(), &mut run, &watched, grid, further)?;
    let column = |name: &str| record.column(name).ok_or("a column is missing");
    let speeds: Vec<f64> = column("p2_x")?.iter().map(|p| p / BODY).collect();
    let times = column("time")?;
    let (step, end) = (grid.step, grid.end());
    let changes = speeds.windows(2).map(|pair| (pair[1] - pair[0]).powi(2));
    let squares = column("length")?
        .iter()
        .map(|length| (length - CLEARANCE).powi(2));
    let sag = design.sag();
    let travel = (squares.sum::<f64>() * step / end).sqrt();
    let ride = Ride {
        acceleration: (changes.sum::<f64>() / (step * end)).sqrt(),
        travel,
        room: travel.hypot(sag),
        temperature: run.temperature(damper)?,
        record: record.clone(),
    };
    let Some([by_acceleration, by_room]) = slopes else {
        return Ok((ride, [0.0; 2]));
    };
    // ∂/∂vᵢ of the sum of (vᵢ₊₁ − vᵢ)².
    let weight = |i: usize| {
        let after = speeds.get(i + 1).map_or(0.0, |next| next - speeds[i]);
        2.0 * by_acceleration * (speeds[i] - speeds[i - 1] - after) / (step * end)
    };
    let states = || times.iter().copied().enumerate().skip(1);
    let shaken = states().map(|(i, time)| [time, speeds[i] - weight(i), 1.0]);
    let deviation = (0.5 * end / (by_room * step)).sqrt();
    let moved = states().map(|(_, time)| [time, CLEARANCE, deviation]);
    let objective = Objective::misfit(Quantity::Velocity(body), shaken)
        + Objective::misfit(Quantity::Stretch(spring), moved);
    let gradient = run.gradient(&objective)?;
    run.check_gradient(&gradient, &objective)?;
    let by_viscosity = gradient.by_parameter(damper, "eta0")?;
    let by_stiffness = gradient.by_parameter(spring, "stiffness")?;
    let by_length = gradient.by_parameter(spring, "natural_length")?;
    // The natural length is that at rest and load/k_s.
    let by_logs = [
        design.viscosity() * by_viscosity,
        design.stiffness() * by_stiffness
            - load / design.stiffness() * by_length
            - 2.0 * by_room * sag * sag,
    ];
    Ok((ride, by_logs))
}

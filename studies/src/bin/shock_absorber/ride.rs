//! The ride, lap by lap: every lap is the same road, so that laps differ by the car alone.

use super::car::{CELSIUS, Damper};
use eem_studies::record::Record;
use eem_studies::{table, terminal};

/// Recorded times that exceed the end of a lap by less than this (s) belong to it.
const TIME_TOLERANCE: f64 = 1e-6;

/// What a lap was like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lap {
    /// When it ended, s.
    pub(crate) end: f64,
    /// Temperature of the damper at its end, K.
    pub(crate) temperature: f64,
    /// Root mean square of the body's acceleration, m/s².
    pub(crate) acceleration: f64,
    /// Root mean square of the suspension's travel about its mean, m.
    pub(crate) travel: f64,
    /// Whether it was driven to its end.
    pub(crate) is_complete: bool,
}

/// The laps of a run, each `lap_time` seconds long; the last may be cut short.
pub(crate) fn laps(record: &Record, lap_time: f64) -> Vec<Lap> {
    let column = |name| record.column(name).unwrap_or_default();
    let (times, temperatures) = (column("time"), column("theta_1"));
    let (accelerations, travels) = (column("acceleration"), column("travel"));
    let mut laps = Vec::new();
    let (mut start, mut end_time) = (1, lap_time);
    while start < times.len() {
        let end = times.partition_point(|&time| time <= end_time + TIME_TOLERANCE);
        let window = start..end.max(start + 1);
        laps.push(Lap {
            end: times[window.end - 1],
            temperature: temperatures[window.end - 1],
            acceleration: root_mean_square(&accelerations[window.clone()], 0.0),
            travel: root_mean_square(&travels[window.clone()], mean(&travels[window.clone()])),
            is_complete: (times[window.end - 1] - end_time).abs() <= TIME_TOLERANCE,
        });
        start = window.end;
        end_time += lap_time;
    }
    laps
}

/// Prints both runs beside each other, a row per lap.
pub(crate) fn print(warming: (&Damper, &[Lap]), constant: (&Damper, &[Lap])) {
    let mut table = table::headed([
        "time (s)",
        "damper (°C)",
        "viscosity (N s/m)",
        "acceleration (m/s²)",
        "if η stayed",
        "travel (mm)",
        "if η stayed",
    ]);
    let mut start = 0.0;
    for (own, other) in warming.1.iter().zip(constant.1) {
        table.add_row([
            format!("{start} – {:.0}", own.end),
            format!("{:.1}", own.temperature - CELSIUS),
            format!("{:.0}", warming.0.viscosity(own.temperature)),
            format!("{:.3}", own.acceleration),
            format!("{:.3}", other.acceleration),
            format!("{:.2}", 1e3 * own.travel),
            format!("{:.2}", 1e3 * other.travel),
        ]);
        start = own.end.round();
    }
    let cold = constant.0.eta0;
    terminal::say(format_args!("{table}\n"));
    terminal::say(format_args!(
        "Every row is a lap of the same road. Damper and viscosity are those at its end;\n\
         acceleration of the body and travel of the suspension are root mean squares over it.\n\
         \"If η stayed\": the same car, its viscosity staying at {cold:.0} N s/m.\n"
    ));
}

fn root_mean_square(values: &[f64], about: f64) -> f64 {
    let squares: Vec<f64> = values.iter().map(|value| (value - about).powi(2)).collect();
    mean(&squares).sqrt()
}

/// The mean; not a number when there is none.
fn mean(values: &[f64]) -> f64 {
    let count = u32::try_from(values.len()).map_or(f64::INFINITY, f64::from);
    values.iter().sum::<f64>() / count
}

//! The pictures: road and motion, the ride cold and warm, temperature, and the energy ledger.

use std::error::Error;
use std::path::Path;

use super::balance;
use super::car::{CELSIUS, CLEARANCE, RADIUS, TRACK};
use super::ride::Lap;
use eem_studies::comparison;
use eem_studies::figures::look::BOLD;
use eem_studies::figures::{Axes, Curve, Figure};
use eem_studies::record::Record;

/// The part of a lap that is shown from close by, m.
const STRETCH: [f64; 2] = [20.0, 80.0];

/// A time and a value per state, or a lap and a value.
type Points = Vec<(f64, f64)>;

/// Writes all pictures; the first of the runs is the one shown where there is room for one.
pub(crate) fn write(
    directory: &Path,
    runs: &[Record],
    constant: &Record,
    laps: [&[Lap]; 2],
) -> Result<(), Box<dyn Error>> {
    let run = &runs[0];
    let temperature = |run: &Record| values(run, "theta_1", |theta| theta - CELSIUS);
    let mut figures = vec![
        ("road_and_motion", road_and_motion(run)),
        (
            "body_acceleration",
            cold_and_warm(run, "acceleration", 1.0, "body acceleration (m/s²)"),
        ),
        (
            "suspension_travel",
            cold_and_warm(run, "travel", 1e3, "suspension travel (mm)"),
        ),
        (
            "damper_temperature",
            figure(
                "Temperature of the damper: the same heat, thick oil or thin",
                ["time (s)", "temperature (°C)"],
                vec![
                    ("viscosity η(θ)", temperature(run)),
                    ("constant viscosity", temperature(constant)),
                ],
            ),
        ),
        ("energy_ledger", energy_ledger(run)),
        ("balance_by_scheme", balance_by_scheme(runs)),
    ];
    if laps.iter().all(|laps| laps.len() > 1) {
        figures.push(("ride_by_lap", ride_by_lap(laps)));
    }
    for (name, figure) in figures {
        figure.write_svg(&directory.join(format!("{name}.svg")))?;
    }
    Ok(())
}

/// Heights over a part of the last lap, from those at rest.
fn road_and_motion(run: &Record) -> Figure {
    let part = |name, rest: f64| last_lap(&values(run, name, |height| 1e3 * (height - rest)));
    figure(
        "Road and motion",
        ["place on the track (m)", "height above that at rest (mm)"],
        vec![
            ("road", part("road", 0.0)),
            ("wheel", part("q1_x", RADIUS)),
            ("body", part("q2_x", RADIUS + CLEARANCE)),
        ],
    )
}

/// The same place in the first and in the last lap.
fn cold_and_warm(run: &Record, name: &str, unit: f64, label: &str) -> Figure {
    let all = values(run, name, |value| unit * value);
    let mut curves = vec![("lap 1, cold", of_lap(&all, 0))];
    if last(&all) > 0 {
        curves.push(("last lap, warm", last_lap(&all)));
    }
    figure(
        "The same place on the road, cold and warm",
        ["place on the track (m)", label],
        curves,
    )
}

/// What warming up does to the ride.
fn ride_by_lap(laps: [&[Lap]; 2]) -> Figure {
    figure(
        "The ride in each lap, compared with that of the same car whose oil stays cold",
        ["lap", "root mean square, share of that with cold oil (%)"],
        vec![
            ("cold oil", relative([laps[1], laps[1]], |lap| lap.travel)),
            ("body acceleration", relative(laps, |lap| lap.acceleration)),
            ("suspension travel", relative(laps, |lap| lap.travel)),
        ],
    )
    .with(Axes::Counted)
}

/// Where the work of the road goes.
fn energy_ledger(run: &Record) -> Figure {
    let kilojoules = |name| since_start(run, name, 1e-3);
    figure(
        "Energy since the start",
        ["time (s)", "energy (kJ)"],
        vec![
            ("work of the road", kilojoules("work")),
            ("heat in the damper", kilojoules("damper_energy")),
            ("heat to the air", kilojoules("reservoir_heat")),
            ("E − work − heat", kilojoules("balance")),
        ],
    )
}

/// What each scheme makes of the first law: a line at the largest defect.
fn balance_by_scheme(runs: &[Record]) -> Figure {
    let curve = |(place, run): (u32, &Record)| {
        let largest = balance::defect(run).filter(|&defect| defect > 0.0);
        let ends = [-0.35, 0.35].map(|side| f64::from(place) + side);
        let points = largest.map(|largest| ends.map(|x| (x, largest)).to_vec());
        Curve {
            label: run.scheme.clone(),
            points: points.unwrap_or_default(),
            look: BOLD + comparison::look(&run.scheme),
            trusted: true,
            decisive: usize::MAX,
        }
    };
    Figure {
        title: "What each scheme makes of the first law".to_owned(),
        x_label: "scheme".to_owned(),
        y_label: "largest |Δ(E − work − heat)| of the drive (J)".to_owned(),
        curves: (1..).zip(runs).map(curve).collect(),
        axes: Axes::NamedLogarithmic,
    }
}

/// The change of a column since the start, in other units.
fn since_start(run: &Record, name: &str, unit: f64) -> Points {
    let start = run.column(name).and_then(|all| all.first().copied());
    values(run, name, |value| unit * (value - start.unwrap_or(0.0)))
}

/// A curve per label, told apart in this order; none has the look of a scheme.
fn figure(title: &str, [x_label, y_label]: [&str; 2], curves: Vec<(&str, Points)>) -> Figure {
    let curve = |(look, (label, points)): (usize, (&str, Points))| Curve {
        label: label.to_owned(),
        points,
        look: look
            .checked_sub(1)
            .map_or(0, comparison::look_beside_schemes),
        trusted: true,
        decisive: usize::MAX,
    };
    Figure {
        title: title.to_owned(),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        curves: curves.into_iter().enumerate().map(curve).collect(),
        axes: Axes::Even,
    }
}

/// A column over time, converted.
fn values(run: &Record, name: &str, convert: impl Fn(f64) -> f64) -> Points {
    let points = run.points("time", name).into_iter();
    points.map(|(t, value)| (t, convert(value))).collect()
}

/// A figure of the first laps as a share of that of the second ones, %, over the number of the lap.
fn relative([own, other]: [&[Lap]; 2], figure: fn(&Lap) -> f64) -> Points {
    let shares = own.iter().zip(other);
    let shares = shares.map(|(a, b)| 100.0 * figure(a) / figure(b));
    (1_u32..).map(f64::from).zip(shares).collect()
}

/// The part [`STRETCH`] of the last lap that reached its end; all of it in a shorter drive.
fn last_lap(points: &[(f64, f64)]) -> Points {
    of_lap(points, last(points))
}

/// The number of the last lap whose part [`STRETCH`] was driven, from 0.
fn last(points: &[(f64, f64)]) -> u32 {
    let end = points.last().map_or(0.0, |last| last.0);
    let mut lap = 0;
    while f64::from(lap + 1) * TRACK.lap_time() + STRETCH[1] / TRACK.speed < end {
        lap += 1;
    }
    lap
}

/// The part [`STRETCH`] of a lap, over the place on the track.
fn of_lap(points: &[(f64, f64)], lap: u32) -> Points {
    let place = |t: f64| TRACK.speed * t - f64::from(lap) * TRACK.lap;
    let placed = points.iter().map(|&(t, value)| (place(t), value));
    placed
        .filter(|(place, _)| (STRETCH[0]..=STRETCH[1]).contains(place))
        .collect()
}

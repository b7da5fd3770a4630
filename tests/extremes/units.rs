//! Kind 8: one scene in metres, millimetres and kilometres, in kelvins and millikelvins.

use eem::prelude::*;

use super::published::{LOGARITHMIC, ROMERO, double_pendulum, single_pendulum};
use super::tally::{Effort, Family, Tally};
use super::watched::{EXACT, Record, Watched};

pub(crate) const FAMILIES: &[Family] = &[systems_of_units];

/// Relative to the size of the scene: roundings that differ, magnified by the motion.
const SAME: f64 = 1e-12;

/// How many of its units one metre and one kelvin have.
const UNITS: [[f64; 2]; 5] = [
    [1e3, 1.0],
    [1e-3, 1.0],
    [1.0, 1e3],
    [1e3, 1e3],
    [1e-3, 1e-3],
];

/// Positions and temperatures after each step, in SI units, and the iterations.
struct Trace {
    rows: Vec<Vec<f64>>,
    iterations: Vec<usize>,
    record: Record,
}

fn trace<const D: usize>(
    mut watched: Watched<D>,
    [metre, kelvin]: [f64; 2],
    steps: usize,
) -> Trace {
    let (mut rows, mut iterations) = (Vec::new(), Vec::new());
    for _ in 0..steps {
        let Ok(report) = watched.step() else { break };
        let state = watched.stored();
        let positions = state.positions.iter().map(|q| q.value() / metre);
        let temperatures = state
            .temperatures
            .iter()
            .map(|theta| theta / kelvin / 300.0);
        rows.push(positions.chain(temperatures).collect());
        iterations.push(report.iterations);
    }
    Trace {
        rows,
        iterations,
        record: watched.record,
    }
}

/// A run of some steps by a scheme, in some units.
type Build = fn(Scheme, [f64; 2], usize) -> Trace;

fn systems_of_units(effort: Effort) -> Tally {
    let mut tally = Tally::new(
        "single pendulum, Romero's and the logarithmic double pendulum in m, mm, km, K, mK",
    );
    let steps = effort.of([3, 20, 20]);
    let cases: [(&str, Build); 3] = [
        ("single", |scheme, units, steps| {
            trace(
                single_pendulum(units).start(scheme, 0.05).expect("sound"),
                units,
                steps,
            )
        }),
        ("Romero", |scheme, units, steps| {
            trace(
                double_pendulum(&ROMERO, units)
                    .start(scheme, 0.1)
                    .expect("sound"),
                units,
                steps,
            )
        }),
        ("log", |scheme, units, steps| {
            trace(
                double_pendulum(&LOGARITHMIC, units)
                    .start(scheme, 0.05)
                    .expect("sound"),
                units,
                steps,
            )
        }),
    ];
    for scheme in EXACT {
        for (name, build) in &cases {
            let si = build(scheme, [1.0, 1.0], steps);
            tally.add_complete(format!("{name}, {}", scheme.name()), &si.record);
            for units in UNITS {
                let label = format!("{name} in 1/{units:?} m and K, {}", scheme.name());
                let other = build(scheme, units, steps);
                tally.add_complete(&label, &other.record);
                compare(&mut tally, &label, &si, &other);
            }
        }
    }
    tally
}

fn compare(tally: &mut Tally, label: &str, si: &Trace, other: &Trace) {
    let mut off = 0.0_f64;
    for (a, b) in si.rows.iter().flatten().zip(other.rows.iter().flatten()) {
        off = off.max((a - b).abs());
    }
    tally.claim(off < SAME, format!("{label}: {off:e} away"));
    for (step, (a, b)) in si.iterations.iter().zip(&other.iterations).enumerate() {
        let message = format!("{label}: step {step} takes {a} and {b} iterations");
        tally.claim(a.abs_diff(*b) <= 1, message);
    }
}

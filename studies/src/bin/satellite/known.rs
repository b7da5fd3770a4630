//! What is known of the motion from another program, which solved the equations of the steps of the exact schemes.

use super::scene::Axis;
use super::{ATTITUDE, Case};
use eem_studies::claims::Claims;
use eem_studies::record::Record;
use eem_studies::statistics::{TIME_TOLERANCE, first_row};

/// To what energies are good, relative to themselves, and attitudes, degrees.
const ENERGY: f64 = 1e-9;
const DEGREES: f64 = 0.01;

/// A value of a column at a time, with its uncertainty.
struct Known {
    scheme: &'static str,
    axis: Axis,
    /// Whether the rockets have to stop it, or must not; nothing while they have not yet.
    stops: Option<bool>,
    step: f64,
    time: f64,
    column: &'static str,
    value: f64,
    uncertainty: f64,
}

impl Known {
    const fn energy(scheme: &'static str, time: f64, value: f64) -> Self {
        Self {
            scheme,
            axis: Axis::Y,
            stops: None,
            step: 0.2,
            time,
            column: "energy",
            value,
            uncertainty: ENERGY * value,
        }
    }

    const fn after(
        scheme: &'static str,
        column: &'static str,
        value: f64,
        uncertainty: f64,
    ) -> Self {
        Self {
            stops: Some(false),
            column,
            uncertainty,
            ..Self::energy(scheme, 60.2, value)
        }
    }
}

const ENTROPY_FORM: &str = "eem-entropy";
const TEMPERATURE_FORM: &str = "eem-temperature";

const KNOWN: [Known; 18] = [
    Known::energy(ENTROPY_FORM, 0.2, 0.162_106_348_0),
    Known::energy(ENTROPY_FORM, 0.4, 0.639_628_601_4),
    Known::energy(ENTROPY_FORM, 0.6, 1.419_608_455_5),
    Known::energy(ENTROPY_FORM, 0.8, 2.489_664_977_0),
    Known::energy(ENTROPY_FORM, 1.0, 3.833_833_323_4),
    Known::energy(ENTROPY_FORM, 50.0, 3.833_833_323_4),
    Known::energy(TEMPERATURE_FORM, 50.0, 3.833_833_285_7),
    Known {
        step: 0.1,
        ..Known::energy(ENTROPY_FORM, 50.0, 3.836_285_345_0)
    },
    Known {
        axis: Axis::Z,
        ..Known::energy(ENTROPY_FORM, 50.0, 3.170_386_149_8)
    },
    Known {
        stops: Some(true),
        ..Known::energy(ENTROPY_FORM, 62.0, 3.696_013_297_2)
    },
    Known::after(ENTROPY_FORM, ATTITUDE, 630.76, DEGREES),
    Known::after(TEMPERATURE_FORM, ATTITUDE, 630.76, DEGREES),
    Known::after(ENTROPY_FORM, "kinetic", 2.473_06, 5e-6),
    Known::after(TEMPERATURE_FORM, "kinetic", 2.473_06, 5e-6),
    Known::after(ENTROPY_FORM, "entropy", 3.723e-3, 5e-7),
    Known::after(TEMPERATURE_FORM, "entropy", 3.723e-3, 5e-7),
    Known {
        axis: Axis::Z,
        ..Known::after(ENTROPY_FORM, ATTITUDE, 626.3, 0.05)
    },
    Known {
        step: 0.1,
        time: 62.0,
        ..Known::after(ENTROPY_FORM, ATTITUDE, 652.2, 0.05)
    },
];

/// The known values, as far as the run gets.
pub(crate) fn check(run: &Record, case: Case, claims: &mut Claims) {
    let same = |a: f64, b: f64| (a - b).abs() <= TIME_TOLERANCE;
    for known in KNOWN {
        let Known {
            scheme,
            column,
            time,
            ..
        } = known;
        let is_case = known.axis == case.axis && known.stops.is_none_or(|own| own == case.stops);
        if run.scheme != scheme || !is_case || !same(known.step, case.step) {
            continue;
        }
        let row = first_row(run, time);
        let is_there = run.times().get(row).is_some_and(|&own| same(own, time));
        if !is_there {
            continue;
        }
        let found = run.column(column).map(|values| values[row]);
        claims.at_most(
            &format!("{scheme}, t = {time} s: the error of {column}"),
            found.map(|found| (found - known.value).abs()),
            known.uncertainty,
        );
    }
}

//! The pictures: attitude, energy balance, energy, momentum and temperatures of the stiffeners over time.

use std::error::Error;
use std::path::Path;

use super::ATTITUDE;
use eem_studies::comparison;
use eem_studies::figures::{self, Figure};
use eem_studies::first_law;
use eem_studies::record::Record;

/// The stiffeners that are drawn: two of the right panel, one above the other.
const DRAWN: [(&str, &str); 2] = [("theta_2", "above"), ("theta_1", "below")];

/// Beyond which energy (J) nothing is drawn: what follows is no motion of a satellite any more.
const MOST_ENERGY: f64 = 40.0;

/// Writes all pictures.
pub(crate) fn write(directory: &Path, runs: &[Record]) -> Result<(), Box<dyn Error>> {
    let figures = [
        ("energy_balance", first_law::figure("A satellite", runs)),
        (
            "attitude",
            history("its attitude", "turn of the body (°)", runs, ATTITUDE),
        ),
        (
            "energy",
            history("its energy", "energy (J)", runs, "energy"),
        ),
        (
            "angular_momentum",
            over_time("its angular momentum", "|J| (kg m²/s)", runs, |run| {
                run.norms("angular_momentum_")
            }),
        ),
    ];
    for (name, figure) in figures {
        figure.write_svg(&directory.join(format!("{name}.svg")))?;
    }
    figures::write_stack(&temperatures(runs), &directory.join("temperatures.svg"))
}

/// A column over time.
fn history(what: &str, y_label: &str, runs: &[Record], column: &str) -> Figure {
    over_time(what, y_label, runs, |run| run.points("time", column))
}

/// Curves over time that end where the energy gets beyond everything, which the legend says.
fn over_time(
    what: &str,
    y_label: &str,
    runs: &[Record],
    points: impl Fn(&Record) -> Vec<(f64, f64)>,
) -> Figure {
    let mut figure = comparison::over_time(&format!("A satellite: {what}"), y_label, runs, points);
    for (curve, run) in figure.curves.iter_mut().zip(runs) {
        let energy = run.column("energy").unwrap_or_default();
        let is_beyond = |&energy: &f64| energy > MOST_ENERGY;
        if let Some(row) = energy.iter().position(is_beyond) {
            curve.points.truncate(row);
            let time = run.time(row);
            let label = &curve.label;
            curve.label = format!("{label}, energy above {MOST_ENERGY} J from {time:.1} s");
        }
    }
    figure
}

/// A picture for each of two stiffeners.
fn temperatures(runs: &[Record]) -> [Figure; 2] {
    DRAWN.map(|(column, place)| {
        let what = format!("temperature of a stiffener {place} the right panel");
        history(&what, "temperature (K)", runs, column)
    })
}

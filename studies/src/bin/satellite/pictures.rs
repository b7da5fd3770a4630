//! The pictures: attitude, energy balance, energy, momentum and temperatures of the stiffeners over time.

use std::error::Error;
use std::path::Path;

use super::ATTITUDE;
use eem_studies::comparison::over_time;
use eem_studies::figures::{Curve, Figure};
use eem_studies::first_law;
use eem_studies::record::Record;

/// The stiffeners that are drawn: one above and one below a panel.
const DRAWN: [&str; 2] = ["theta_1", "theta_2"];

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
            over_time(
                "A satellite: its angular momentum",
                "|J| (kg m²/s)",
                runs,
                |run| shown(run, run.norms("angular_momentum_")),
            ),
        ),
        ("temperatures", temperatures(runs)),
    ];
    for (name, figure) in figures {
        figure.write_svg(&directory.join(format!("{name}.svg")))?;
    }
    Ok(())
}

/// A column over time.
fn history(what: &str, y_label: &str, runs: &[Record], column: &str) -> Figure {
    let title = format!("A satellite: {what}");
    over_time(&title, y_label, runs, |run| {
        shown(run, run.points("time", column))
    })
}

/// What is before the energy is beyond everything.
fn shown(run: &Record, mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let energy = run.column("energy").unwrap_or_default();
    let sound = energy.iter().take_while(|&&energy| energy <= MOST_ENERGY);
    points.truncate(sound.count());
    points
}

/// Two stiffeners of a panel; both curves of a scheme look the same, and one is in the legend.
fn temperatures(runs: &[Record]) -> Figure {
    let label = "temperature (K)";
    let [mut upper, lower] =
        DRAWN.map(|name| history("two stiffeners of a panel", label, runs, name));
    upper
        .curves
        .extend(lower.curves.into_iter().map(|curve| Curve {
            label: String::new(),
            ..curve
        }));
    upper
}

//! The pictures: the energy balance, kinetic energy, temperatures and entropy of all schemes over time.

use std::error::Error;
use std::path::Path;

use eem_studies::comparison::over_time;
use eem_studies::figures::{Curve, Figure};
use eem_studies::first_law;
use eem_studies::record::Record;

/// A time and a value per state.
type Points = Vec<(f64, f64)>;

/// Writes all pictures.
pub(crate) fn write(directory: &Path, runs: &[Record]) -> Result<(), Box<dyn Error>> {
    let figures = [
        (
            "energy_balance",
            first_law::figure("An L-shaped block", runs),
        ),
        (
            "kinetic_energy",
            over_time(
                "An L-shaped block: its kinetic energy",
                "kinetic energy (J)",
                runs,
                |run| run.points("time", "kinetic"),
            ),
        ),
        ("temperature_range", temperature_range(runs)),
        (
            "entropy",
            over_time(
                "An L-shaped block: the entropy that spreading heat makes",
                "S − S₀ (J/K)",
                runs,
                entropy_changes,
            ),
        ),
    ];
    for (name, figure) in figures {
        figure.write_svg(&directory.join(format!("{name}.svg")))?;
    }
    Ok(())
}

/// The warmest and the coldest point; both curves of a scheme look the same, and one is in the legend.
fn temperature_range(runs: &[Record]) -> Figure {
    let of = |name| move |run: &Record| run.points("time", name);
    let label = "temperature (K)";
    let title = "An L-shaped block: its warmest and its coldest point";
    let mut warmest = over_time(title, label, runs, of("temperature_max"));
    let coldest = over_time(title, label, runs, of("temperature_min"));
    warmest
        .curves
        .extend(coldest.curves.into_iter().map(|curve| Curve {
            label: String::new(),
            ..curve
        }));
    warmest
}

/// S − S₀ (J/K) over time.
fn entropy_changes(run: &Record) -> Points {
    let points = run.points("time", "entropy");
    let first = points.first().map_or(0.0, |&(_, entropy)| entropy);
    let change = |(time, entropy)| (time, entropy - first);
    points.into_iter().map(change).collect()
}

//! The pictures: the energy balance, kinetic energy, temperatures and entropy of all schemes over time.

use std::error::Error;
use std::path::Path;

use eem_studies::comparison::with_differences;
use eem_studies::figures::{self, Figure};
use eem_studies::first_law;
use eem_studies::record::Record;

/// A time and a value per state.
type Points = Vec<(f64, f64)>;

/// Writes all pictures.
pub(crate) fn write(directory: &Path, runs: &[Record]) -> Result<(), Box<dyn Error>> {
    let of = |what: &str, y_label: &str, points: fn(&Record) -> Points| {
        with_differences(&format!("An L-shaped block: {what}"), y_label, runs, points)
    };
    let pictures = [
        (
            "energy_balance",
            vec![first_law::figure("An L-shaped block", runs)],
        ),
        (
            "kinetic_energy",
            of("its kinetic energy", "kinetic energy (J)", |run| {
                run.points("time", "kinetic")
            }),
        ),
        ("temperature_range", temperature_range(runs)),
        (
            "entropy",
            of(
                "the entropy that spreading heat makes",
                "S − S₀ (J/K)",
                entropy_changes,
            ),
        ),
    ];
    for (name, figures) in pictures {
        figures::write_stack(&figures, &directory.join(format!("{name}.svg")))?;
    }
    Ok(())
}

/// The warmest and the coldest point, and what the schemes differ by.
fn temperature_range(runs: &[Record]) -> Vec<Figure> {
    let of = |which: &str, column: &str| {
        let title = format!("An L-shaped block: its {which} point");
        with_differences(&title, "temperature (K)", runs, |run| {
            run.points("time", column)
        })
    };
    let mut all = of("warmest", "temperature_max");
    all.extend(of("coldest", "temperature_min"));
    all
}

/// S − S₀ (J/K) over time.
fn entropy_changes(run: &Record) -> Points {
    let points = run.points("time", "entropy");
    let first = points.first().map_or(0.0, |&(_, entropy)| entropy);
    let change = |(time, entropy)| (time, entropy - first);
    points.into_iter().map(change).collect()
}

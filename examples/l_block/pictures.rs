//! The pictures: the energy balance, kinetic energy, temperatures and entropy of all schemes over time.

use std::error::Error;
use std::path::Path;

use super::balance;
use super::support::comparison;
use super::support::figures::{Axes, Curve, Figure};
use super::support::record::Record;

/// The least defect (J) that is drawn; it stands for none at all.
const LEAST_DEFECT: f64 = 1e-12;

/// A time and a value per state.
type Points = Vec<(f64, f64)>;

/// Writes all pictures.
pub(crate) fn write(directory: &Path, runs: &[Record]) -> Result<(), Box<dyn Error>> {
    let figures = [
        ("energy_balance", energy_balance(runs)),
        (
            "kinetic_energy",
            figure(
                "An L-shaped block: its kinetic energy",
                "kinetic energy (J)",
                runs,
                |run| run.points("time", "kinetic"),
            ),
        ),
        ("temperature_range", temperature_range(runs)),
        (
            "entropy",
            figure(
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

/// What each scheme makes of the first law.
fn energy_balance(runs: &[Record]) -> Figure {
    let largest_so_far = |run: &Record| {
        let defects = balance::energy_defects(run).scan(LEAST_DEFECT, |largest, defect| {
            *largest = largest.max(defect);
            Some(*largest)
        });
        run.over_time(defects).split_off(1)
    };
    Figure {
        axes: Axes::Logarithmic,
        ..figure(
            "An L-shaped block: what each scheme makes of the first law",
            "largest |E − E₀ − W| so far (J)",
            runs,
            largest_so_far,
        )
    }
}

/// The warmest and the coldest point; both curves of a scheme look the same, and one is in the legend.
fn temperature_range(runs: &[Record]) -> Figure {
    let of = |name| move |run: &Record| run.points("time", name);
    let label = "temperature (K)";
    let title = "An L-shaped block: its warmest and its coldest point";
    let mut warmest = figure(title, label, runs, of("temperature_max"));
    let coldest = figure(title, label, runs, of("temperature_min"));
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

/// A curve per scheme, over time.
fn figure(
    title: &str,
    y_label: &str,
    runs: &[Record],
    points: impl Fn(&Record) -> Points,
) -> Figure {
    let curve = |run: &Record| Curve {
        label: run.scheme.clone(),
        points: points(run),
        look: comparison::look(&run.scheme),
        trusted: run.completed(),
        decisive: usize::MAX,
    };
    Figure {
        title: title.to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: y_label.to_owned(),
        curves: runs.iter().map(curve).collect(),
        axes: Axes::Even,
    }
}

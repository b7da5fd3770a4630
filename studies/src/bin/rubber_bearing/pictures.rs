//! The pictures: stress over strain, temperature, what each cycle damps, and the first law.

use std::error::Error;
use std::path::Path;

use super::cycles;
use eem_studies::comparison::{look_beside_schemes, over_time};
use eem_studies::figures::{Axes, Curve, Figure};
use eem_studies::first_law;
use eem_studies::record::Record;

/// Writes all pictures; the first of the runs is the one shown where there is room for one.
pub(crate) fn write(directory: &Path, runs: &[Record]) -> Result<(), Box<dyn Error>> {
    let mut figures = vec![
        (
            "energy_balance",
            first_law::figure("A rubber bearing", runs),
        ),
        (
            "temperature",
            over_time(
                "A rubber bearing: its warmest point",
                "temperature (K)",
                runs,
                |run| run.points("time", "temperature_max"),
            ),
        ),
    ];
    if let Some(run) = runs.first().filter(|run| cycles::all(run).len() > 1) {
        figures.push(("cycles", loops(run)));
        figures.push(("damping", damping(runs)));
    }
    for (name, figure) in figures {
        figure.write_svg(&directory.join(format!("{name}.svg")))?;
    }
    Ok(())
}

/// Stress over strain in the third and in the last cycle.
fn loops(run: &Record) -> Figure {
    let cycles = cycles::all(run);
    let points = run.points("strain", "shear_stress");
    let ends = [
        ("third cycle", cycles.first()),
        ("last cycle", cycles.last()),
    ];
    let curves = ends.into_iter().enumerate();
    let curves = curves.filter_map(|(index, (label, cycle))| {
        let [first, last] = cycle?.rows;
        Some(Curve {
            label: label.to_owned(),
            points: points[first..=last]
                .iter()
                .map(|(x, y)| (*x, 1e-3 * y))
                .collect(),
            look: look_beside_schemes(index),
            trusted: true,
            decisive: usize::MAX,
        })
    });
    Figure {
        title: "A rubber bearing: warm rubber damps less".to_owned(),
        x_label: "displacement of the plate over height".to_owned(),
        y_label: "mean shear stress (kPa)".to_owned(),
        curves: curves.collect(),
        axes: Axes::Even,
    }
}

/// What the plate does in each cycle.
fn damping(runs: &[Record]) -> Figure {
    over_time(
        "A rubber bearing: the work of each cycle",
        "work (J)",
        runs,
        |run| {
            let all = cycles::all(run);
            all.iter()
                .map(|cycle| (run.time(cycle.rows[1]), cycle.work))
                .collect()
        },
    )
}

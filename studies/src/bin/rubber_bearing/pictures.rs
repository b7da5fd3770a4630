//! The pictures: stress over strain, temperature, what each cycle damps, and the first law.

use std::error::Error;
use std::path::Path;

use super::cycles;
use eem_studies::comparison::{look_beside_schemes, with_differences};
use eem_studies::figures::look::PLAIN;
use eem_studies::figures::{self, Axes, Curve, Figure};
use eem_studies::first_law;
use eem_studies::record::Record;

/// Writes all pictures; the first of the runs is the one shown where there is room for one.
pub(crate) fn write(directory: &Path, runs: &[Record]) -> Result<(), Box<dyn Error>> {
    let mut pictures = vec![
        (
            "energy_balance",
            vec![first_law::figure("A rubber bearing", runs)],
        ),
        (
            "temperature",
            with_differences(
                "A rubber bearing: its warmest point",
                "temperature (K)",
                runs,
                |run| run.points("time", "temperature_max"),
            ),
        ),
    ];
    if let Some(run) = runs.first().filter(|run| cycles::all(run).len() > 1) {
        pictures.push(("cycles", vec![loops(run)]));
        pictures.push(("damping", damping(runs)));
    }
    for (name, figures) in pictures {
        figures::write_stack(&figures, &directory.join(format!("{name}.svg")))?;
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
            look: PLAIN + look_beside_schemes(index),
            trusted: true,
            decisive: usize::MAX,
        })
    });
    Figure {
        title: format!("A rubber bearing: warm rubber damps less ({})", run.scheme),
        x_label: "displacement of the plate over height".to_owned(),
        y_label: "mean shear stress (kPa)".to_owned(),
        curves: curves.collect(),
        axes: Axes::Even,
    }
}

/// What the plate does in each cycle, of which a share is what the axis shows.
fn damping(runs: &[Record]) -> Vec<Figure> {
    let work = |run: &Record| {
        let work = cycles::all(run).into_iter().map(|cycle| 1e-3 * cycle.work);
        (3_u32..).map(f64::from).zip(work).collect()
    };
    let title = "A rubber bearing: the work of the plate in each cycle";
    let mut figures = with_differences(title, "work (kJ)", runs, work);
    for figure in &mut figures {
        "cycle".clone_into(&mut figure.x_label);
        figure.axes = Axes::Counted;
    }
    figures[0].curves.push(Curve {
        label: String::new(),
        points: vec![(3.0, 0.0)],
        look: PLAIN,
        trusted: true,
        decisive: 1,
    });
    figures
}

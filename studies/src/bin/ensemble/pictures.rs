//! The pictures: how the temperature is distributed, and how it depends on the stiffness;
//! and all members as CSV.

use std::error::Error;
use std::path::Path;

use super::members::Sample;
use super::pendulum::Spring;
use super::report::{QUANTILES, quantile, real};
use eem_studies::comparison;
use eem_studies::figures::look::{AREA, PLAIN};
use eem_studies::figures::{Axes, Curve, Figure};
use eem_studies::output;

/// The shares of the members below the lower whisker, the box, its middle line, its top and the upper
/// whisker.
const BOX: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// Half of the width of a box, in distances of neighbours.
const HALF_WIDTH: f64 = 0.3;

/// Parts of the range of the stiffness in each of which quantiles are taken.
const PARTS: usize = 15;

/// The stiffness among the unknowns.
const STIFFNESS: usize = 0;

/// Writes a CSV file for each scheme, and the pictures.
pub(crate) fn write(
    directory: &Path,
    springs: &[Spring],
    samples: &[Sample],
    end: f64,
) -> Result<(), Box<dyn Error>> {
    for sample in samples {
        write_csv(directory, springs, sample)?;
    }
    let svg = |name: &str| directory.join(format!("{name}.svg"));
    distribution(samples, end).write_svg(&svg("distribution"))?;
    if let Some(sample) = samples.first() {
        over_stiffness(springs, sample, end).write_svg(&svg("temperature_over_stiffness"))?;
    }
    Ok(())
}

/// A row for each member: its unknowns and its end, not a number where there is none.
fn write_csv(directory: &Path, springs: &[Spring], sample: &Sample) -> Result<(), Box<dyn Error>> {
    let unknowns = Spring::UNKNOWNS.iter().map(|unknown| unknown.name);
    let ends = [
        "temperature (K)",
        "entropy (J/K)",
        "energy_defect",
        "entropy_loss (J/K)",
    ];
    let heads: Vec<&str> = unknowns.chain(ends).collect();
    let members = springs.iter().zip(&sample.ends);
    let rows: Vec<Vec<f64>> = members
        .map(|(spring, end)| {
            let end = end.as_ref().map_or([f64::NAN; 4], |end| {
                [
                    end.temperature,
                    end.entropy,
                    end.energy_defect,
                    end.entropy_loss,
                ]
            });
            spring.values.into_iter().chain(end).collect()
        })
        .collect();
    output::write_numbers(directory, sample.scheme.name(), &heads, &rows)?;
    Ok(())
}

/// A box for each scheme: half of the members lie in it, ninety of a hundred between its whiskers.
fn distribution(samples: &[Sample], end: f64) -> Figure {
    let curve = |(place, sample): (usize, &Sample)| {
        let points = outline(real(place + 1), &sample.sorted(|end| end.temperature));
        Curve {
            label: sample.scheme.name().to_owned(),
            look: PLAIN + comparison::look(sample.scheme.name()),
            trusted: sample.scheme.name().starts_with("eem-") || samples.len() == 1,
            decisive: points.len(),
            points,
        }
    };
    Figure {
        title: format!("Mean temperature of the spring in the last quarter of {end} s"),
        x_label: "box: 25 to 75 % of the members, whiskers: 5 to 95 %".to_owned(),
        y_label: "temperature θ (K)".to_owned(),
        curves: samples.iter().enumerate().map(curve).collect(),
        axes: Axes::Named,
    }
}

/// Whiskers, box and median about `x` in one line; where a point is not a number, the pen is lifted.
fn outline(x: f64, ascending: &[f64]) -> Vec<(f64, f64)> {
    let [Some(least), Some(low), Some(middle), Some(high), Some(most)] =
        BOX.map(|share| quantile(ascending, share))
    else {
        return Vec::new();
    };
    let [left, right] = [x - HALF_WIDTH, x + HALF_WIDTH];
    let lifted = (f64::NAN, f64::NAN);
    vec![
        (x, least),
        (x, low),
        (left, low),
        (left, high),
        (right, high),
        (right, low),
        (x, low),
        lifted,
        (left, middle),
        (right, middle),
        lifted,
        (x, high),
        (x, most),
    ]
}

/// Quantiles of the temperature over the stiffness.
fn over_stiffness(springs: &[Spring], sample: &Sample, end: f64) -> Figure {
    let members = springs.iter().zip(&sample.ends);
    let mut pairs: Vec<(f64, f64)> = members
        .filter_map(|(spring, end)| {
            Some((spring.values[STIFFNESS], end.as_ref().ok()?.temperature))
        })
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let parts: Vec<&[(f64, f64)]> = pairs.chunks(pairs.len().div_ceil(PARTS).max(1)).collect();
    let [low, middle, high] = QUANTILES.map(|share| {
        let point = |part: &&[(f64, f64)]| {
            let stiffness = part.iter().map(|pair| pair.0).sum::<f64>() / real(part.len());
            let mut temperatures: Vec<f64> = part.iter().map(|pair| pair.1).collect();
            temperatures.sort_by(f64::total_cmp);
            Some((stiffness, quantile(&temperatures, share)?))
        };
        parts.iter().filter_map(point).collect::<Vec<_>>()
    });
    let around = low.into_iter().chain(high.into_iter().rev()).collect();
    let curve = |label: &str, points: Vec<(f64, f64)>, look| Curve {
        label: label.to_owned(),
        points,
        look,
        trusted: true,
        decisive: usize::MAX,
    };
    Figure {
        title: format!(
            "Mean temperature in the last quarter of {end} s, by stiffness ({})",
            sample.scheme.name()
        ),
        x_label: Spring::UNKNOWNS[STIFFNESS].label.to_owned(),
        y_label: "temperature θ (K)".to_owned(),
        curves: vec![
            curve("5 to 95 % of the members", around, AREA),
            curve("half of them are below", middle, 0),
        ],
        axes: Axes::Even,
    }
}

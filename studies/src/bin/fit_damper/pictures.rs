//! The pictures: recording and fit, residuals, the sweep's misfits, estimates from fresh noise; and their numbers.

use std::error::Error;
use std::path::Path;

use eem::nalgebra::Matrix3;

use super::car::CELSIUS;
use super::confidence::{Bootstrap, ellipse};
use super::drive::{Logs, UNKNOWNS};
use super::fit::{Data, Fit};
use super::survey::Survey;
use eem_studies::figures::look::{DOTTED, OPEN, PLAIN};
use eem_studies::figures::{Axes, Curve, Figure};
use eem_studies::output;

/// What of the displacement is shown from close by, s.
const CLOSE: f64 = 2.0;

/// Temperatures of which one is shown, so that marks can be told apart.
const THINNED: usize = 4;

type Points = Vec<(f64, f64)>;

/// All that was found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<'a> {
    pub(crate) data: Data<'a>,
    pub(crate) survey: &'a Survey,
    pub(crate) fit: &'a Fit,
    pub(crate) covariance: &'a Matrix3<f64>,
    pub(crate) bootstrap: &'a Bootstrap,
}

impl Found<'_> {
    /// Writes pictures and tables.
    pub(crate) fn write(&self, directory: &Path) -> Result<(), Box<dyn Error>> {
        for (name, figure) in [
            ("travel", self.travel()),
            ("temperature", self.temperature()),
            ("residuals", self.residuals()),
            ("misfit", self.misfit()),
            ("stiffness_and_viscosity", self.estimates([0, 1])),
            ("viscosity_and_capacity", self.estimates([1, 2])),
        ] {
            figure.write_svg(&directory.join(format!("{name}.svg")))?;
        }
        let drive = &self.fit.point.drive;
        let recording = self.data.recording;
        let states = self.times().into_iter().enumerate();
        let states = states.map(|(i, time)| {
            let travel = [recording.travel[i], drive.travel[i]];
            let temperature = [recording.temperature[i], drive.temperature[i]];
            [&[time][..], &travel, &temperature].concat()
        });
        let heads = [
            "time (s)",
            "recorded_travel (m)",
            "travel (m)",
            "recorded_temperature (K)",
            "temperature (K)",
        ];
        output::write_numbers(directory, "ride", &heads, &states.collect::<Vec<_>>())?;
        let estimates = self.bootstrap.estimates.iter();
        let estimates: Vec<Vec<f64>> = estimates.map(|logs| logs.map(f64::exp).to_vec()).collect();
        let heads = UNKNOWNS.map(|unknown| unknown.label);
        output::write_numbers(directory, "estimates", &heads, &estimates)?;
        Ok(())
    }

    /// When states were recorded, s.
    fn times(&self) -> Vec<f64> {
        let grid = self.data.grid;
        let states = self.data.recording.travel.len();
        let time = |state: usize| grid.step * super::real(state * grid.stride);
        (1..=states).map(time).collect()
    }

    fn over_time(&self, values: &[f64], convert: impl Fn(f64) -> f64) -> Points {
        let values = values.iter().map(|&value| convert(value));
        self.times().into_iter().zip(values).collect()
    }

    fn travel(&self) -> Figure {
        let end = self.times().last().copied().unwrap_or_default();
        let part = |values: &[f64]| {
            let mut points = self.over_time(values, |travel| 1e3 * travel);
            points.retain(|(time, _)| *time >= end - CLOSE);
            points
        };
        figure(
            "Travel of the suspension, the end of the ride",
            ["time (s)", "travel (mm)"],
            vec![
                ("recorded", OPEN + 2, part(&self.data.recording.travel)),
                ("fit", PLAIN + 1, part(&self.fit.point.drive.travel)),
            ],
        )
    }

    fn temperature(&self) -> Figure {
        let celsius = |values: &[f64]| self.over_time(values, |theta| theta - CELSIUS);
        let recorded = celsius(&self.data.recording.temperature);
        let recorded = recorded.into_iter().step_by(THINNED).collect();
        figure(
            "Temperature of the damper",
            ["time (s)", "temperature (°C)"],
            vec![
                ("recorded, one of four", DOTTED + 2, recorded),
                ("fit", PLAIN + 1, celsius(&self.fit.point.drive.temperature)),
            ],
        )
    }

    /// 5 % of noise lies beyond two standard deviations.
    fn residuals(&self) -> Figure {
        let residuals = self.data.recording.residuals(&self.fit.point.drive);
        let (travel, temperature) = residuals.split_at(residuals.len() / 2);
        let line = |height: f64| {
            let times = self.times();
            let ends = [times.first(), times.last()].into_iter().flatten();
            ends.map(|&time| (time, height)).collect::<Points>()
        };
        figure(
            "What the fit leaves: 5 % of noise is beyond the lines",
            ["time (s)", "(fit − recorded)/σ of the sensor"],
            vec![
                ("displacement", DOTTED + 1, self.over_time(travel, |r| r)),
                (
                    "temperature",
                    DOTTED + 2,
                    self.over_time(temperature, |r| r),
                ),
                ("two standard deviations", PLAIN, line(2.0)),
                ("", PLAIN, line(-2.0)),
            ],
        )
    }

    /// All members over each unknown.
    fn misfit(&self) -> Figure {
        let freedom = super::freedom(self.data.recording);
        let over = |unknown: usize| -> Points {
            let samples = self.survey.samples.iter();
            samples
                .map(|sample| (sample.logs[unknown].exp(), sample.misfit / freedom))
                .map(|(value, misfit)| (value / self.fit.point.logs[unknown].exp(), misfit))
                .collect()
        };
        let found = self.fit.misfit / freedom;
        figure(
            "Misfit of the sweep's members, each over its three unknowns",
            ["unknown as a factor of the fitted one", "χ²/(n − 3)"],
            vec![
                (UNKNOWNS[0].name, DOTTED + 3, over(0)),
                (UNKNOWNS[1].name, OPEN + 1, over(1)),
                (UNKNOWNS[2].name, DOTTED + 2, over(2)),
                ("fit", OPEN, vec![(1.0, found)]),
            ],
        )
        .with(Axes::DoublyLogarithmic)
    }

    /// Two unknowns as found from fresh noise, with the ellipse that has 95 % of them, and the truth.
    fn estimates(&self, [x, y]: [usize; 2]) -> Figure {
        let off = |logs: &Logs, unknown: usize| {
            let factor = logs[unknown].exp() / UNKNOWNS[unknown].truth;
            100.0 * (factor - 1.0)
        };
        let of = |logs: &Logs| (off(logs, x), off(logs, y));
        let fitted = self.fit.point.logs;
        let outline = ellipse(self.covariance, [x, y]).into_iter();
        let outline = outline.map(|(u, v)| {
            let mut logs = fitted;
            logs[x] += u;
            logs[y] += v;
            of(&logs)
        });
        let estimates = self.bootstrap.estimates.iter().map(of);
        let labels = [x, y].map(|unknown| format!("{}, off the truth (%)", UNKNOWNS[unknown].name));
        figure(
            "Fits of fresh noise, and where the linearised model has 95 % of them",
            [&labels[0], &labels[1]],
            vec![
                ("fits of fresh noise", OPEN + 1, estimates.collect()),
                ("95 %, linear", PLAIN + 1, outline.collect()),
                ("fit", 3, vec![of(&fitted)]),
                ("truth", 2, vec![(0.0, 0.0)]),
            ],
        )
    }
}

fn figure(
    title: &str,
    [x_label, y_label]: [&str; 2],
    curves: Vec<(&str, usize, Points)>,
) -> Figure {
    let curve = |(label, look, points): (&str, usize, Points)| Curve {
        label: label.to_owned(),
        points,
        look,
        trusted: true,
        decisive: usize::MAX,
    };
    Figure {
        title: title.to_owned(),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        curves: curves.into_iter().map(curve).collect(),
        axes: Axes::Even,
    }
}

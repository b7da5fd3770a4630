//! The picture of the deformed satellite at chosen times.

use std::error::Error;
use std::path::Path;

use eem::prelude::*;

use super::Case;
use super::scene::{self, satellite};
use eem_studies::deformed::{self, Mark, Picture, State, View};
use eem_studies::points;
use eem_studies::time_grid::TimeGrid;

/// Times of the states, s, as far as the run has them.
const TIMES: [f64; 6] = [0.0, 2.0, 5.0, 15.0, 30.0, 60.0];

/// What it is run with.
const SCHEME: Scheme = Scheme::EemEntropy;

/// Runs the satellite once more and draws it.
pub(crate) fn write(directory: &Path, case: Case, grid: TimeGrid) -> Result<(), Box<dyn Error>> {
    let satellite = satellite(case.axis, move |t| scene::thrust(t, case.stops))?;
    let mut run = Simulation::new(satellite.scene, SCHEME, grid.step)?;
    let states = deformed::states(&mut run, &TIMES, grid.end(), |run| {
        let strain = |points: &[Element]| mean_strain(run, points);
        let mut patches = deformed::patches(run, &satellite.body, strain)?;
        for panel in &satellite.panels {
            patches.extend(deformed::patches(run, panel, strain)?);
        }
        let marks = satellite.marks.iter();
        let marks = marks.map(|(name, nodes)| {
            let places = deformed::places(run, nodes.iter().copied())?;
            Ok(Mark { name, places })
        });
        Ok(State {
            patches,
            marks: marks.collect::<Result<_, SceneError>>()?,
            ..State::default()
        })
    })?;
    let picture = Picture {
        title: format!("A satellite ({SCHEME}): strain of each cell"),
        quantity: "mean strain √(G : G)".to_owned(),
        view: View::Oblique(2),
        states,
    };
    picture.write_svg(&directory.join("shapes.svg"))
}

/// The mean of `√(G : G)` over some points.
fn mean_strain(run: &Simulation<3>, points_of_cell: &[Element]) -> Result<f64, SceneError> {
    let norm = |&point| Ok(run.solid_state(point)?.strain.norm());
    points::mean_of(points_of_cell.iter().map(norm))
}

//! The picture of the deformed block at chosen times.

use std::error::Error;
use std::path::Path;

use eem::prelude::*;

use super::scene::{Block, block};
use eem_studies::deformed::{self, Picture, View};
use eem_studies::time_grid::TimeGrid;

/// Times of the states, s, as far as the run has them.
const TIMES: [f64; 6] = [0.0, 1.0, 2.0, 5.0, 10.0, 15.0];

/// What it is run with.
const SCHEME: Scheme = Scheme::EemTemperature;

/// Runs the block once more and draws it.
pub(crate) fn write(directory: &Path, grid: TimeGrid) -> Result<(), Box<dyn Error>> {
    let Block { scene, body } = block()?;
    let mut run = Simulation::new(scene, SCHEME, grid.step)?;
    let states = deformed::states(&mut run, &TIMES, grid.end(), |run| {
        deformed::temperatures(run, &body)
    })?;
    let picture = Picture {
        title: format!("An L-shaped block ({SCHEME}): temperature of each cell"),
        quantity: "mean temperature (K)".to_owned(),
        view: View::Oblique(1),
        states,
    };
    picture.write_svg(&directory.join("shapes.svg"))
}

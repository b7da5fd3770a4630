//! The picture of the deformed block at chosen times.

use std::error::Error;
use std::path::Path;

use eem::prelude::*;

use super::scene::{Block, block};
use eem_studies::deformed::{self, Picture, View};
use eem_studies::time_grid::TimeGrid;

/// Times of the states, s, as far as the run has them.
const TIMES: [f64; 6] = [0.0, 1.0, 2.0, 5.0, 10.0, 15.0];

/// Runs the block once more and draws it.
pub(crate) fn write(directory: &Path, grid: TimeGrid) -> Result<(), Box<dyn Error>> {
    let Block { scene, body } = block()?;
    let mut run = Simulation::new(scene, Scheme::EemTemperature, grid.step)?;
    let states = deformed::states(&mut run, &TIMES, grid.end(), |run| {
        deformed::temperatures(run, &body)
    })?;
    let picture = Picture {
        title: "An L-shaped block: its shape, and the mean temperature of each cell".to_owned(),
        quantity: "temperature (K)".to_owned(),
        view: View::Oblique(1),
        states,
    };
    picture.write_svg(&directory.join("shapes.svg"))
}

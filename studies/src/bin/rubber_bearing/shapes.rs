//! The picture of the sheared bearing at chosen times.

use std::error::Error;
use std::path::Path;

use eem::prelude::*;

use super::scene::{Bearing, bearing};
use eem_studies::deformed::{self, Picture, View};
use eem_studies::time_grid::TimeGrid;

/// Times of the states, s, as far as the run has them: where the plate is farthest to one side or the other.
const TIMES: [f64; 4] = [1.25, 5.75, 12.25, 19.75];

/// What it is run with.
const SCHEME: Scheme = Scheme::EemTemperature;

/// Runs the bearing once more and draws it.
pub(crate) fn write(directory: &Path, grid: TimeGrid) -> Result<(), Box<dyn Error>> {
    let Bearing { scene, rubber, .. } = bearing()?;
    let mut run = Simulation::new(scene, SCHEME, grid.step)?;
    let states = deformed::states(&mut run, &TIMES, grid.end(), |run| {
        deformed::temperatures(run, &rubber)
    })?;
    if states.is_empty() {
        return Ok(());
    }
    let picture = Picture {
        title: format!("A rubber bearing ({SCHEME}): temperature of each cell"),
        quantity: "mean temperature (K)".to_owned(),
        view: View::Along(2),
        states,
    };
    picture.write_svg(&directory.join("shapes.svg"))
}

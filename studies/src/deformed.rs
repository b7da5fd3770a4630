//! Pictures of deformed solids as SVG: their outside faces, coloured by a quantity, at one or several times.
//!
//! Faces are drawn from the farthest to the nearest, and only those that look at the viewer. Solids that touch are
//! drawn together, in the order of all their faces.

mod drawing;

use std::error::Error;
use std::path::Path;

use eem::Body;
use eem::kinematics::Shape;
use eem::prelude::*;

use super::points;

/// A picture of several states, which share scale, view and colours.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Title above the picture.
    pub title: String,
    /// What colours mean, with the unit, for example `temperature (K)`.
    pub quantity: String,
    /// From where it is seen.
    pub view: View,
    /// What is shown side by side.
    pub states: Vec<State>,
}

/// From where solids are seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Along an axis, against its direction; along z, x points to the right and y upwards.
    Along(usize),
    /// From between the axes x, y and z, with this one upwards; lengths along all axes are shortened alike.
    Oblique(usize),
}

/// What is to be seen at one time.
#[derive(Clone, Debug)]
pub struct State {
    /// Below it, for example `t = 2 s`.
    pub caption: String,
    /// All faces.
    pub patches: Vec<Patch>,
}

/// A face in its place, m, and the value that gives it its colour.
#[derive(Clone, Debug)]
pub struct Patch {
    /// Its corners, m.
    pub corners: Vec<[f64; 3]>,
    /// In the unit of the picture.
    pub value: f64,
}

impl Picture {
    /// Draws the picture into the SVG file `path`.
    pub fn write_svg(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        drawing::draw(self, path).map_err(|error| format!("{}: {error}", path.display()).into())
    }
}

/// The outside faces of a solid where it is now, with a value for the points of the cell behind each.
pub fn patches<H: Shape<D>, const D: usize>(
    run: &Simulation<D>,
    body: &Body<H, D>,
    value: impl Fn(&[Element]) -> Result<f64, SceneError>,
) -> Result<Vec<Patch>, SceneError> {
    let per_cell = body.points().len() / body.mesh().cells().len();
    let patch = |outline: eem::Outline| {
        let place = |&node: &usize| {
            let position = run.position(body.nodes()[node])?;
            let along = |axis: usize| if axis < D { position[axis] } else { 0.0 };
            Ok::<_, SceneError>([along(0), along(1), along(2)])
        };
        let points = &body.points()[outline.cell * per_cell..][..per_cell];
        Ok(Patch {
            corners: outline.nodes.iter().map(place).collect::<Result<_, _>>()?,
            value: value(points)?,
        })
    };
    body.mesh().outlines().into_iter().map(patch).collect()
}

/// The same with the mean temperatures, K.
pub fn temperatures<H: Shape<D>, const D: usize>(
    run: &Simulation<D>,
    body: &Body<H, D>,
) -> Result<Vec<Patch>, SceneError> {
    patches(run, body, |points| {
        points::mean_of(points.iter().map(|&point| run.temperature(point)))
    })
}

/// What is to be seen at some times (s) of a run, as far as they come before its end.
pub fn states<const D: usize>(
    run: &mut Simulation<D>,
    times: &[f64],
    end: f64,
    patches: impl Fn(&Simulation<D>) -> Result<Vec<Patch>, SceneError>,
) -> Result<Vec<State>, Box<dyn Error>> {
    let mut states = Vec::new();
    for &time in times.iter().filter(|&&time| time <= end) {
        run.run_until(time)?;
        states.push(State {
            caption: format!("t = {time} s"),
            patches: patches(run)?,
        });
    }
    Ok(states)
}

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
pub(crate) struct Picture {
    /// Title above the picture.
    pub(crate) title: String,
    /// What colours mean, with the unit, for example `temperature (K)`.
    pub(crate) quantity: String,
    pub(crate) view: View,
    pub(crate) states: Vec<State>,
}

/// From where solids are seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum View {
    /// Along an axis, against its direction; along z, x points to the right and y upwards.
    Along(usize),
    /// From between the axes x, y and z, with this one upwards; lengths along all axes are shortened alike.
    Oblique(usize),
}

/// What is to be seen at one time.
#[derive(Clone, Debug)]
pub(crate) struct State {
    /// Below it, for example `t = 2 s`.
    pub(crate) caption: String,
    pub(crate) patches: Vec<Patch>,
}

/// A face in its place, m, and the value that gives it its colour.
#[derive(Clone, Debug)]
pub(crate) struct Patch {
    pub(crate) corners: Vec<[f64; 3]>,
    pub(crate) value: f64,
}

impl Picture {
    /// Draws the picture into the SVG file `path`.
    pub(crate) fn write_svg(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        drawing::draw(self, path).map_err(|error| format!("{}: {error}", path.display()).into())
    }
}

/// The outside faces of a solid where it is now, with a value for the points of the cell behind each.
pub(crate) fn patches<H: Shape<D>, const D: usize>(
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
pub(crate) fn temperatures<H: Shape<D>, const D: usize>(
    run: &Simulation<D>,
    body: &Body<H, D>,
) -> Result<Vec<Patch>, SceneError> {
    patches(run, body, |points| {
        points::mean_of(points.iter().map(|&point| run.temperature(point)))
    })
}

/// What is to be seen at some times (s) of a run, as far as they come before its end.
pub(crate) fn states<const D: usize>(
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

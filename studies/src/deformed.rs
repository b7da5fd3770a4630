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

/// Straight lines that a curved edge is drawn with.
const EDGE_PARTS: u8 = 4;

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
#[derive(Clone, Debug, Default)]
pub struct State {
    /// Below it, for example `t = 2 s`.
    pub caption: String,
    /// All faces.
    pub patches: Vec<Patch>,
    /// What is drawn over them, also where it is behind them.
    pub marks: Vec<Mark>,
}

/// What has no faces: a line through some places, m, or a dot if there is only one.
#[derive(Clone, Debug)]
pub struct Mark {
    /// What the legend says; marks of one name have one colour.
    pub name: &'static str,
    /// Where it is, m.
    pub places: Vec<[f64; 3]>,
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
        let nodes = outline.nodes.iter().map(|&node| body.nodes()[node]);
        let places = places(run, nodes)?;
        let points = &body.points()[outline.cell * per_cell..][..per_cell];
        Ok(Patch {
            corners: if places.len() == 8 {
                curved(&places)
            } else {
                places
            },
            value: value(points)?,
        })
    };
    body.mesh().outlines().into_iter().map(patch).collect()
}

/// Where nodes are, m.
pub fn places<const D: usize>(
    run: &Simulation<D>,
    nodes: impl IntoIterator<Item = Node>,
) -> Result<Vec<[f64; 3]>, SceneError> {
    let place = |node: Node| {
        let position = run.position(node)?;
        let along = |axis: usize| if axis < D { position[axis] } else { 0.0 };
        Ok([along(0), along(1), along(2)])
    };
    nodes.into_iter().map(place).collect()
}

/// Points of the parabolas through four corners and the middles of edges between them.
fn curved(nodes: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut points = Vec::new();
    for at in (0..nodes.len()).step_by(2) {
        let [start, middle, end] = [0, 1, 2].map(|next| nodes[(at + next) % nodes.len()]);
        for part in 0..EDGE_PARTS {
            let t = f64::from(part) / f64::from(EDGE_PARTS);
            let weights = [
                (1.0 - t) * (1.0 - 2.0 * t),
                4.0 * t * (1.0 - t),
                t * (2.0 * t - 1.0),
            ];
            points.push([0, 1, 2].map(|axis| {
                weights[0] * start[axis] + weights[1] * middle[axis] + weights[2] * end[axis]
            }));
        }
    }
    points
}

/// A solid with its mean temperatures, K.
pub fn temperatures<H: Shape<D>, const D: usize>(
    run: &Simulation<D>,
    body: &Body<H, D>,
) -> Result<State, SceneError> {
    let patches = patches(run, body, |points| {
        points::mean_of(points.iter().map(|&point| run.temperature(point)))
    })?;
    Ok(State {
        patches,
        ..State::default()
    })
}

/// What is to be seen at some times (s) of a run, as far as they come before its end.
pub fn states<const D: usize>(
    run: &mut Simulation<D>,
    times: &[f64],
    end: f64,
    seen: impl Fn(&Simulation<D>) -> Result<State, SceneError>,
) -> Result<Vec<State>, Box<dyn Error>> {
    let mut states = Vec::new();
    for &time in times.iter().filter(|&&time| time <= end) {
        run.run_until(time)?;
        states.push(State {
            caption: format!("t = {time} s"),
            ..seen(run)?
        });
    }
    Ok(states)
}

//! The satellite: body, panels, stiffeners and rockets.

use std::error::Error;

use clap::ValueEnum;
use eem::Body;
use eem::kinematics::Hex8;
use eem::prelude::*;

use super::single_pendulum::SPRING;

/// Step and end time, s.
pub(crate) const STEP: f64 = 0.2;
pub(crate) const END: f64 = 62.0;

/// When the rockets fire, s: to start the turn, and to stop it.
pub(crate) const FIRED: f64 = 1.0;
pub(crate) const STOP: [f64; 2] = [59.0, 60.0];

/// Thrust of each of the two rockets, N.
const THRUST: f64 = 26.5;

/// Half the side of the body, thickness of the panels, and where the stiffeners hold them, m: √3/2 from
/// the body.
const HALF: f64 = 0.5;
const THICKNESS: f64 = 0.1;
const FOOT: f64 = HALF + 0.866_025_403_784_438_6;

/// Where the panels end, m.
pub(crate) const TIP: f64 = 4.5;

/// Densities of body and panels, kg/m³.
const BODY_DENSITY: f64 = 500.0;
const PANEL_DENSITY: f64 = 10.0;

/// Of the stiffeners, and of what is around them, K.
pub(crate) const TEMPERATURE: f64 = 300.0;

/// From each stiffener to what is around it, W/K.
const CONDUCTANCE: f64 = 20.0;

/// Farther apart nodes are not one, m.
const NEAR: f64 = 1e-9;

/// Saint-Venant and Kirchhoff.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * lame * e1.powi(2) + shear * e2)]
pub(crate) struct Elastic {
    #[unit("Pa")]
    lame: f64,
    #[unit("Pa")]
    shear: f64,
}

impl Elastic {
    /// With Young's modulus (Pa) and Poisson's ratio 0.3.
    const fn new(modulus: f64) -> Self {
        Self {
            lame: modulus * 0.3 / ((1.0 + 0.3) * (1.0 - 2.0 * 0.3)),
            shear: modulus / (2.0 * (1.0 + 0.3)),
        }
    }
}

const BODY: Elastic = Elastic::new(1e9);
const PANEL: Elastic = Elastic::new(5000.0);

/// About which axis the rockets turn it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Axis {
    /// That of the hinges: the panels flap.
    Y,
    /// That across the panels.
    Z,
}

impl Axis {
    /// A place at some x and to some side of the axis, m.
    fn beside(self, x: f64, side: f64) -> [f64; 3] {
        match self {
            Self::Y => [x, 0.0, side],
            Self::Z => [x, side, 0.0],
        }
    }

    /// A place after a turn about the axis, m and rad.
    pub(crate) fn turned(self, [x, y, z]: [f64; 3], angle: f64) -> [f64; 3] {
        let (sin, cos) = angle.sin_cos();
        match self {
            Self::Y => [x * cos + z * sin, y, z * cos - x * sin],
            Self::Z => [x * cos - y * sin, x * sin + y * cos, z],
        }
    }
}

/// The scene, and what is looked at in it.
pub(crate) struct Satellite {
    pub(crate) scene: Scene<3>,
    pub(crate) body: Body<Hex8, 3>,
    pub(crate) panels: [Body<Hex8, 3>; 2],
    pub(crate) stiffeners: Vec<Element>,
    /// Names and nodes of what has no faces.
    pub(crate) marks: Vec<(&'static str, Vec<Node>)>,
    /// Two nodes of the body, one behind the other along x.
    pub(crate) line: [Node; 2],
    /// Nodes that the rockets push, one each.
    pub(crate) rockets: [Node; 2],
}

/// The satellite at rest; its rockets have this thrust over time, N, which turns it about an axis.
pub(crate) fn satellite<F>(axis: Axis, thrust: F) -> Result<Satellite, Box<dyn Error>>
where
    F: Fn(f64) -> f64 + Clone + Send + Sync + 'static,
{
    let mut scene = Scene::<3>::new();
    let cube = Mesh::block([2; 3], [[-HALF, HALF]; 3])?;
    let body = scene.solid(BODY, &cube, &Bulk::new(BODY_DENSITY));
    let right = right_panel()?;
    let left = right.mapped(|[x, y, z]| [-x, -y, z])?;
    let bulk = Bulk::new(PANEL_DENSITY).joined_to(&body, NEAR);
    let panels = [right, left].map(|mesh| scene.solid(PANEL, &mesh, &bulk));
    let mut marks = Vec::new();
    let stiffeners = stiffen(&mut scene, &body, &panels, &mut marks)?;
    for x in [-HALF, HALF] {
        for y in [-HALF, 0.0, HALF] {
            marks.push(("hinge", vec![body.node_at([x, y, 0.0], 0.0)?]));
        }
    }
    let mut rockets = Vec::new();
    for side in [-HALF, HALF] {
        // Both push along x, to opposite sides: their couple turns about the positive axis.
        let end = match axis {
            Axis::Y => side,
            Axis::Z => -side,
        };
        let node = |x: f64| body.node_at(axis.beside(x, side), 0.0);
        let line = [node(-end)?, node(end)?];
        scene.rocket(node(0.0)?, line, thrust.clone());
        rockets.push(node(0.0)?);
        marks.push(("rocket, first pushes to the dot", vec![node(0.0)?, line[1]]));
        marks.push(("rocket, first pushes to the dot", vec![line[1]]));
    }
    let line = [
        body.node_at(axis.beside(-HALF, HALF), 0.0)?,
        body.node_at(axis.beside(HALF, HALF), 0.0)?,
    ];
    Ok(Satellite {
        scene,
        body,
        panels,
        stiffeners,
        marks,
        line,
        rockets: [rockets[0], rockets[1]],
    })
}

/// A plate of 8 × 2 × 2 cells on the right; a line of its nodes is where the stiffeners hold it.
fn right_panel() -> Result<Mesh<Hex8, 3>, eem::MeshError> {
    let lengths = [HALF, 1.0, FOOT, 2.0, 2.5, 3.0, 3.5, 4.0, TIP];
    let half = 0.5 * THICKNESS;
    Mesh::grid([&lengths, &[-HALF, 0.0, HALF], &[-half, 0.0, half]])
}

/// Warm creeping springs from the corners of the body to the panels, in contact with what is around.
fn stiffen(
    scene: &mut Scene<3>,
    body: &Body<Hex8, 3>,
    panels: &[Body<Hex8, 3>; 2],
    marks: &mut Vec<(&'static str, Vec<Node>)>,
) -> Result<Vec<Element>, eem::MeshError> {
    let surroundings = scene.reservoir(TEMPERATURE);
    let mut stiffeners = Vec::new();
    for (panel, x) in panels.iter().zip([1.0, -1.0]) {
        for y in [-HALF, HALF] {
            for z in [-HALF, HALF] {
                let ends = [
                    body.node_at([x * HALF, y, z], 0.0)?,
                    panel.node_at([x * FOOT, y, 0.0], 0.0)?,
                ];
                let stiffener = scene.spring(SPRING, ends);
                scene.set_temperature(stiffener, TEMPERATURE);
                scene.conduct(stiffener, surroundings, CONDUCTANCE);
                stiffeners.push(stiffener);
                marks.push(("stiffener", ends.to_vec()));
            }
        }
    }
    Ok(stiffeners)
}

/// The thrust over time that starts and may stop the turn, N.
pub(crate) fn thrust(t: f64, stops: bool) -> f64 {
    if t < FIRED {
        THRUST
    } else if stops && STOP[0] < t && t < STOP[1] {
        -THRUST
    } else {
        0.0
    }
}

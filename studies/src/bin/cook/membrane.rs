//! The membrane: mesh, material, load, and what it looks like at rest.

use std::error::Error;

use eem::Body;
use eem::kinematics::Shape;
use eem::prelude::*;

use eem_studies::deformed::{self, State};

/// Modulus of elasticity (Pa), Poisson's ratio.
const MODULUS: f64 = 240.565;
const RATIO: f64 = 0.3;

/// The load on the right side: the whole of it, N, and the length of that side, m.
const LOAD: f64 = 100.0;
const SIDE: f64 = 16.0;

/// Density, kg/m³, which has no effect at rest.
const DENSITY: f64 = 1.0;

/// Saint-Venant and Kirchhoff.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * lame * e1.powi(2) + shear * e2)]
struct SaintVenant {
    #[unit("Pa")]
    lame: f64,
    #[unit("Pa")]
    shear: f64,
}

/// A loaded membrane of cells of the shape `H`.
pub(crate) struct Membrane<H: Shape<2>> {
    cells: usize,
    body: Body<H, 2>,
    run: Simulation<2>,
}

/// What the table says of a mesh.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) nodes_per_cell: usize,
    /// Per side.
    pub(crate) cells: usize,
    pub(crate) nodes: usize,
    /// The displacement of the corner (48, 60), m.
    pub(crate) corner: [f64; 2],
}

impl Row {
    /// As in the CSV file.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        let counts = [self.nodes_per_cell, self.cells, self.nodes];
        let counts = counts.map(|count| f64::from(u32::try_from(count).unwrap_or(u32::MAX)));
        counts.into_iter().chain(self.corner).collect()
    }
}

impl<H: Shape<2>> Membrane<H> {
    /// The membrane at rest under its load.
    pub(crate) fn loaded(cells: usize) -> Result<Self, Box<dyn Error>> {
        let square = Mesh::<H, 2>::block([cells; 2], [[0.0, 1.0]; 2])?;
        let mesh = square.mapped(|[x, y]| [48.0 * x, 44.0 * x + y * (44.0 - 28.0 * x)])?;
        let material = SaintVenant {
            lame: MODULUS * RATIO / ((1.0 + RATIO) * (1.0 - 2.0 * RATIO)),
            shear: MODULUS / (2.0 + 2.0 * RATIO),
        };
        let mut scene = Scene::<2>::new();
        let body = scene.solid(material, &mesh, &Bulk::new(DENSITY));
        for node in body.nodes_where(|[x, _]| x <= 0.0) {
            scene.fix(node);
        }
        let end = mesh.face(|[x, _]| x >= 48.0)?;
        scene.traction(&body, &end, |_| [0.0, LOAD / SIDE]);
        scene.equilibrium(Equilibrium::new())?;
        let run = Simulation::new(scene, Scheme::default(), 1.0)?;
        Ok(Self { cells, body, run })
    }

    /// A row of the table, and what there is to draw.
    pub(crate) fn seen(&self) -> Result<(Row, State), Box<dyn Error>> {
        let Self { cells, body, run } = self;
        let node = body.node_at([48.0, 60.0], 0.0)?;
        let [x, y]: [f64; 2] = run.position(node)?.into();
        let row = Row {
            nodes_per_cell: H::NODES.len(),
            cells: *cells,
            nodes: body.nodes().len(),
            corner: [x - 48.0, y - 60.0],
        };
        let state = State {
            caption: format!("{cells} × {cells} cells of {} nodes", H::NODES.len()),
            patches: deformed::patches(run, body, |points| {
                let (mut sum, mut count) = (0.0, 0.0);
                for &point in points {
                    sum += run.solid_state(point)?.von_mises();
                    count += 1.0;
                }
                Ok(sum / count)
            })?,
            marks: Vec::new(),
        };
        Ok((row, state))
    }
}

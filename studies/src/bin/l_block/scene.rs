//! The block: its mesh and material, what pulls it, and how warm it is.

use eem::kinematics::Hex8;
use eem::prelude::*;
use eem::{Body, MeshError};

/// Step and end time, s.
pub(crate) const STEP: f64 = 0.025;
pub(crate) const END: f64 = 15.0;

/// When the tractions have ended, s.
pub(crate) const LOADED: f64 = 2.0;

/// Volume of both legs, m³.
pub(crate) const VOLUME: f64 = 3.0 * 10.0 * 3.0 + 3.0 * 3.0 * 3.0;

/// The ends of the legs, m.
const LONG: f64 = 10.0;
const SHORT: f64 = 6.0;

/// Per volume: density (kg/m³), conductivity (W/(m K)).
const DENSITY: f64 = 10.0;
const CONDUCTIVITY: f64 = 10.0;

/// The tractions at their largest, Pa.
const TRACTION: [f64; 3] = [256.0 / 9.0, 512.0 / 9.0, 768.0 / 9.0];

/// Temperatures at t = 0 of the ends of the long and the short leg, K; elsewhere it is that without thermal
/// stress.
const WARM: f64 = 313.15;
const COLD: f64 = 273.15;

/// Lamé's constants at small strains, Pa.
const LAME: f64 = 5209.0;
const SHEAR: f64 = 997.5;

/// Mooney–Rivlin, compressible, that expands when it is warm.
#[derive(Clone, Debug, FreeEnergy)]
#[free_energy(|e1: StrainTrace, e2: StrainSquare, j: Dilatation, theta: Temperature| {
    let isochoric = 2 * a * e1 + b * (4 * e1 + 2 * (e1.powi(2) - e2));
    let volumetric = 0.5 * c1 * j.powi(2) - d1 * ln_1p(j);
    let heating = theta - theta_ref;
    isochoric + volumetric - 3 * beta * heating * (c2 * j - d2 / (1 + j))
        + capacity * (heating - theta * ln(theta / theta_ref))
})]
pub(crate) struct MooneyRivlin {
    #[unit("Pa")]
    a: f64,
    #[unit("Pa")]
    b: f64,
    #[unit("Pa")]
    c1: f64,
    #[unit("Pa")]
    d1: f64,
    #[unit("Pa")]
    c2: f64,
    #[unit("Pa")]
    d2: f64,
    #[unit("1/K")]
    beta: f64,
    #[unit("Pa/K")]
    pub(crate) capacity: f64,
    #[unit("K")]
    theta_ref: f64,
}

pub(crate) const RUBBER: MooneyRivlin = MooneyRivlin {
    a: SHEAR / 4.0,
    b: SHEAR / 4.0,
    c1: LAME - SHEAR,
    d1: 2.0 * (SHEAR / 4.0 + 2.0 * SHEAR / 4.0),
    c2: LAME,
    d2: SHEAR * 2.0 / 3.0,
    beta: 2.233e-4,
    capacity: 100.0,
    theta_ref: 293.15,
};

/// The scene, and the solid in it.
pub(crate) struct Block {
    pub(crate) scene: Scene<3>,
    pub(crate) body: Body<Hex8, 3>,
}

/// The block at rest, warm at one end and cold at the other, and the tractions on both.
pub(crate) fn block() -> Result<Block, MeshError> {
    let cuts: [&[f64]; 3] = [&[0.0, 3.0, SHORT], &[0.0, 3.0, 6.5, LONG], &[0.0, 3.0]];
    let mesh = Mesh::grid(cuts)?.kept(|[x, y, _]| x < 3.0 || y < 3.0)?;
    let bulk = Bulk::new(DENSITY).conductivity(CONDUCTIVITY);
    let mut scene = Scene::<3>::new();
    let body = scene.solid(RUBBER, &mesh, &bulk);
    for (&point, theta) in body.points().iter().zip(temperatures(&mesh)) {
        scene.set_temperature(point, theta);
    }
    let ends = [
        (1.0, mesh.face(|[_, y, _]| y >= LONG)?),
        (-1.0, mesh.face(|[x, ..]| x >= SHORT)?),
    ];
    for (sign, end) in ends {
        let traction = move |t: f64| TRACTION.map(|largest| sign * largest * pulse(t));
        scene.traction(&body, &end, traction);
    }
    Ok(Block { scene, body })
}

/// Grows for a second and falls for another.
fn pulse(t: f64) -> f64 {
    t.min(LOADED - t).max(0.0)
}

/// The temperature of every point at t = 0, K. Points stand for the eighths of a cell, the first coordinate
/// fastest: the upper ones along an axis are 1, 3, 5, 7 for x and 2, 3, 6, 7 for y.
fn temperatures(mesh: &Mesh<Hex8, 3>) -> Vec<f64> {
    let of_cell = |cell: &[usize; 8]| {
        let is_at =
            |axis: usize, end: f64| cell.iter().any(|&node| mesh.nodes()[node][axis] >= end);
        let (at_short, at_long) = (is_at(0, SHORT), is_at(1, LONG));
        [0, 1, 2, 3, 4, 5, 6, 7].map(|point| match point {
            2 | 3 | 6 | 7 if at_long => WARM,
            1 | 3 | 5 | 7 if at_short => COLD,
            _ => RUBBER.theta_ref,
        })
    };
    mesh.cells().iter().flat_map(of_cell).collect()
}

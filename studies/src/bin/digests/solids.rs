//! Solids, elastic ones and warm ones.

use eem::Scalar;
use eem::kinematics::{Hex8, Quad4, Shape};
use eem::prelude::*;
use eem::{FreeEnergy, StrainEnergy};
use eem_studies::build::Build;
use eem_studies::models::{Solid, WarmSolid};

use crate::matrix::Entry;
use crate::watch::{Case, Drive};

/// A sheet in the plane, of more cells than are evaluated at a time.
#[derive(Clone, Copy)]
pub(crate) enum Sheet {
    Elastic,
    Warm,
}

/// A free block in space.
#[derive(Clone, Copy)]
pub(crate) enum Block {
    Elastic,
    Warm,
}

const fn entry<C>(name: &'static str, case: C, step: f64, steps: usize) -> Entry<C> {
    Entry {
        name,
        case,
        step,
        drive: Drive::Steps(steps),
    }
}

pub(crate) const SHEETS: [Entry<Sheet>; 2] = [
    entry("sheet", Sheet::Elastic, 0.05, 5),
    entry("warm-sheet", Sheet::Warm, 0.01, 3),
];

pub(crate) const BLOCKS: [Entry<Block>; 2] = [
    entry("block", Block::Elastic, 0.05, 5),
    entry("warm-block", Block::Warm, 0.01, 3),
];

const SOLID: Solid = Solid {
    lame: 2000.0,
    shear: 1000.0,
};
const RUBBER: WarmSolid = WarmSolid {
    shear: 1000.0,
    softening: 2.0,
    lame: 2000.0,
    expansion: 3.0,
    capacity: 100.0,
    theta_ref: 300.0,
};

impl Case<2> for Sheet {
    fn build(self) -> Build<2> {
        let mut build = Build::new();
        let mesh = made(Mesh::<Quad4, 2>::block([9, 5], [[0.0, 9.0], [0.0, 5.0]]));
        let speed = |[x, y]: [f64; 2]| [Scalar::sin(0.7 * x + y), Scalar::cos(x - 0.3 * y)];
        match self {
            Self::Elastic => elastic(&mut build, &mesh, speed),
            Self::Warm => warm(&mut build, &mesh, speed),
        }
        build
    }
}

impl Case<3> for Block {
    fn build(self) -> Build<3> {
        let mut build = Build::new();
        let mesh = made(Mesh::<Hex8, 3>::block(
            [3, 2, 2],
            [[0.0, 3.0], [0.0, 2.0], [0.0, 2.0]],
        ));
        let speed =
            |[x, y, z]: [f64; 3]| [Scalar::sin(0.7 * x + y), Scalar::cos(x - 0.3 * z), 0.2 * y];
        match self {
            Self::Elastic => elastic(&mut build, &mesh, speed),
            Self::Warm => warm(&mut build, &mesh, speed),
        }
        build
    }
}

/// A mesh whose numbers are right.
fn made<T>(mesh: Result<T, eem::MeshError>) -> T {
    mesh.unwrap_or_else(|error| unreachable!("{error}"))
}

/// A free solid that moves; its points.
fn solid<H: Shape<D>, M, const D: usize, const N: usize>(
    build: &mut Build<D>,
    (model, bulk): (M, &Bulk<D>),
    mesh: &Mesh<H, D>,
    speed: impl Fn([f64; D]) -> [f64; D],
) -> Vec<Element>
where
    M: FreeEnergy<f64> + StrainEnergy<N> + Send + Sync + 'static,
{
    let body = build.scene.solid(model, mesh, bulk);
    for (&node, &place) in body.nodes().iter().zip(mesh.nodes()) {
        let velocity = speed(place);
        build.scene.set_velocity(node, velocity);
    }
    build.handles.nodes.extend(body.nodes());
    build.handles.elements.extend(body.points());
    body.points().to_vec()
}

fn elastic<H: Shape<D>, const D: usize>(
    build: &mut Build<D>,
    mesh: &Mesh<H, D>,
    speed: impl Fn([f64; D]) -> [f64; D],
) {
    let bulk = Bulk::new(10.0);
    solid(build, (SOLID, &bulk), mesh, speed);
}

/// With conduction, and temperatures that differ.
fn warm<H: Shape<D>, const D: usize>(
    build: &mut Build<D>,
    mesh: &Mesh<H, D>,
    speed: impl Fn([f64; D]) -> [f64; D],
) {
    let bulk = Bulk::new(10.0).conductivity(20.0);
    let points = solid(build, (RUBBER, &bulk), mesh, speed);
    for (point, warmth) in points.into_iter().zip((0..11).cycle()) {
        let temperature = 300.0 + f64::from(warmth);
        build.scene.set_temperature(point, temperature);
    }
}

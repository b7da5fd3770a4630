//! Solids whose steps are timed.

use eem::Body;
use eem::kinematics::Hex8;
use eem::prelude::*;

use eem_testkit::scenes::ThermoViscoElastic;
use eem_testkit::scenes::solids::SaintVenant;

/// The nodes of a body turn about its centre, and shear, rad/s.
fn set_in_motion(scene: &mut Scene<3>, body: &Body<Hex8, 3>, rate: f64) {
    for (&node, &[x, y, z]) in body.nodes().iter().zip(body.mesh().nodes()) {
        let turn = [z - y, x, -x];
        let shear = [0.1 * y * z, 0.0, 0.1 * x];
        scene.set_velocity(
            node,
            [0, 1, 2].map(|axis| rate * (turn[axis] + shear[axis])),
        );
    }
}

/// A cube of so many cells along each edge, 1 m long.
pub(crate) fn cube(cells: usize) -> Scene<3> {
    let mesh = Mesh::block([cells; 3], [[-0.5, 0.5]; 3]).unwrap();
    let mut scene = Scene::new();
    let body = scene.solid(RUBBER, &mesh, &Bulk::new(10.0));
    set_in_motion(&mut scene, &body, 1.0);
    scene
}

/// So many cubes of one cell that share no nodes, so that hardly anything is left to be eliminated.
pub(crate) fn separate(cells: usize) -> Scene<3> {
    let mesh = Mesh::block([1; 3], [[-0.5, 0.5]; 3]).unwrap();
    let mut scene = Scene::new();
    for _ in 0..cells {
        let body = scene.solid(RUBBER, &mesh, &Bulk::new(10.0));
        set_in_motion(&mut scene, &body, 1.0);
    }
    scene
}

const RUBBER: SaintVenant = SaintVenant {
    lame: 2000.0,
    shear: 1000.0,
};

/// Of Young's modulus E, Pa, and Poisson's ratio 0.3.
fn isotropic(modulus: f64) -> SaintVenant {
    let ratio = 0.3;
    SaintVenant {
        lame: modulus * ratio / ((1.0 + ratio) * (1.0 - 2.0 * ratio)),
        shear: modulus / (2.0 * (1.0 + ratio)),
    }
}

/// Lines across a panel from the body outwards, m; the fourth is where the springs are attached.
fn lines(side: f64) -> [f64; 9] {
    let attached = 0.5 + 0.75_f64.sqrt();
    [0.5, 1.0, attached, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5].map(|line| side * line)
}

/// A stiff body with two soft panels on hinges and eight warm springs, as the satellite of García Orden & Romero
/// (2012), §4.2, that turns: 183 nodes, 72 cells.
pub(crate) fn satellite() -> Scene<3> {
    let mut scene = Scene::new();
    let across = [-0.5, 0.0, 0.5];
    let mesh = Mesh::block([2; 3], [[-0.5, 0.5]; 3]).unwrap();
    let body = scene.solid(isotropic(1e9), &mesh, &Bulk::new(500.0));
    set_in_motion(&mut scene, &body, SPIN);
    let air = scene.reservoir(300.0);
    for side in [1.0, -1.0] {
        let mut along = lines(side);
        along.sort_by(f64::total_cmp);
        let mesh = Mesh::grid([&along, &across, &[-0.05, 0.0, 0.05]]).unwrap();
        let bulk = Bulk::new(10.0).joined_to(&body, 1e-9);
        let panel = scene.solid(isotropic(5000.0), &mesh, &bulk);
        set_in_motion(&mut scene, &panel, SPIN);
        for [y, z] in [[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]] {
            let corner = body.node_at([0.5 * side, y, z], 1e-9).unwrap();
            let foot = panel.node_at([lines(side)[2], y, 0.0], 1e-9).unwrap();
            let spring = scene.spring(ThermoViscoElastic::PENDULUM, [corner, foot]);
            scene.set_temperature(spring, 300.0);
            scene.conduct(spring, air, 20.0);
        }
    }
    scene
}

/// Of the satellite, rad/s.
const SPIN: f64 = 0.3;

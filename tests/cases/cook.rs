//! The membrane of Cook (1974), plane strain, Saint-Venant–Kirchhoff, with a dead shear on its right side.

use eem::kinematics::{Quad4, Quad8, Shape};
use eem::prelude::*;

use crate::support::solids::SaintVenant;

/// The displacement of the upper right corner at rest, m.
fn corner<H: Shape<2>>(cells: usize) -> [f64; 2] {
    let square = Mesh::<H, 2>::block([cells; 2], [[0.0, 1.0]; 2]).unwrap();
    let membrane = |[x, y]: [f64; 2]| [48.0 * x, 44.0 * x + y * (44.0 - 28.0 * x)];
    let mesh = square.mapped(membrane).unwrap();
    let (modulus, ratio) = (240.565, 0.3);
    let material = SaintVenant {
        lame: modulus * ratio / ((1.0 + ratio) * (1.0 - 2.0 * ratio)),
        shear: modulus / (2.0 + 2.0 * ratio),
    };
    let mut scene = Scene::<2>::new();
    let body = scene.solid(material, &mesh, &Bulk::new(1.0));
    for node in body.nodes_where(|[x, _]| x <= 0.0) {
        scene.fix(node);
    }
    // 100 N on 16 m.
    let end = mesh.face(|[x, _]| x >= 48.0).unwrap();
    scene.traction(&body, &end, |_| [0.0, 100.0 / 16.0]);
    scene.equilibrium(Equilibrium::new()).unwrap();
    let run = Simulation::new(scene, Scheme::EemEntropy, 1e-3).unwrap();
    let node = body.node_at([48.0, 60.0], 0.0).unwrap();
    let [x, y]: [f64; 2] = run.position(node).unwrap().into();
    [x - 48.0, y - 60.0]
}

fn agrees<H: Shape<2>>(cells: usize, known: [f64; 2]) {
    let found = corner::<H>(cells);
    println!("{} {cells}: {found:?}", H::NAME);
    for axis in 0..2 {
        // Eight digits are printed.
        assert!((found[axis] - known[axis]).abs() <= 1e-8, "{found:?}");
    }
}

#[test]
fn the_membrane_of_quadrilaterals_has_its_shape() {
    agrees::<Quad4>(2, [-2.661_325_82, 4.233_042_48]);
    agrees::<Quad4>(4, [-4.809_000_13, 6.081_161_39]);
    agrees::<Quad4>(8, [-6.111_653_79, 7.028_542_94]);
    agrees::<Quad4>(16, [-6.635_132_42, 7.363_962_43]);
}

#[test]
fn the_membrane_with_middles_of_edges_has_its_shape() {
    agrees::<Quad8>(2, [-6.282_715_04, 7.014_618_97]);
    agrees::<Quad8>(4, [-6.706_020_44, 7.377_488_71]);
    agrees::<Quad8>(8, [-6.843_605_94, 7.472_309_24]);
}

//! Lattices of springs, whose times those of solids are compared with.

use eem::prelude::*;

use eem_testkit::scenes::{Hencky, LogarithmicStiffness, ThermoViscoElastic};

/// Of a node, kg.
const MASS: f64 = 1.0;

pub(crate) const SOFTENING: LogarithmicStiffness = LogarithmicStiffness {
    natural_length: 1.0,
    ..LogarithmicStiffness::FIRST
};
const ELASTIC: Hencky = Hencky {
    stiffness: 5000.0,
    natural_length: 1.0,
};

/// A wave in which neighbours move differently, of the order of one.
pub(crate) fn wave(index: usize, phase: f64) -> f64 {
    let index = f64::from(u32::try_from(index).unwrap());
    (0.7 * index + phase).sin()
}

/// Adds a node near a site of a unit lattice, in motion.
pub(crate) fn node(scene: &mut Scene<2>, index: usize, site: [f64; 2]) -> Node {
    let position = [
        site[0] + 0.02 * wave(index, 0.0),
        site[1] + 0.02 * wave(index, 1.0),
    ];
    scene.mass(MASS, position, [wave(index, 2.0), wave(index, 3.0)])
}

pub(crate) fn number(index: usize) -> f64 {
    f64::from(u32::try_from(index).unwrap())
}

/// A square lattice of thermoelastic rows, elastic and thermo-visco-elastic columns.
pub(crate) fn lattice(side: usize, conductance: Option<f64>) -> Scene<2> {
    let mut scene = Scene::new();
    let mut nodes = Vec::with_capacity(side * side);
    for row in 0..side {
        for column in 0..side {
            let site = [number(column), number(row)];
            nodes.push(node(&mut scene, row * side + column, site));
        }
    }
    // The last thermal spring at each node, to which the next one conducts heat.
    let mut warm: Vec<Option<Element>> = vec![None; nodes.len()];
    let mut heat = |scene: &mut Scene<2>, spring: Element, ends: [usize; 2]| {
        scene.set_temperature(spring, 300.0 + 10.0 * wave(ends[0] + ends[1], 4.0));
        for end in ends {
            if let Some((before, conductance)) = warm[end].replace(spring).zip(conductance) {
                scene.conduct(before, spring, conductance);
            }
        }
    };
    for at in 0..nodes.len() {
        let (right, below) = (at + 1, at + side);
        if right % side != 0 {
            let spring = scene.spring(SOFTENING, [nodes[at], nodes[right]]);
            heat(&mut scene, spring, [at, right]);
        }
        if below >= nodes.len() {
            continue;
        }
        let ends = [nodes[at], nodes[below]];
        if at % 2 == 0 {
            scene.spring(ELASTIC, ends);
        } else {
            let spring = scene.spring(ThermoViscoElastic::PENDULUM, ends);
            heat(&mut scene, spring, [at, below]);
        }
    }
    scene
}

//! A satellite with two panels, stiffeners and rockets follows the solution of the discrete equations.

use std::collections::BTreeMap;

use eem::kinematics::Hex8;
use eem::prelude::*;

use crate::blocks::{error, values};
use crate::support::ThermoViscoElastic;
use crate::support::solids::SaintVenant;
use eem_testkit::length::at_length;

const MESH: &str = include_str!("../data/satellite_mesh.csv");
const STATES: &str = include_str!("../data/satellite_eem-entropy_h0.2.csv");

/// The elements of a group, as the numbers of their nodes.
fn elements(group: usize) -> Vec<Vec<usize>> {
    let rows = MESH.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let rows = rows.filter(|row| row[0] == group.to_string());
    let numbers = |row: Vec<&str>| row[2..].iter().map(|node| node.parse().unwrap()).collect();
    rows.map(numbers).collect()
}

/// Saint-Venant and Kirchhoff with Poisson's ratio 0.3.
fn elastic(modulus: f64) -> SaintVenant {
    SaintVenant {
        lame: modulus * 0.3 / (1.3 * 0.4),
        shear: modulus / 2.6,
    }
}

/// A solid of a group, joined to others; its nodes get their numbers.
fn solid(
    scene: &mut Scene<3>,
    group: usize,
    (material, bulk): (SaintVenant, &Bulk<3>),
    nodes: &mut BTreeMap<usize, Node>,
) -> Body<Hex8, 3> {
    let cells = elements(group);
    let mut numbers: Vec<_> = cells.iter().flatten().copied().collect();
    numbers.sort_unstable();
    numbers.dedup();
    let places = values(STATES, 0, "q");
    let places = numbers.iter().map(|&node| places[node][..].try_into());
    let local = |node: &usize| numbers.binary_search(node).unwrap();
    let cells = cells.iter().map(|cell| {
        let cell: Vec<_> = cell.iter().map(local).collect();
        cell.try_into().unwrap()
    });
    let mesh = Mesh::new(places.map(Result::unwrap).collect(), cells.collect()).unwrap();
    let body = scene.solid(material, &mesh, bulk);
    nodes.extend(numbers.into_iter().zip(body.nodes().iter().copied()));
    body
}

/// Rockets turn it about the y axis for 1 s.
#[test]
fn a_satellite_follows_its_discrete_solution() {
    let mut scene = Scene::<3>::new();
    let mut nodes = BTreeMap::new();
    let stiff = (elastic(1e9), &Bulk::new(500.0));
    let body = solid(&mut scene, 0, stiff, &mut nodes);
    for panel in [1, 2] {
        let soft = (elastic(5000.0), &Bulk::new(10.0).joined_to(&body, 1e-9));
        solid(&mut scene, panel, soft, &mut nodes);
    }
    let air = scene.reservoir(300.0);
    let stiffeners: Vec<_> = elements(3)
        .iter()
        .map(|ends| {
            let spring = scene.spring(
                ThermoViscoElastic::PENDULUM,
                [nodes[&ends[0]], nodes[&ends[1]]],
            );
            scene.set_temperature(spring, 300.0);
            scene.conduct(spring, air, 20.0);
            spring
        })
        .collect();
    for side in [-0.5, 0.5] {
        let at = |x: f64| body.node_at([x, 0.0, side], 0.0).unwrap();
        let line = [at(-side), at(side)];
        let fires = |t: f64| if t < 1.0 { 26.5 } else { 0.0 };
        scene.rocket(at(0.0), line, fires);
    }

    let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.2).unwrap();
    let mut compared = 0;
    for step in 1..=at_length(20, 5) {
        run.step().unwrap();
        let known = |what: &str| values(STATES, step, what);
        let q = error(&known("q"), |at| {
            run.position(nodes[&at]).unwrap().as_slice().into()
        });
        let v = error(&known("v"), |at| {
            run.velocity(nodes[&at]).unwrap().as_slice().into()
        });
        let theta = error(&known("theta"), |at| {
            vec![run.temperature(stiffeners[at]).unwrap()]
        });
        let gamma = error(&known("gamma"), |at| {
            vec![run.viscous_stretch(stiffeners[at], 0).unwrap()]
        });
        println!("{step}: {q:e} m, {v:e} m/s, {theta:e} K, {gamma:e} m");
        assert!(q <= 1e-13 && v <= 5e-12 && theta <= 5e-12 && gamma <= 1e-13);
        compared += known("q").len();
    }
    assert_eq!((nodes.len(), compared), (183, at_length(5, 3) * 183));
}

//! A large scene has the same bits on any number of threads.

use eem::prelude::*;

use eem::{Body, kinematics::Quad4};

use crate::support::solids::Viscous;
use crate::support::{Hencky, LogarithmicStiffness, hencky};

/// Nodes along a side of the lattice: enough for its system to be divided, see `eem-sparse/src/division.rs`.
const SIDE: usize = 64;
/// Springs of the chain.
const SPRINGS: usize = 2_000;
/// W/K
const CONDUCTANCE: f64 = 10.0;

const THERMAL: LogarithmicStiffness = LogarithmicStiffness {
    natural_length: 1.0,
    ..LogarithmicStiffness::FIRST
};
const ELASTIC: Hencky = hencky(5000.0, 1.0);

/// A mass in motion; neighbours move differently.
fn node(scene: &mut Scene<2>, [column, row]: [usize; 2]) -> Node {
    let [x, y] = [column, row].map(|count| f64::from(u16::try_from(count).unwrap()));
    scene.mass(1.0, [x, y], [(0.7 * x + y).sin(), (x - 0.3 * y).cos()])
}

/// Nodes in a row with thermoelastic springs, each of which conducts heat to the next if any does.
fn row(scene: &mut Scene<2>, length: usize, row: usize, conducts: bool) -> Vec<Node> {
    let nodes: Vec<_> = (0..length)
        .map(|column| node(scene, [column, row]))
        .collect();
    let springs: Vec<_> = nodes
        .windows(2)
        .map(|ends| scene.spring(THERMAL, [ends[0], ends[1]]))
        .collect();
    for (spring, warmth) in springs.iter().zip((0..11).cycle()) {
        scene.set_temperature(*spring, 300.0 + f64::from(warmth));
    }
    for pair in springs.windows(2).filter(|_| conducts) {
        scene.conduct(pair[0], pair[1], CONDUCTANCE);
    }
    nodes
}

fn chain(conducts: bool) -> Scene<2> {
    let mut scene = Scene::new();
    row(&mut scene, SPRINGS + 1, 0, conducts);
    scene
}

fn lattice(conducts: bool) -> Scene<2> {
    let mut scene = Scene::new();
    let rows: Vec<_> = (0..SIDE)
        .map(|at| row(&mut scene, SIDE, at, conducts))
        .collect();
    for pair in rows.windows(2) {
        for (&above, &below) in pair[0].iter().zip(&pair[1]) {
            scene.spring(ELASTIC, [above, below]);
        }
    }
    scene
}

/// A sheet that conducts heat, with more cells than are found at a time (`element/group/evaluate.rs`), whose nodes move
/// so fast that cells turn inside out on the way to their new places.
fn sheet(speed: f64) -> Scene<2> {
    let mesh = Mesh::block([12, 6], [[0.0, 12.0], [0.0, 6.0]]).unwrap();
    let mut scene = Scene::new();
    let bulk = Bulk::new(10.0).conductivity(20.0);
    let body: Body<Quad4, 2> = scene.solid(Viscous::RUBBER, &mesh, &bulk);
    for (&node, &[x, y]) in body.nodes().iter().zip(mesh.nodes()) {
        let velocity = [speed * (0.7 * x + y).sin(), speed * (x - 0.3 * y).cos()];
        scene.set_velocity(node, velocity);
    }
    for (point, warmth) in body.points().iter().zip((0..11).cycle()) {
        scene.set_temperature(*point, 300.0 + f64::from(warmth));
    }
    scene
}

/// All that the next step depends on, as text that tells all doubles apart.
fn bits(scene: Scene<2>, threads: usize) -> String {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().unwrap().install(|| {
        let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.01).unwrap();
        let settings = NewtonSettings {
            max_iterations: 8,
            ..NewtonSettings::default()
        };
        run.set_newton_settings(settings).unwrap();
        let report = run.step();
        let report = report.map_err(|error| error.to_string());
        format!("{report:?} {:?}", run.checkpoint())
    })
}

#[test]
fn chains_have_the_same_bits_on_any_number_of_threads() {
    for conducts in [false, true] {
        let [one, two] = [1, 2].map(|threads| bits(chain(conducts), threads));
        assert!(one == two, "conducts: {conducts}");
    }
}

#[test]
fn lattices_have_the_same_bits_on_any_number_of_threads() {
    for conducts in [false, true] {
        let [one, two] = [1, 2].map(|threads| bits(lattice(conducts), threads));
        assert!(one == two, "conducts: {conducts}");
    }
}

#[test]
fn solids_have_the_same_bits_and_errors_on_any_number_of_threads() {
    for (speed, is_possible) in [(1.0, true), (100.0, false)] {
        let [one, three] = [1, 3].map(|threads| bits(sheet(speed), threads));
        assert!(one == three, "speed {speed}");
        assert_eq!(one.starts_with("Ok("), is_possible, "{one:.300}");
    }
}

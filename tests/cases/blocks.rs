//! Blocks of hexahedra follow the solutions of the discrete equations.

use eem::kinematics::Hex8;
use eem::prelude::*;
use eem::{Body, MeshError};

use crate::support::solids::{MooneyRivlin, Reinforced, SaintVenant};

const TUMBLING: &str = include_str!("../data/tumbling_block_eem_h0.05.csv");
const VISCOELASTIC: &str = include_str!("../data/viscoelastic_block_eem-temperature_h0.02.csv");
const L_BLOCK: &str = include_str!("../data/l_block_eem-temperature_h0.025.csv");

/// What is known of one quantity at one step: a row per node, point or reservoir.
pub(super) fn values(states: &str, step: usize, what: &str) -> Vec<Vec<f64>> {
    let rows = states
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let rows = rows.filter(|row| row[0] == step.to_string() && row[1] == what);
    let numbers = |row: Vec<&str>| {
        row[4..]
            .iter()
            .map(|value| value.parse().unwrap())
            .collect()
    };
    rows.map(numbers).collect()
}

/// The largest difference from what is known.
pub(super) fn error(known: &[Vec<f64>], found: impl Fn(usize) -> Vec<f64>) -> f64 {
    let rows = known.iter().enumerate();
    let errors = rows.flat_map(|(at, known)| {
        let found = found(at);
        assert_eq!(found.len(), known.len());
        let errors = known
            .iter()
            .zip(found)
            .map(|(known, found)| (known - found).abs());
        errors.collect::<Vec<_>>()
    });
    errors.fold(0.0, f64::max)
}

/// The body starts as the data do.
fn start(scene: &mut Scene<3>, body: &Body<Hex8, 3>, states: &str) {
    let known = values(states, 0, "q").into_iter().zip(body.mesh().nodes());
    known.for_each(|(known, found)| assert_eq!(known, found));
    for (&node, v) in body.nodes().iter().zip(values(states, 0, "v")) {
        scene.set_velocity(node, [v[0], v[1], v[2]]);
    }
    for (&point, theta) in body.points().iter().zip(values(states, 0, "theta")) {
        scene.set_temperature(point, theta[0]);
    }
}

/// 20 steps to what the data bound: positions, velocities, temperatures and viscous strains.
fn follows(run: &mut Simulation<3>, body: &Body<Hex8, 3>, states: &str) {
    let mut compared = 0;
    for step in 1..=20 {
        run.step().unwrap();
        let known = |what: &str| values(states, step, what);
        let q = error(&known("q"), |at| {
            run.position(body.nodes()[at]).unwrap().as_slice().into()
        });
        let v = error(&known("v"), |at| {
            run.velocity(body.nodes()[at]).unwrap().as_slice().into()
        });
        let theta = error(&known("theta"), |at| {
            vec![run.temperature(body.points()[at]).unwrap()]
        });
        let gamma = error(&known("gamma"), |at| {
            let of = |dashpot| run.viscous_stretch(body.points()[at], dashpot).unwrap();
            vec![of(0), of(1)]
        });
        println!("{step}: {q:e} m, {v:e} m/s, {theta:e} K, {gamma:e}");
        assert!(q <= 1e-13 && v <= 5e-12 && theta <= 5e-12 && gamma <= 1e-13);
        compared += known("q").len();
    }
    // Steps 1, 2, 5, 10 and 20.
    assert_eq!(compared, 5 * body.nodes().len());
}

#[test]
fn a_tumbling_block_follows_its_discrete_solution() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        let mut scene = Scene::<3>::new();
        let mesh = Mesh::block([1; 3], [[0.0, 1.0], [0.0, 2.0], [0.0, 3.0]]).unwrap();
        let material = SaintVenant {
            lame: 2000.0,
            shear: 1000.0,
        };
        let body = scene.solid(material, &mesh, &Bulk::new(10.0));
        start(&mut scene, &body, TUMBLING);
        let mut run = Simulation::new(scene, scheme, 0.05).unwrap();
        follows(&mut run, &body, TUMBLING);
    }
}

#[test]
fn a_viscoelastic_block_follows_its_discrete_solution() {
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::block([1, 1, 2], [[0.0, 1.0], [0.0, 2.0], [0.0, 3.0]]).unwrap();
    let bulk = Bulk::new(10.0).fibre([0.6, 0.8, 0.0]).conductivity(20.0);
    let body = scene.solid(Reinforced::RUBBER, &mesh, &bulk);
    start(&mut scene, &body, VISCOELASTIC);
    let air = scene.reservoir(300.0);
    scene.conduct(body.points()[0], air, 50.0);
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.02).unwrap();
    follows(&mut run, &body, VISCOELASTIC);
    let known = values(VISCOELASTIC, 20, "reservoir_entropy");
    let sigma = error(&known, |_| vec![run.reservoir_heat(air).unwrap() / 300.0]);
    assert!(sigma <= 1e-12, "{sigma:e} J/K");
}

/// The legs of an L, 6 m and 10 m long and 3 m thick, of four cells.
fn l_block() -> Result<Mesh<Hex8, 3>, MeshError> {
    let box_of_6 = Mesh::grid([&[0.0, 3.0, 6.0], &[0.0, 3.0, 6.5, 10.0], &[0.0, 3.0]])?;
    box_of_6.kept(|[x, y, _]| x < 3.0 || y < 3.0)
}

/// Tractions turn it for two seconds; its ends are warm and cold.
#[test]
fn an_l_block_follows_its_discrete_solution() {
    let mut scene = Scene::<3>::new();
    let mesh = l_block().unwrap();
    let body = scene.solid(
        MooneyRivlin::RUBBER,
        &mesh,
        &Bulk::new(10.0).conductivity(10.0),
    );
    start(&mut scene, &body, L_BLOCK);
    for (sign, face) in [
        (1.0, mesh.face(|[_, y, _]| y >= 10.0)),
        (-1.0, mesh.face(|[x, ..]| x >= 6.0)),
    ] {
        scene.traction(&body, &face.unwrap(), move |t: f64| {
            let size = sign * t.min(2.0 - t).max(0.0) / 9.0;
            [256.0 * size, 512.0 * size, 768.0 * size]
        });
    }
    let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.025).unwrap();
    follows(&mut run, &body, L_BLOCK);
}

//! The energy–entropy–momentum schemes of order 4 and 6 with solids, dashpots beside springs, rockets and moved supports.

use eem::Body;
use eem::kinematics::Hex8;
use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::kelvin_voigt::VOIGT;
use crate::support::orders::{slope, step_to};
use crate::support::solids::{Flowing, ThermoelasticSolid};
use crate::support::tangents::assert_tangent;

const SCHEMES: [Scheme; 2] = [Scheme::EemEntropy4, Scheme::EemEntropy6];

/// A warm bar whose left end is shaken, a damper between its right end and a mass, and a rocket on the mass that pushes
/// along the bar.
fn everything(scheme: Scheme, step: f64) -> (Simulation<3>, Vec<Node>) {
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::<Hex8, 3>::block([1, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let bulk = Bulk::new(10.0).conductivity(20.0);
    let body = scene.solid(ThermoelasticSolid::RUBBER, &mesh, &bulk);
    let mut theta = 300.0;
    for &point in body.points() {
        scene.set_temperature(point, theta);
        theta += 2.0;
    }
    for (&node, &[x, y, z]) in body.nodes().iter().zip(mesh.nodes()) {
        if x <= 0.0 {
            scene.fix(node);
            scene.move_anchor(node, move |t| [0.1 * (4.0 * t).sin(), y, z]);
        } else {
            scene.set_velocity(node, [0.4, x * y, -x]);
        }
    }
    let mass = scene.mass(3.0, [2.9, 0.8, 0.3], [0.0, 1.0, 0.0]);
    let ends = [body.node_at([2.0, 1.0, 1.0], 0.1).unwrap(), mass];
    let damper = scene.spring(VOIGT, ends);
    scene.set_temperature(damper, 340.0);
    scene.conduct(damper, body.points()[5], 3.0);
    let tail = body.node_at([0.0, 0.0, 0.0], 0.1).unwrap();
    scene.rocket(mass, [tail, ends[0]], |t| 30.0 * (5.0 * t).cos());
    scene.set_gravity([0.0, 0.0, -9.81]);
    let mut nodes = body.nodes().to_vec();
    nodes.push(mass);
    (Simulation::new(scene, scheme, step).unwrap(), nodes)
}

/// Places and velocities, in units of 1 m and 10 m/s.
fn motion((run, nodes): &(Simulation<3>, Vec<Node>)) -> Vec<f64> {
    let of_node = |&node: &Node| {
        let (place, velocity) = (run.position(node).unwrap(), run.velocity(node).unwrap());
        [place, 0.1 * velocity]
    };
    let vectors = nodes.iter().flat_map(of_node);
    vectors
        .flat_map(|vector| [vector.x, vector.y, vector.z])
        .collect()
}

const END: f64 = 0.06;

fn end_of(scheme: Scheme, steps: u32) -> Vec<f64> {
    let mut scene = everything(scheme, END / f64::from(steps));
    step_to(&mut scene.0, END);
    motion(&scene)
}

#[test]
fn everything_together_shows_the_order() {
    let exact = end_of(Scheme::EemEntropy6, 32);
    let cases = [
        // It shares no equation of a step with the others.
        (Scheme::EemTemperature, [8, 16, 32]),
        (Scheme::EemEntropy4, [4, 8, 16]),
        (Scheme::EemEntropy6, [4, 8, 16]),
    ];
    for (scheme, steps) in cases {
        let errors = steps.map(|steps| {
            let end = end_of(scheme, steps);
            let differences = end.iter().zip(&exact).map(|(a, b)| (a - b).abs());
            differences.fold(0.0, f64::max)
        });
        println!("{scheme}: {errors:?}, slope {}", slope(&errors));
        assert!((slope(&errors) - f64::from(scheme.order())).abs() <= 0.4);
    }
}

#[test]
fn everything_together_closes_the_balance_at_large_steps() {
    for scheme in SCHEMES {
        let (mut run, _) = everything(scheme, 0.1);
        let mut before = run.ledger();
        let first = before.balance;
        for _ in 0..at_length(40, 8) {
            let report = run.step().unwrap();
            assert!(report.least_production >= 0.0 && !report.is_bound_wide);
            let ledger = run.ledger();
            assert!(ledger.entropy >= before.entropy, "{scheme}");
            before = ledger;
        }
        // 2 m³ of 100 J/(K m³) at 300 K.
        let defect = (before.balance - first).abs() / 6e4;
        assert!(defect <= 1e-15, "{scheme}: {defect:e}");
        assert!(before.work.abs() > 1.0, "{}", before.work);
    }
}

/// A block of the material that flows, free in space.
fn tumbling(scheme: Scheme, step: f64) -> (Simulation<3>, Body<Hex8, 3>) {
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::block([1, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let bulk = Bulk::new(10.0).fibre([0.6, 0.8, 0.0]).conductivity(5.0);
    let body = scene.solid(Flowing::RUBBER, &mesh, &bulk);
    for (&node, &[x, y, z]) in body.nodes().iter().zip(mesh.nodes()) {
        scene.set_velocity(node, [2.0 * z + x * y, 0.5 - z, 3.0 * x - y]);
    }
    for &point in body.points() {
        scene.set_temperature(point, 310.0);
    }
    (Simulation::new(scene, scheme, step).unwrap(), body)
}

#[test]
fn a_body_that_flows_keeps_all_laws() {
    for scheme in SCHEMES {
        for step in [0.02, 0.2] {
            let (mut run, _) = tumbling(scheme, step);
            let first = run.ledger();
            let mut entropy = first.entropy;
            for _ in 0..at_length(20, 3) {
                let report = run.step().unwrap();
                assert!(report.least_production >= 0.0);
                assert!(run.ledger().entropy >= entropy);
                entropy = run.ledger().entropy;
            }
            let last = run.ledger();
            let energy = (last.energy - first.energy).abs() / 6e4;
            let momentum = (last.linear_momentum - first.linear_momentum).norm() / 60.0;
            let moment = (last.angular_momentum - first.angular_momentum).norm() / 60.0;
            println!("{scheme} {step}: {energy:e}, {momentum:e}, {moment:e}");
            assert!(energy <= 1e-15 && momentum <= 1e-14 && moment <= 1e-14);
        }
    }
}

#[test]
fn the_tangent_of_a_solid_is_exact() {
    let mut run = tumbling(Scheme::EemEntropy4, 0.1).0;
    let count = run.unknowns();
    let per_set = count / 2;
    let coordinates = 3 * 8;
    let at: Vec<_> = (0..count)
        .map(|index| {
            #[expect(clippy::cast_precision_loss, reason = "some hundred unknowns")]
            let wave = (1.3 * index as f64).sin();
            if index % per_set < coordinates {
                0.05 * wave
            } else {
                310.0 + 2.0 * wave
            }
        })
        .collect();
    // A few columns of both sets, for displacements and temperatures.
    let columns = [
        0,
        7,
        19,
        coordinates + 3,
        per_set + 4,
        per_set + coordinates,
    ];
    let width = |column: usize| {
        if column % per_set < coordinates {
            1e-5
        } else {
            1e-2
        }
    };
    assert_tangent(&mut run, &at, columns, (width, 1e-8));
}

//! Nodes of lumped solids whose motion is prescribed: what their supports do is booked.

use eem::kinematics::{Hex8, Hex20, Shape};
use eem::prelude::*;

use crate::support::solids::ThermoelasticSolid;

/// A bar whose left end is moved along x.
fn moved<H: Shape<3>>(
    motion: fn(f64) -> f64,
    speed: f64,
    (scheme, step): (Scheme, f64),
) -> (Simulation<3>, eem::Body<H, 3>) {
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::<H, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let bulk = Bulk::new(10.0).conductivity(20.0).lumped();
    let body = scene.solid(ThermoelasticSolid::RUBBER, &mesh, &bulk);
    for &point in body.points() {
        scene.set_temperature(point, 300.0);
    }
    for (&node, &[x, y, z]) in body.nodes().iter().zip(mesh.nodes()) {
        if x <= 0.0 {
            scene.fix(node);
            scene.move_anchor(node, move |t| [motion(t), y, z]);
        } else {
            scene.set_velocity(node, [speed, 0.0, 0.0]);
        }
    }
    (Simulation::new(scene, scheme, step).unwrap(), body)
}

fn is_booked<H: Shape<3>>(scheme: Scheme) {
    let shake = |t: f64| 0.1 * (6.0 * t).sin();
    let (mut run, _) = moved::<H>(shake, 0.0, (scheme, 0.05));
    let first = run.ledger();
    let mut entropy = first.entropy;
    for _ in 0..40 {
        run.step().unwrap();
        let ledger = run.ledger();
        // 2 m³ of 100 J/(K m³) at 300 K.
        let error = (ledger.energy - first.energy - ledger.work).abs() / 6e4;
        assert!(error <= 1e-15, "{scheme}: {error:e}");
        assert!(ledger.entropy >= entropy, "{scheme}");
        entropy = ledger.entropy;
    }
    assert!(run.ledger().work > 0.1);
}

#[test]
fn supports_of_lumped_solids_book_their_work() {
    for scheme in [Scheme::EemEntropy, Scheme::EemTemperature] {
        is_booked::<Hex8>(scheme);
    }
    is_booked::<Hex20>(Scheme::EemTemperature);
}

/// A bar that moves with its support stays as it is.
#[test]
fn uniform_motion_of_a_support_does_no_work() {
    let (mut run, body) = moved::<Hex8>(|t| 3.0 * t, 3.0, (Scheme::EemEntropy, 0.125));
    run.run_until(2.0).unwrap();
    assert!(run.ledger().work.abs() <= 1e-10);
    for (&node, &[x, y, z]) in body.nodes().iter().zip(body.mesh().nodes()) {
        let known = [x + 6.0, y, z];
        let found: [f64; 3] = run.position(node).unwrap().into();
        for axis in 0..3 {
            assert!((found[axis] - known[axis]).abs() <= 1e-13);
        }
    }
}

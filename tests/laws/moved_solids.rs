//! Nodes of solids whose motion is prescribed: what their supports do is booked, and what they carry has inertia.

use eem::SolidError;
use eem::kinematics::{Hex8, Hex20, Shape};
use eem::prelude::*;
use eem_testkit::length::at_length;

use crate::support::solids::ThermoelasticSolid;

/// kg/m³
const DENSITY: f64 = 10.0;

/// A bar of two cells, to be held at its left end.
fn bar<H: Shape<3>>((speed, gravity): (f64, f64), is_lumped: bool) -> (Scene<3>, Body<H, 3>) {
    let mut scene = Scene::<3>::new();
    let mesh = Mesh::<H, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]]).unwrap();
    let bulk = Bulk::new(DENSITY).conductivity(20.0);
    let bulk = if is_lumped { bulk.lumped() } else { bulk };
    let body = scene.solid(ThermoelasticSolid::RUBBER, &mesh, &bulk);
    scene.set_gravity([gravity, 0.0, 0.0]);
    for &point in body.points() {
        scene.set_temperature(point, 300.0);
    }
    for node in body.nodes_where(|[x, ..]| x > 0.0) {
        scene.set_velocity(node, [speed, 0.0, 0.0]);
    }
    (scene, body)
}

/// Moves the left end along x.
fn support<H: Shape<3>>(scene: &mut Scene<3>, body: &Body<H, 3>, motion: fn(f64) -> f64) {
    for (&node, &[x, y, z]) in body.nodes().iter().zip(body.mesh().nodes()) {
        if x <= 0.0 {
            scene.fix(node);
            scene.move_anchor(node, move |t| [motion(t), y, z]);
        }
    }
}

/// A bar whose left end is moved along x.
fn moved<H: Shape<3>>(
    motion: fn(f64) -> f64,
    state: (f64, f64),
    is_lumped: bool,
    (scheme, step): (Scheme, f64),
) -> (Simulation<3>, Body<H, 3>) {
    let (mut scene, body) = bar::<H>(state, is_lumped);
    support(&mut scene, &body, motion);
    (Simulation::new(scene, scheme, step).unwrap(), body)
}

const EXACT: [Scheme; 3] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemEntropy4,
];

fn shake(t: f64) -> f64 {
    0.1 * (6.0 * t).sin()
}

fn is_booked<H: Shape<3>>(scheme: Scheme, is_lumped: bool) {
    let (mut run, _) = moved::<H>(shake, (0.0, 3.0), is_lumped, (scheme, 0.05));
    let first = run.ledger();
    let mut entropy = first.entropy;
    for _ in 0..at_length(20, 4) {
        run.step().unwrap();
        let ledger = run.ledger();
        // 2 m³ of 100 J/(K m³) at 300 K.
        let error = (ledger.energy - first.energy - ledger.work).abs() / 6e4;
        assert!(error <= 1e-15, "{scheme}: {error:e}");
        assert!(ledger.entropy >= entropy, "{scheme}");
        entropy = ledger.entropy;
    }
    assert!(run.ledger().work.abs() > 0.1);
}

#[test]
fn supports_of_solids_book_their_work() {
    for (scheme, is_lumped) in EXACT
        .map(|scheme| [(scheme, true), (scheme, false)])
        .as_flattened()
    {
        is_booked::<Hex8>(*scheme, *is_lumped);
    }
    is_booked::<Hex20>(Scheme::EemTemperature, true);
    is_booked::<Hex20>(Scheme::EemEntropy, false);
}

/// A bar that moves with its support stays as it is.
#[test]
fn uniform_motion_of_a_support_does_no_work() {
    for is_lumped in [true, false] {
        let by = (Scheme::EemEntropy, 0.125);
        let (mut run, body) = moved::<Hex8>(|t| 3.0 * t, (3.0, 0.0), is_lumped, by);
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
}

/// A support that takes a bar along from rest gives it `m v` and, with its stress waves, at least `½ m v²`; in free fall
/// with its support the bar is not strained.
#[test]
fn a_support_carries_the_whole_mass() {
    const MASS: f64 = 2.0 * DENSITY;
    let by = (Scheme::EemTemperature, 0.05);
    let (mut run, body) = moved::<Hex8>(|t| -1.5 * t * t, (0.0, -3.0), false, by);
    run.run_until(1.0).unwrap();
    let end = body.node_at([2.0, 1.0, 1.0], 0.0).unwrap();
    assert!((run.position(end).unwrap()[0] - 0.5).abs() <= 1e-12);
    assert!((run.ledger().linear_momentum[0] + 3.0 * MASS).abs() <= 1e-12 * MASS);
    assert!((run.ledger().kinetic_energy - 4.5 * MASS).abs() <= 1e-12 * MASS);
    assert!(run.ledger().work.abs() <= 1e-10);
}

/// Where the support begins to pull, velocities change once, and do not jump to and fro from then on.
#[test]
fn a_kink_in_the_motion_is_forgotten() {
    let pull = |t: f64| 0.2 * (t - 0.5).max(0.0);
    let (mut run, body) = moved::<Hex8>(pull, (0.0, 0.0), false, (Scheme::EemEntropy, 0.01));
    run.run_until(0.5).unwrap();
    let support = body.node_at([0.0, 1.0, 1.0], 0.0).unwrap();
    for _ in 0..20 {
        run.step().unwrap();
        assert!((run.velocity(support).unwrap()[0] - 0.2).abs() <= 1e-12);
    }
}

/// Errors go with h², those of velocities beside the support, too.
#[test]
fn moved_solids_are_of_second_order() {
    let state = |steps: u32| {
        let by = (Scheme::EemEntropy, 0.2 / f64::from(steps));
        let (mut run, body) = moved::<Hex8>(shake, (0.0, 3.0), false, by);
        for _ in 0..steps {
            run.step().unwrap();
        }
        let nodes = body.nodes().iter();
        let place = |&node: &Node| {
            [
                run.position(node).unwrap()[0],
                run.velocity(node).unwrap()[0],
            ]
        };
        nodes.map(place).collect::<Vec<_>>()
    };
    let [coarse, middle, fine] = [30, 60, 120].map(state);
    for quantity in 0..2 {
        let distance = |a: &[[f64; 2]], b: &[[f64; 2]]| -> f64 {
            let pairs = a.iter().zip(b);
            pairs
                .map(|(a, b)| (a[quantity] - b[quantity]).powi(2))
                .sum()
        };
        let order = (distance(&coarse, &middle) / distance(&middle, &fine)).log2() / 2.0;
        assert!((1.8..2.3).contains(&order), "{quantity}: {order}");
    }
}

/// What hangs on nodes that are fixed is the weight of the solid less that which the fixed nodes bear themselves:
/// a quarter of the upper cell of two.
#[test]
fn fixed_nodes_leave_others_their_weight() {
    for is_lumped in [true, false] {
        let by = (Scheme::Midpoint, 1e-5);
        let (mut run, body) = moved::<Hex8>(|_| 0.0, (0.0, 3.0), is_lumped, by);
        let momentum = |run: &Simulation<3>| -> f64 {
            let free = body.nodes_where(|[x, ..]| x > 0.0);
            free.iter()
                .map(|&node| run.momentum(node).unwrap()[0])
                .sum()
        };
        run.step().unwrap();
        let weight = 3.0 * 2.0 * DENSITY * 0.75;
        let found = momentum(&run) / 1e-5;
        assert!((found - weight).abs() <= 1e-5 * weight, "{found} {weight}");
    }
}

/// The velocity with which a support begins does not depend on the first step.
#[test]
fn supports_begin_with_the_velocity_of_their_motion() {
    let shake = |t: f64| 0.01 * (300.0 * t).sin();
    for first in [1e-4, 1e-2, 1.0] {
        let by = (Scheme::EemEntropy, first);
        let (mut run, body) = moved::<Hex8>(shake, (0.0, 0.0), false, by);
        let support = body.node_at([0.0, 1.0, 1.0], 0.0).unwrap();
        let speed = run.velocity(support).unwrap()[0];
        assert!((speed - 3.0).abs() <= 1e-11, "{first}: {speed}");
        run.control_steps(Tolerance::new(1e-3)).unwrap();
        run.run_until(0.01).unwrap();
        let error = run.velocity(support).unwrap()[0] - 3.0 * 3.0_f64.cos();
        assert!(error.abs() <= 1e-2, "{first}: {error:e}");
    }
}

#[test]
fn a_motion_without_a_first_velocity_is_refused() {
    let by = (Scheme::EemEntropy, 0.01);
    let late = |t: f64| if t > 0.0 && t < 0.003 { f64::NAN } else { 0.0 };
    let (mut scene, body) = bar::<Hex8>((0.0, 0.0), false);
    support(&mut scene, &body, late);
    let refused = Simulation::new(scene, by.0, by.1).unwrap_err();
    let is_named = |error: &SceneError| {
        matches!(
            error,
            SceneError::Solid(SolidError::AnchorSpeed { axis: 0, .. })
        )
    };
    assert!(refused.errors().iter().all(is_named), "{refused}");
}

/// Momenta of nodes that are moved follow from the motion, however short the step: they do not decide about it.
#[test]
fn step_control_passes_kinks_and_goes_to_tight_tolerances() {
    let pull = |t: f64| 0.2 * (t - 1.0 / 9.0).max(0.0);
    for &is_lumped in at_length(&[true, false][..], &[false]) {
        let by = (Scheme::EemTemperature, 0.01);
        let (mut run, _) = moved::<Hex8>(pull, (0.0, -1.0), is_lumped, by);
        run.control_steps(Tolerance::new(1e-3)).unwrap();
        run.run_until(0.15).unwrap();
        let (mut run, _) = moved::<Hex8>(shake, (0.0, 3.0), is_lumped, by);
        run.control_steps(Tolerance::new(1e-6)).unwrap();
        run.run_until(0.02).unwrap();
        let steps = run.step_statistics().unwrap().accepted;
        assert!(steps <= 160, "{steps}");
    }
}

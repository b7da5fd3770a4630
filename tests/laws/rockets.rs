//! Rockets: forces along a line that turns with the scene. What they give is found here from positions alone.

use eem::nalgebra::Vector3;
use eem::prelude::*;

use crate::cells::derivative;
use crate::support::ThermoViscoElastic;

/// One stage, and a force that may turn within a step.
const SCHEMES: [Scheme; 8] = [
    Scheme::EemEntropy,
    Scheme::EemTemperature,
    Scheme::EemDamped,
    Scheme::Staggered,
    Scheme::Midpoint,
    Scheme::MidpointTemperature,
    Scheme::Trapezoidal,
    Scheme::TrapezoidalTemperature,
];
/// The same with stages.
const STAGES: [Scheme; 2] = [Scheme::EemEntropy4, Scheme::EemEntropy6];
const STEP: f64 = 0.1;

/// A free triangle of warm springs, pushed at one corner along a side, and at another along another.
struct Triangle {
    run: Simulation<3>,
    corners: [Node; 3],
}

fn thrust(t: f64) -> f64 {
    4.0 * (2.0 * t).cos()
}

fn triangle(scheme: Scheme) -> Triangle {
    let mut scene = Scene::<3>::new();
    let places = [[0.0, 0.0, 0.0], [1.3, 0.1, 0.0], [0.4, 1.1, 0.3]];
    let corners = places.map(|place| scene.mass(1.5, place, [0.2, 0.0, 0.1]));
    for side in [[0, 1], [1, 2], [2, 0]] {
        let ends = side.map(|corner| corners[corner]);
        let spring = scene.spring(ThermoViscoElastic::PENDULUM, ends);
        scene.set_temperature(spring, 320.0);
    }
    scene.rocket(corners[0], [corners[1], corners[2]], thrust);
    scene.rocket(corners[2], [corners[2], corners[0]], |_| 2.5);
    scene.rocket(corners[2], [corners[0], corners[1]], |t| 0.5 * t);
    let run = Simulation::new(scene, scheme, STEP).unwrap();
    Triangle { run, corners }
}

impl Triangle {
    fn places(&self) -> [Vector3<f64>; 3] {
        self.corners
            .map(|corner| self.run.position(corner).unwrap())
    }
}

/// Impulse, angular impulse and work of the rockets in a step.
fn given([q0, q1]: [[Vector3<f64>; 3]; 2], middle: f64) -> (Vector3<f64>, Vector3<f64>, f64) {
    let mean: Vec<_> = q0.iter().zip(&q1).map(|(a, b)| 0.5 * (a + b)).collect();
    let along = |tail: usize, head: usize| (mean[head] - mean[tail]).normalize();
    let pushes = [
        (0, thrust(middle) * along(1, 2)),
        (2, 2.5 * along(2, 0)),
        (2, 0.5 * middle * along(0, 1)),
    ];
    let (mut linear, mut angular, mut work) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for (at, force) in pushes {
        linear += STEP * force;
        angular += STEP * mean[at].cross(&force);
        work += force.dot(&(q1[at] - q0[at]));
    }
    (linear, angular, work)
}

#[test]
fn rockets_give_the_momenta_and_the_energy_that_positions_say() {
    for scheme in SCHEMES {
        let mut triangle = triangle(scheme);
        let is_exact = scheme.name().starts_with("eem") || scheme == Scheme::Staggered;
        let (mut size, mut least) = (0.0_f64, f64::INFINITY);
        for _ in 0..60 {
            let middle = triangle.run.time() + 0.5 * STEP;
            let (before, q0) = (triangle.run.ledger(), triangle.places());
            triangle.run.step().unwrap();
            let (after, q1) = (triangle.run.ledger(), triangle.places());
            let (linear, angular, work) = given([q0, q1], middle);
            size = size.max(after.angular_momentum.norm() + after.linear_momentum.norm());
            let change = after.linear_momentum - before.linear_momentum;
            assert!((change - linear).norm() <= 1e-14 * (1.0 + size), "{scheme}");
            let change = after.angular_momentum - before.angular_momentum;
            let error = (change - angular).norm();
            // The trapezoidal rule does not keep it.
            if !scheme.name().starts_with("trapezoidal") {
                assert!(error <= 1e-13 * (1.0 + size), "{scheme}: {error:e}");
            }
            let booked = after.work - before.work;
            assert!(
                (booked - work).abs() <= 1e-14 * (1.0 + after.kinetic_energy),
                "{scheme}"
            );
            if is_exact {
                let defect = (after.energy - before.energy - work).abs();
                assert!(
                    defect <= 4e-15 * after.energy.abs().max(1e3),
                    "{scheme}: {defect:e}"
                );
                least = least.min(after.entropy - before.entropy);
            }
        }
        assert!(!is_exact || least > 0.0, "{scheme}: {least:e}");
    }
}

#[test]
fn the_tangent_of_rockets_is_exact() {
    for (scheme, width) in [(Scheme::EemEntropy, 0.3), (Scheme::EemEntropy6, 0.1)] {
        let mut run = triangle(scheme).run;
        let count = run.unknowns();
        let of_node = (0..9_u8).map(|i| 0.03 * f64::from(i) - 0.1);
        let at: Vec<_> = of_node.cycle().take(count).collect();
        let exact = run.linearize(&at).unwrap().tangent;
        let size = exact
            .iter()
            .fold(0.0, |size: f64, entry| size.max(entry.abs()));
        for column in 0..count {
            let slopes = derivative(width, |shift| {
                let mut moved = at.clone();
                moved[column] += shift;
                triangle(scheme).run.linearize(&moved).unwrap().residual
            });
            for (row, slope) in slopes.iter().enumerate() {
                let error = (exact[count * row + column] - slope).abs() / size;
                assert!(error <= 1e-12, "{scheme} {row} {column}: {error:e}");
            }
        }
    }
}

/// A force that ends between two steps gives all of its impulse, by every scheme.
#[test]
fn what_ends_between_two_steps_gives_its_whole_impulse() {
    for scheme in SCHEMES {
        let mut scene = Scene::<1>::new();
        let line = [[0.0], [1.0]].map(|place| scene.anchor(place));
        let masses = [(); 2].map(|()| scene.mass(1.0, [0.0], [0.0]));
        let fires = |t: f64| if t < 1.0 { 3.0 } else { 0.0 };
        scene.rocket(masses[0], line, fires);
        scene.force(masses[1], move |t| [2.0 * fires(t)]);
        let mut run = Simulation::new(scene, scheme, 0.125).unwrap();
        run.run_until(2.0).unwrap();
        assert!((run.momentum(masses[0]).unwrap().x - 3.0).abs() <= 1e-14);
        assert!((run.momentum(masses[1]).unwrap().x - 6.0).abs() <= 1e-14);
    }
}

#[test]
fn rockets_that_make_no_sense_are_refused() {
    let mut scene = Scene::<2>::new();
    let [a, b] = [[0.0, 0.0], [1.0, 0.0]].map(|place| scene.mass(1.0, place, [0.0, 0.0]));
    let wall = scene.anchor([0.0, 1.0]);
    scene.rocket(wall, [a, b], |_| 1.0);
    scene.rocket(a, [b, b], |_| 1.0);
    scene.rocket(Scene::<2>::new().anchor([0.0, 0.0]), [a, b], |_| 1.0);
    let post = scene.anchor([0.0, 1.0]);
    scene.rocket(a, [wall, post], |_| 1.0);
    let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
    let texts: Vec<_> = refused.errors().iter().map(ToString::to_string).collect();
    assert_eq!(
        texts,
        [
            "node 2 cannot be given a rocket: it is an anchor",
            "the rocket at node 0 pushes along a line from node 1 to itself, which has no direction",
            "node 0 belongs to another scene",
            "the rocket at node 0 pushes along a line from node 2 to node 3, which are anchors in the same place, so that it has no direction; put one of them elsewhere",
        ]
    );

    let pushed = |line: [f64; 2], thrust: f64, scheme: Scheme| {
        let mut scene = Scene::<2>::new();
        let ends = line.map(|x| scene.mass(1.0, [x, 0.0], [0.0, 0.0]));
        let pushed = scene.mass(1.0, [0.0, 1.0], [0.0, 0.0]);
        scene.rocket(pushed, ends, move |t| if t > 0.1 { thrust } else { 0.0 });
        Simulation::new(scene, scheme, 0.1)
    };
    for scheme in Scheme::ALL {
        match pushed([0.0, 1.0], 1.0, scheme) {
            Ok(_) => assert!(SCHEMES.contains(&scheme) || STAGES.contains(&scheme)),
            Err(refused) => {
                let text = refused.errors()[0].to_string();
                assert!(
                    text.contains("does not step the rocket at node 2"),
                    "{text}"
                );
            }
        }
    }
    let mut auto = pushed([0.0, 1.0], 1.0, Scheme::Auto).unwrap();
    auto.run_until(0.5).unwrap();
    assert_ne!(auto.scheme_in_use(), Scheme::EemExplicit);

    let mut run = pushed([0.0, 1.0], f64::NAN, Scheme::EemEntropy).unwrap();
    run.step().unwrap();
    let failure = run.step().unwrap_err().failure.to_string();
    assert_eq!(
        failure,
        "the thrust of the rocket at node 2 is NaN N at t = 0.15000000000000002 s, it must be finite"
    );
    let mut run = pushed([1.0, 1.0], 1.0, Scheme::EemEntropy).unwrap();
    let failure = run.step().unwrap_err().failure.to_string();
    assert_eq!(
        failure,
        "the rocket at node 2 has no direction: node 0 and node 1 are 0 m apart in the mean of the step, a smaller step may help"
    );
    assert!(run.time() == 0.0 && run.ledger().work == 0.0);
}

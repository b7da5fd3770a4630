//! Rockets, ovens, densities, and anchors that move beside solids, against differences of runs.

use eem::kinematics::Quad4;
use eem::prelude::*;
use eem::{Gradient, History, Objective};

use super::{FORMS, TWO, VOIGT, assert_tangent};
use crate::support::solids::Viscous;

/// Checks derivatives by numbered inputs against differences of fourth order in changes of these sizes.
pub(super) fn check<const D: usize, const N: usize>(
    what: &str,
    found: [f64; N],
    (inputs, sizes): ([f64; N], [f64; N]),
    value: impl Fn([f64; N]) -> f64,
) {
    for at in 0..N {
        let value = |steps: f64| {
            let mut inputs = inputs;
            inputs[at] += steps * sizes[at];
            value(inputs)
        };
        let differences = 8.0 * (value(1.0) - value(-1.0)) - (value(2.0) - value(-2.0));
        let (expected, got) = (differences / (12.0 * sizes[at]), found[at]);
        let bound = 1e-7 * expected.abs() + 2e-12 / sizes[at];
        assert!(
            (got - expected).abs() <= bound,
            "{what}, input {at}: {got} {expected}"
        );
    }
}

/// `Σ dJ/df(t) ∂f/∂α(t)`.
fn contract(series: &[(f64, f64)], by: impl Fn(f64) -> f64) -> f64 {
    series
        .iter()
        .map(|&(t, derivative)| derivative * by(t))
        .sum()
}

/// A bob on a spring, driven by two rockets, of which one turns with an anchor, in an oven.
struct Flight {
    run: Simulation<2>,
    nodes: [Node; 3],
    springs: [Element; 2],
    oven: Reservoir,
    path: HeatPath,
}

/// With two thrusts, the amplitude of the temperature, a conductance, and the anchor.
fn flight([first, second, heating, conductance, x, y]: [f64; 6], scheme: Scheme) -> Flight {
    let mut scene = Scene::<2>::new();
    let anchor = scene.anchor([x, y]);
    let bob = scene.mass(1.0, [1.2, 0.0], [0.3, 1.0]);
    let tail = scene.mass(0.5, [1.9, -0.4], [0.0, -0.5]);
    let springs = [
        scene.spring(VOIGT, [anchor, bob]),
        scene.spring(TWO, [bob, tail]),
    ];
    scene.set_temperature(springs[0], 320.0);
    scene.set_temperature(springs[1], 310.0);
    scene.conduct(springs[0], springs[1], 0.5);
    scene.rocket(tail, [anchor, bob], move |t| {
        first * (1.0 + (3.0 * t).sin())
    });
    scene.rocket(bob, [bob, tail], |_| 0.7);
    scene.rocket(bob, [tail, bob], move |t| second * t);
    let oven = scene.oven(move |t| 300.0 + heating * (4.0 * t).sin());
    let path = scene.conduct(springs[1], oven, conductance);
    let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
    run.keep_history(History::default());
    run.run_until(0.5).unwrap();
    let nodes = [anchor, bob, tail];
    Flight {
        run,
        nodes,
        springs,
        oven,
        path,
    }
}

#[test]
fn thrusts_and_ovens_have_derivatives() {
    let inputs = [1.5, 2.0, 40.0, 0.4, 0.1, -0.1];
    let sizes = [1e-2, 1e-2, 1e-1, 1e-3, 1e-3, 1e-3];
    for scheme in FORMS {
        let gradient = |inputs| {
            let mut flight = flight(inputs, scheme);
            let [_, bob, tail] = flight.nodes;
            let objective = Objective::at_end(Quantity::Position(tail))
                + Objective::at_end(Quantity::Velocity(bob)).component(1)
                + Objective::integral(Quantity::TotalEnergy).times(0.01)
                + Objective::at_end(Quantity::Temperature(flight.springs[1])).times(0.1);
            let gradient = flight.run.gradient(&objective).unwrap();
            assert_tangent("flight", &mut flight.run, &gradient, &objective);
            (flight, gradient)
        };
        let (flight, found) = gradient(inputs);
        let [anchor, bob, tail] = flight.nodes;
        let place = found.by_position(anchor).unwrap();
        let oven = found.by_oven(flight.oven).unwrap();
        let all = contract(oven, |_| 1.0);
        let shifted = found.by_reservoir_temperature(flight.oven).unwrap();
        assert!((all - shifted).abs() <= 1e-13 * all.abs());
        let by = [
            contract(found.by_thrust(tail, 0).unwrap(), |t| 1.0 + (3.0 * t).sin()),
            contract(found.by_thrust(bob, 1).unwrap(), |t| t),
            contract(oven, |t| (4.0 * t).sin()),
            found.by_conductance(flight.path).unwrap(),
            place[0],
            place[1],
        ];
        check::<2, 6>(scheme.name(), by, (inputs, sizes), |inputs| {
            gradient(inputs).1.value()
        });
        let none = found.by_thrust(tail, 1).unwrap_err().to_string();
        assert!(none.contains("has no rocket 1"), "{none}");
    }
}

/// Across the line of a rocket `m Δv = h F y_m/|r_m|`, so that `y¹ = y⁰ + 2c y⁰/(2m/h − c)` with `c = hF/2|r_m|`.
#[test]
fn rockets_turn_with_their_lines() {
    let (step, thrust) = (0.1, 50.0);
    for scheme in FORMS {
        let mut scene = Scene::<2>::new();
        let anchor = scene.anchor([0.0, 0.0]);
        let bob = scene.mass(1.0, [1.0, 0.0], [0.0, 0.0]);
        scene.rocket(bob, [anchor, bob], move |_| thrust);
        let mut run = Simulation::new(scene, scheme, step).unwrap();
        run.keep_history(History::default());
        run.step().unwrap();
        let place = Objective::at_end(Quantity::Position(bob)).component(1);
        let gradient = run.gradient(&place).unwrap();
        let middle = 0.5 * (1.0 + run.position(bob).unwrap()[0]);
        let c = step * thrust / (2.0 * middle);
        let moved = 2.0 * c / (2.0 / step - c);
        let by = [bob, anchor].map(|node| gradient.by_position(node).unwrap()[1]);
        assert!((by[0] - (1.0 + moved)).abs() <= 1e-14, "{scheme}: {by:?}");
        assert!((by[1] + moved).abs() <= 1e-14, "{scheme}: {by:?}");
    }
}

/// A block on a shaking wall, pushed at a corner.
struct Shaken {
    body: Body<Quad4, 2>,
    wall: Vec<Node>,
    corner: Node,
    gradient: Gradient<2>,
}

/// With the density, two amplitudes of the wall, a thrust, and gravity.
fn shaken(
    [density, shake, slide, thrust, gravity]: [f64; 5],
    (scheme, is_lumped): (Scheme, bool),
) -> Shaken {
    let mut scene = Scene::<2>::new();
    let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]]).unwrap();
    let mut bulk = Bulk::new(density).conductivity(5.0);
    if is_lumped {
        bulk = bulk.lumped();
    }
    let body = scene.solid(Viscous::RUBBER, &mesh, &bulk);
    scene.set_temperatures(&body, 305.0);
    let wall = body.nodes_where(|[x, _]| x == 0.0);
    for &node in &wall {
        scene.fix(node);
        let y = body.mesh().nodes()[body.nodes().iter().position(|own| *own == node).unwrap()][1];
        scene.move_anchor(node, move |t| {
            [slide * (4.0 * t).sin(), y + shake * (1.0 - (5.0 * t).cos())]
        });
    }
    let corner = body.node_at([2.0, 1.0], 1e-9).unwrap();
    let other = body.node_at([2.0, 0.0], 1e-9).unwrap();
    scene.rocket(corner, [other, corner], move |t| thrust * (1.0 + t));
    scene.rocket(corner, [wall[0], corner], |_| 3.0);
    scene.set_gravity([0.0, gravity]);
    let mut run = Simulation::new(scene, scheme, 0.02).unwrap();
    run.keep_history(History::default());
    run.run_until(0.2).unwrap();
    let objective = Objective::at_end(Quantity::Position(corner))
        + Objective::at_end(Quantity::Velocity(other)).component(1)
        + Objective::integral(Quantity::KineticEnergy).times(0.1)
        + Objective::at_end(Quantity::TotalEnergy).times(0.01);
    let gradient = run.gradient(&objective).unwrap();
    assert_tangent("shaken", &mut run, &gradient, &objective);
    Shaken {
        body,
        wall,
        corner,
        gradient,
    }
}

#[test]
fn densities_and_shaken_solids_have_derivatives() {
    let inputs = [10.0, 0.05, 0.03, 5.0, -9.81];
    let sizes = [1e-2, 1e-3, 1e-3, 1e-2, 1e-2];
    for scheme in FORMS {
        for is_lumped in [false, true] {
            let Shaken {
                body,
                wall,
                corner,
                gradient,
            } = shaken(inputs, (scheme, is_lumped));
            let motion = |axis: usize, by: &dyn Fn(f64) -> f64, speed: f64| {
                let sums = wall.iter().map(|&node| {
                    let series = gradient.by_motion(node).unwrap();
                    let total: f64 = series.iter().map(|(_, all)| all[axis]).sum();
                    let shifted = gradient.by_position(node).unwrap()[axis];
                    assert!(
                        (total - shifted).abs() <= 1e-10 * (1.0 + shifted.abs()),
                        "{total} {shifted}"
                    );
                    let sum: f64 = series.iter().map(|(t, all)| all[axis] * by(*t)).sum();
                    sum + speed * gradient.by_velocity(node).unwrap()[axis]
                });
                sums.sum::<f64>()
            };
            let found = [
                gradient.by_density(&body).unwrap(),
                motion(1, &|t| 1.0 - (5.0 * t).cos(), 0.0),
                motion(0, &|t| (4.0 * t).sin(), 4.0),
                contract(gradient.by_thrust(corner, 0).unwrap(), |t| 1.0 + t),
                gradient.by_gravity()[1],
            ];
            let what = format!("{scheme}, lumped {is_lumped}");
            check::<2, 5>(&what, found, (inputs, sizes), |inputs| {
                shaken(inputs, (scheme, is_lumped)).gradient.value()
            });
        }
    }
}

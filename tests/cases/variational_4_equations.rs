//! A step of the variational integrator of fourth order solves its equations, as written down and solved
//! here once more, with tangents from differences.

mod network;
use eem::prelude::*;

use crate::support::{LogarithmicStiffness, ThermoViscoElastic};
use network::{Law, Network, Spring, law};

/// Newton's method with a tangent from central differences stalls at the rounding of the residuals
/// times the condition of the tangent, some 10² here; and so does that of the scheme.
const TOLERANCE: f64 = 1e-13;

fn assert_close(found: f64, expected: f64, size: f64, what: &str) {
    let error = (found - expected).abs() / size;
    println!("{what}: {found} and {expected}, off by {error:e}");
    assert!(error <= TOLERANCE, "{what}");
}

/// Relaxation in two times.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, fast: Viscous, slow: Viscous, theta: Temperature| {
    let extension = lambda - natural_length;
    0.5 * (stiffness - softening * (theta - 300.0)) * extension.powi(2)
        + 20.0 * (extension - fast).powi(2)
        + 8.0 * (extension - slow).powi(2) * (1.0 + 0.1 * fast)
        + capacity * (theta - 300.0 - theta * ln(theta / 300.0))
})]
#[viscosity(fast = 2.0 * exp(30.0 / theta), slow = 30.0)]
struct TwoDashpots {
    stiffness: f64,
    softening: f64,
    capacity: f64,
    natural_length: f64,
}

const TWO_DASHPOTS: TwoDashpots = TwoDashpots {
    stiffness: 60.0,
    softening: 0.1,
    capacity: 2.0,
    natural_length: 1.1,
};

/// The moved support, a force of time and a thermostat.
fn support(t: f64) -> [f64; 2] {
    [0.1 * (2.0 * t).sin(), 0.05 * t]
}
fn push(t: f64) -> [f64; 2] {
    [3.0 * (5.0 * t).cos(), 2.0]
}
fn thermostat(t: f64) -> f64 {
    310.0 + 20.0 * (7.0 * t).sin()
}

const H: f64 = 0.06;
const POSITIONS: [[f64; 2]; 3] = [[0.0, 0.0], [1.3, 0.1], [1.2, -1.0]];
const MOMENTA: [[f64; 2]; 3] = [[0.0, 0.0], [0.4, 1.0], [-0.5, 0.2]];
const MASSES: [Option<f64>; 3] = [None, Some(1.0), Some(0.5)];
const GRAVITY: f64 = -9.81;
const SLOW_STRETCH: f64 = 0.05;
const AIR: f64 = 295.0;
/// W/K: the first spring to the air, the first to the second, the second to the third.
const CONDUCTANCES: [f64; 3] = [5.0, 4.0, 7.0];
const SOFT: LogarithmicStiffness = LogarithmicStiffness {
    stiffness: 80.0,
    softening: 0.2,
    coupling: 0.5,
    capacity: 3.0,
    natural_length: 1.0,
    theta_ref: 300.0,
};

fn temperatures() -> [f64; 3] {
    [330.0, 320.0, thermostat(0.0)]
}

/// The scene with its masses, springs and reservoir.
fn scene() -> (Simulation<2>, [Node; 2], [Element; 3], Reservoir) {
    let mut scene = Scene::<2>::new();
    let anchor = scene.anchor(POSITIONS[0]);
    let nodes = [1, 2].map(|i| {
        let node = scene.mass(MASSES[i].unwrap(), POSITIONS[i], [0.0; 2]);
        scene.set_momentum(node, MOMENTA[i]);
        node
    });
    let springs = [
        scene.spring(ThermoViscoElastic::PENDULUM, [anchor, nodes[0]]),
        scene.spring(TWO_DASHPOTS, [nodes[0], nodes[1]]),
        scene.spring(SOFT, [anchor, nodes[1]]),
    ];
    for (spring, theta) in springs.into_iter().zip(temperatures()) {
        scene.set_temperature(spring, theta);
    }
    scene.set_viscous_stretch(springs[1], 0, SLOW_STRETCH);
    let air = scene.reservoir(AIR);
    scene.conduct(springs[0], air, CONDUCTANCES[0]);
    scene.conduct(springs[0], springs[1], CONDUCTANCES[1]);
    scene.conduct(springs[1], springs[2], CONDUCTANCES[2]);
    scene.set_gravity([0.0, GRAVITY]);
    scene.force(nodes[1], push);
    scene.move_anchor(anchor, support);
    scene.prescribe_temperature(springs[2], thermostat);
    let run = Simulation::new(scene, Scheme::Variational4, H).unwrap();
    (run, nodes, springs, air)
}

/// The same as a network, with the entropies that the scene has found.
fn network(entropies: [f64; 3]) -> Network {
    let times = [0.0, 0.5 * H, H];
    let loads = |node: usize| {
        let weight = GRAVITY * MASSES[node].unwrap_or(0.0);
        times.map(|t| match node {
            2 => [push(t)[0], push(t)[1] + weight],
            _ => [0.0, weight],
        })
    };
    let spring = |i: usize, law: Law, ends, gamma: &[f64], contacts: &[(usize, f64)]| Spring {
        law,
        ends,
        gamma: gamma.to_vec(),
        entropy: entropies[i],
        contacts: contacts.to_vec(),
        reservoirs: Vec::new(),
        prescribed: (i == 2).then_some(times.map(thermostat)),
    };
    let [to_air, upper, lower] = CONDUCTANCES;
    let viscous = law(ThermoViscoElastic::PENDULUM);
    let mut springs = vec![
        spring(0, viscous, [0, 1], &[0.0], &[(1, upper)]),
        spring(
            1,
            law(TWO_DASHPOTS),
            [1, 2],
            &[SLOW_STRETCH, 0.0],
            &[(0, upper), (2, lower)],
        ),
        spring(2, law(SOFT), [0, 2], &[], &[(1, lower)]),
    ];
    springs[0].reservoirs.push((AIR, to_air));
    Network {
        h: H,
        masses: MASSES.to_vec(),
        positions: POSITIONS.to_vec(),
        momenta: MOMENTA.to_vec(),
        loads: [0, 1, 2].map(loads).to_vec(),
        supports: vec![times.map(support); 3],
        springs,
    }
}

#[test]
fn a_step_of_a_network_solves_the_equations() {
    let (mut run, nodes, springs, air) = scene();
    // Both coordinates of two masses and the temperatures of three springs, at two stages.
    assert_eq!(run.unknowns(), 2 * (2 * 2 + 3));
    let entropies = springs.map(|spring| run.entropy(spring).unwrap());
    let (ends, outcome) = network(entropies).solve(&temperatures());
    let report = run.step().unwrap();
    println!("{} iterations", report.iterations);

    for (i, &node) in nodes.iter().enumerate() {
        let (q, p) = (run.position(node).unwrap(), run.momentum(node).unwrap());
        for axis in 0..2 {
            assert_close(q[axis], ends[1 + i][axis], 1.0, "position");
            assert_close(p[axis], outcome.momenta[i][axis], 1.0, "momentum");
        }
    }
    for ((&spring, found), dashpots) in springs.iter().zip(&outcome.springs).zip([1, 2, 0]) {
        let (gamma, rest) = found.split_at(dashpots);
        for (k, &gamma) in gamma.iter().enumerate() {
            assert_close(run.viscous_stretch(spring, k).unwrap(), gamma, 1.0, "γ");
        }
        assert_close(run.entropy(spring).unwrap(), rest[0], rest[0].abs(), "s");
    }
    let sigma = run.reservoir_entropy(air).unwrap();
    assert_close(sigma, outcome.springs[0][2], 1.0, "σ");
    let theta = run.temperature(springs[2]).unwrap();
    assert_close(theta, thermostat(H), 300.0, "θ");
}

/// Hooke's law.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - natural_length).powi(2))]
struct Hooke {
    stiffness: f64,
    natural_length: f64,
}

/// Lobatto IIIA and IIIB with three stages (Hairer, Lubich & Wanner, tables II.1.1 and II.1.3).
const IIIA: [[f64; 3]; 3] = [
    [0.0, 0.0, 0.0],
    [5.0 / 24.0, 1.0 / 3.0, -1.0 / 24.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
];
const IIIB: [[f64; 3]; 3] = [
    [1.0 / 6.0, -1.0 / 6.0, 0.0],
    [1.0 / 6.0, 1.0 / 3.0, 0.0],
    [1.0 / 6.0, 5.0 / 6.0, 0.0],
];

/// One step of the pair for a mass on a spring that is held at the origin, by fixed-point iteration.
fn lobatto(q0: [f64; 2], p0: [f64; 2], m: f64, spring: Hooke, h: f64) -> ([f64; 2], [f64; 2]) {
    let force = |q: [f64; 2]| {
        let length = q[0].hypot(q[1]);
        let tension = spring.stiffness * (length - spring.natural_length);
        q.map(|component| -tension * component / length)
    };
    let mut forces = [force(q0); 3];
    let sum = |row: [f64; 3], of: &[[f64; 2]; 3], axis: usize| -> f64 {
        row.iter().zip(of).map(|(a, k)| a * k[axis]).sum()
    };
    for _ in 0..100 {
        let p = IIIB.map(|row| [0, 1].map(|axis| p0[axis] + h * sum(row, &forces, axis)));
        let v = p.map(|p| p.map(|component| component / m));
        forces = IIIA.map(|row| force([0, 1].map(|axis| q0[axis] + h * sum(row, &v, axis))));
    }
    let p = IIIB.map(|row| [0, 1].map(|axis| p0[axis] + h * sum(row, &forces, axis)));
    let v = p.map(|p| p.map(|component| component / m));
    let last = IIIA[2];
    (
        [0, 1].map(|axis| q0[axis] + h * sum(last, &v, axis)),
        [0, 1].map(|axis| p0[axis] + h * sum(last, &forces, axis)),
    )
}

#[test]
fn an_elastic_step_is_one_of_lobatto_iiia_iiib() {
    // Roundings of a state of size 1 and of forces of size k h = 2.5, and Newton's error below them.
    const ROUNDING: f64 = 8.0 * f64::EPSILON;
    let (m, h) = (2.0, 0.05);
    let spring = Hooke {
        stiffness: 50.0,
        natural_length: 1.0,
    };
    let mut scene = Scene::<2>::new();
    let pivot = scene.anchor([0.0, 0.0]);
    let bob = scene.mass(m, [1.2, 0.3], [0.5, -1.0]);
    scene.spring(spring, [pivot, bob]);
    let mut run = Simulation::new(scene, Scheme::Variational4, h).unwrap();
    for _ in 0..50 {
        let (q, p) = (run.position(bob).unwrap(), run.momentum(bob).unwrap());
        run.step().unwrap();
        let (next, momentum) = lobatto(q.into(), p.into(), m, spring, h);
        let (q, p) = (run.position(bob).unwrap(), run.momentum(bob).unwrap());
        for axis in 0..2 {
            assert!((q[axis] - next[axis]).abs() <= ROUNDING * q.norm());
            assert!((p[axis] - momentum[axis]).abs() <= 4.0 * ROUNDING * p.norm().max(1.0));
        }
    }
}

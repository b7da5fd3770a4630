//! A plate of quadrilaterals follows the solution of the discrete equations.

use eem::prelude::*;

use crate::support::solids::{SECTION, ThermoelasticSolid};

const STATES: [(Scheme, &str); 2] = [
    (
        Scheme::EemEntropy,
        include_str!("../data/plate_eem-entropy_h0.02.csv"),
    ),
    (
        Scheme::EemTemperature,
        include_str!("../data/plate_eem-temperature_h0.02.csv"),
    ),
];
const LINKS: &str = include_str!("../data/plate_links.csv");
const MESH: &str = include_str!("../data/plate_mesh.csv");
const LEDGER: &str = include_str!("../data/plate_ledger.csv");

/// What is known of one quantity at one step: a row per node, point or reservoir.
fn values(states: &str, step: usize, what: &str) -> Vec<Vec<f64>> {
    let rows = states
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let rows = rows.filter(|row| row[0] == step.to_string() && row[1] == what);
    rows.map(|row| {
        row[4..]
            .iter()
            .map(|value| value.parse().unwrap())
            .collect()
    })
    .collect()
}

struct Plate {
    states: &'static str,
    run: Simulation<2>,
    nodes: Vec<Node>,
    points: Vec<Element>,
    air: Reservoir,
}

fn plate((scheme, states): (Scheme, &'static str)) -> Plate {
    let mut scene = Scene::<2>::new();
    let pair = |row: &Vec<f64>| [row[0], row[1]];
    let (positions, velocities) = (values(states, 0, "q"), values(states, 0, "v"));
    let both = positions.iter().zip(&velocities);
    let nodes: Vec<_> = both.map(|(q, v)| scene.node(pair(q), pair(v))).collect();
    let mut points = Vec::new();
    for line in MESH.lines().skip(1) {
        let corners: Vec<usize> = line
            .split(',')
            .skip(2)
            .map(|at| at.parse().unwrap())
            .collect();
        let corners = [0, 1, 2, 3].map(|corner| nodes[corners[corner]]);
        points.extend(scene.quadrilateral(ThermoelasticSolid::RUBBER, corners, SECTION));
    }
    for (&point, theta) in points.iter().zip(values(states, 0, "theta")) {
        scene.set_temperature(point, theta[0]);
    }
    for line in LINKS.lines().skip(1) {
        let [first, second, conductance] = line.split(',').collect::<Vec<_>>()[..] else {
            panic!("three fields: {line}");
        };
        let [first, second] = [first, second].map(|at| points[at.parse::<usize>().unwrap()]);
        scene.conduct(first, second, conductance.parse().unwrap());
    }
    let air = scene.reservoir(300.0);
    scene.conduct(points[0], air, 50.0);
    scene.conduct(points[23], air, 20.0);
    Plate {
        states,
        run: Simulation::new(scene, scheme, 0.02).unwrap(),
        nodes,
        points,
        air,
    }
}

impl Plate {
    /// The largest difference from what is known at a step, of q, v, θ and the entropy of the reservoir.
    fn errors(&self, step: usize) -> [f64; 4] {
        let largest = |known: Vec<Vec<f64>>, found: &dyn Fn(usize) -> Vec<f64>| {
            let rows = known.iter().enumerate();
            let errors = rows.flat_map(|(at, known)| {
                let pairs = known.clone().into_iter().zip(found(at));
                pairs.map(|(known, found)| (known - found).abs())
            });
            errors.fold(0.0, f64::max)
        };
        let run = &self.run;
        [
            largest(values(self.states, step, "q"), &|at| {
                run.position(self.nodes[at]).unwrap().as_slice().to_vec()
            }),
            largest(values(self.states, step, "v"), &|at| {
                run.velocity(self.nodes[at]).unwrap().as_slice().to_vec()
            }),
            largest(values(self.states, step, "theta"), &|at| {
                vec![run.temperature(self.points[at]).unwrap()]
            }),
            largest(values(self.states, step, "reservoir_entropy"), &|_| {
                vec![run.reservoir_heat(self.air).unwrap() / 300.0]
            }),
        ]
    }
}

#[test]
fn a_plate_follows_its_discrete_solution() {
    for (scheme, states) in STATES {
        let mut plate = plate((scheme, states));
        for step in 0..=20 {
            if step > 0 {
                plate.run.step().unwrap();
            }
            let [q, v, theta, sigma] = plate.errors(step);
            println!("{scheme} {step}: {q:e} m, {v:e} m/s, {theta:e} K, {sigma:e} J/K");
            assert!(q <= 1e-13 && v <= 5e-12 && theta <= 5e-12 && sigma <= 1e-12);
        }
        // Something is known of the last step.
        assert!(values(states, 20, "q").len() == 12 && values(states, 20, "theta").len() == 24);
    }
}

#[test]
fn the_ledger_of_the_plate_is_that_of_the_solution() {
    let mut plate = plate(STATES[0]);
    for line in LEDGER.lines().skip(1) {
        let known: Vec<f64> = line
            .split(',')
            .map(|field| field.parse().unwrap())
            .collect();
        let ledger = plate.run.ledger();
        let momentum = [ledger.linear_momentum[0], ledger.linear_momentum[1]];
        // Momenta are sums of some hundred kg m/s and kg m²/s.
        let pairs = [
            (ledger.energy, known[1], known[1]),
            (ledger.kinetic_energy, known[2], known[1]),
            (ledger.entropy, known[6], known[6]),
            (momentum[0], known[7], 1000.0),
            (momentum[1], known[8], 1000.0),
            (ledger.angular_momentum[2], known[9], 1000.0),
        ];
        for (found, known, size) in pairs {
            assert!((found - known).abs() <= 1e-14 * size, "{line}: {found}");
        }
        plate.run.step().unwrap();
    }
}

/// The forms part in θ by 6e-6 K in the first step: they are two schemes.
#[test]
fn the_forms_are_two_schemes() {
    let mut plate = plate((Scheme::EemTemperature, STATES[0].1));
    plate.run.step().unwrap();
    let [_, _, theta, _] = plate.errors(1);
    assert!((5e-6..7e-6).contains(&theta), "{theta:e}");
}

//! The published cases, to be stepped under the eyes of the judge.

use super::models::{LogarithmicStiffness, ThermoViscoElastic};
use super::world::World;

/// A case in the plane or in space.
pub(crate) enum Case {
    Plane(World<2>),
    Space(World<3>),
}

/// A case by its name, and its published step in s.
pub(crate) type Published = (&'static str, f64, fn() -> Case);

pub(crate) const ALL: [Published; 4] = [
    ("single pendulum", 0.2, || {
        Case::Plane(single_pendulum([1.0, 1.0]))
    }),
    ("double pendulum, Romero", 0.3, || {
        Case::Space(double_pendulum(&ROMERO, [1.0, 1.0]))
    }),
    ("double pendulum, Krüger", 0.1, || {
        Case::Space(double_pendulum(&KRUEGER, [1.0, 1.0]))
    }),
    ("double pendulum, log", 0.1, || {
        Case::Space(double_pendulum(&LOGARITHMIC, [1.0, 1.0]))
    }),
];

/// García Orden & Romero (2012), §4.1, in units of which one metre and one kelvin have so many.
pub(crate) fn single_pendulum([metre, kelvin]: [f64; 2]) -> World<2> {
    let joule = metre * metre;
    let of = ThermoViscoElastic::PENDULUM;
    let model = ThermoViscoElastic {
        k0: of.k0 * joule,
        k1: of.k1 * joule / kelvin,
        ratio: of.ratio,
        coupling: of.coupling * joule / kelvin,
        capacity: of.capacity * joule / kelvin,
        mu0: of.mu0,
        mu1: of.mu1 / kelvin,
        eta0: of.eta0,
        a: of.a * kelvin,
        length: of.length * metre,
        theta_ref: of.theta_ref * kelvin,
    };
    let mut world = World::new();
    let pivot = world.anchor([0.0; 2]);
    let bob = world.mass(1.0, [3.0 * metre, 0.0], [0.0, metre]);
    let spring = world.warm(model, [pivot, bob], 380.0 * kelvin);
    let air = world.reservoir(300.0 * kelvin);
    world.cool(spring, air, 10.0 * joule / kelvin);
    world
}

/// A double pendulum of Conde Martín, Betsch & García Orden (2016).
pub(crate) struct Data {
    stiffness: [f64; 2],
    softening: [f64; 2],
    masses: [f64; 2],
    coupling: f64,
    capacity: [f64; 2],
    conductance: f64,
    positions: [[f64; 3]; 2],
    momenta: [[f64; 3]; 2],
    temperatures: [f64; 2],
}

pub(crate) const ROMERO: Data = Data {
    stiffness: [0.1, 1.0],
    softening: [0.0, 0.0],
    masses: [1.0, 2.0],
    coupling: 0.2,
    capacity: [5.0, 5.0],
    conductance: 300.0,
    positions: [[1.0, 0.0, 0.0], [2.2, 0.0, 0.0]],
    momenta: [[0.0, 2.0, 0.0], [1.0, 0.0, 0.0]],
    temperatures: [380.0, 310.0],
};

pub(crate) const KRUEGER: Data = Data {
    stiffness: [100.0, 100.0],
    capacity: [1000.0, 1000.0],
    conductance: 10.0,
    momenta: [[0.0, 1.0, 0.0], [0.0, 4.4, 0.0]],
    ..ROMERO
};

pub(crate) const LOGARITHMIC: Data = Data {
    stiffness: [5000.0, 10_000.0],
    softening: [50.0, 60.0],
    masses: [10.0, 20.0],
    coupling: 20.0,
    capacity: [5000.0, 2000.0],
    conductance: 300.0,
    positions: [[3.0, 0.0, 0.5], [3.0, 1.0, 1.0]],
    momenta: [[0.0, 10.0, 0.0], [0.0, 0.0, -20.0]],
    temperatures: [380.0, 298.0],
};

/// The same, in units of which one metre and one kelvin have so many.
pub(crate) fn double_pendulum(data: &Data, [metre, kelvin]: [f64; 2]) -> World<3> {
    let joule = metre * metre;
    let mut world = World::new();
    let pivot = world.anchor([0.0; 3]);
    let [first, second] = [0, 1].map(|i| {
        let velocity = data.momenta[i].map(|p| p / data.masses[i] * metre);
        world.mass(
            data.masses[i],
            data.positions[i].map(|q| q * metre),
            velocity,
        )
    });
    let ends = [[pivot, first], [first, second]];
    let springs = [0, 1].map(|i| {
        let model = LogarithmicStiffness {
            stiffness: data.stiffness[i] * joule,
            softening: data.softening[i] * joule / kelvin,
            coupling: data.coupling * joule / kelvin,
            capacity: data.capacity[i] * joule / kelvin,
            length: [2.0, 1.0][i] * metre,
            theta_ref: 300.0 * kelvin,
        };
        world.warm(model, ends[i], data.temperatures[i] * kelvin)
    });
    world.conduct(springs, data.conductance * joule / kelvin);
    world
}

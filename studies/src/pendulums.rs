//! The published pendulums. Equations and sources are in the examples `single_pendulum` and `double_pendulum`.

use crate::build::Build;
use crate::models::{Creeping, Thermoelastic};

/// The spring of the single pendulum.
pub const SPRING: Creeping = Creeping {
    natural_length: 1.0,
    theta_ref: 300.0,
    k0: 100.0,
    k1: 0.5,
    thermal_coupling: 4.0,
    capacity: 1.0,
    viscous_coupling: 0.1,
    mu0: 5.0,
    mu1: 0.1,
    eta0: 100.0,
    a: 10.0,
};

/// García Orden & Romero (2012), §4.1.
pub fn single() -> Build<2> {
    let mut build = Build::new();
    let pivot = build.anchor([0.0, 0.0]);
    let bob = build.mass(1.0, [3.0, 0.0], [0.0, 1.0]);
    let spring = build.warm(SPRING, [pivot, bob], 380.0);
    let air = build.reservoir(300.0);
    build.conduct(spring, air, 10.0);
    build
}

/// A double pendulum of Conde Martín, Betsch & García Orden (2016).
#[derive(Clone, Debug)]
pub struct Double {
    springs: [Thermoelastic; 2],
    masses: [f64; 2],
    positions: [[f64; 3]; 2],
    velocities: [[f64; 3]; 2],
    temperatures: [f64; 2],
    conductance: f64,
}

const SOFT: Thermoelastic = Thermoelastic {
    stiffness: 0.1,
    softening: 0.0,
    coupling: 0.2,
    capacity: 5.0,
    length: 2.0,
    theta_ref: 300.0,
};

const STIFF: Thermoelastic = Thermoelastic {
    stiffness: 100.0,
    capacity: 1000.0,
    ..SOFT
};

/// The first spring of the case `log`.
pub const LOGARITHMIC: Thermoelastic = Thermoelastic {
    stiffness: 5000.0,
    softening: 50.0,
    coupling: 20.0,
    capacity: 5000.0,
    ..SOFT
};

impl Double {
    /// The case named after Romero (2009).
    pub const ROMERO: Self = Self {
        springs: [
            SOFT,
            Thermoelastic {
                stiffness: 1.0,
                length: 1.0,
                ..SOFT
            },
        ],
        masses: [1.0, 2.0],
        positions: [[1.0, 0.0, 0.0], [2.2, 0.0, 0.0]],
        velocities: [[0.0, 2.0, 0.0], [0.5, 0.0, 0.0]],
        temperatures: [380.0, 310.0],
        conductance: 300.0,
    };

    /// That of Krüger, Groß & Betsch (2011).
    pub const KRUEGER: Self = Self {
        springs: [
            STIFF,
            Thermoelastic {
                length: 1.0,
                ..STIFF
            },
        ],
        velocities: [[0.0, 1.0, 0.0], [0.0, 2.2, 0.0]],
        conductance: 10.0,
        ..Self::ROMERO
    };

    /// That with a stiffness logarithmic in the temperature.
    pub const LOG: Self = Self {
        springs: [
            LOGARITHMIC,
            Thermoelastic {
                stiffness: 10_000.0,
                softening: 60.0,
                capacity: 2000.0,
                length: 1.0,
                ..LOGARITHMIC
            },
        ],
        masses: [10.0, 20.0],
        positions: [[3.0, 0.0, 0.5], [3.0, 1.0, 1.0]],
        velocities: [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
        temperatures: [380.0, 298.0],
        conductance: 300.0,
    };

    /// Its scene.
    pub fn build(&self) -> Build<3> {
        let mut build = Build::new();
        let pivot = build.anchor([0.0; 3]);
        let masses =
            [0, 1].map(|i| build.mass(self.masses[i], self.positions[i], self.velocities[i]));
        let ends = [[pivot, masses[0]], masses];
        let springs =
            [0, 1].map(|i| build.warm(self.springs[i].clone(), ends[i], self.temperatures[i]));
        build.conduct(springs[0], springs[1], self.conductance);
        build
    }
}

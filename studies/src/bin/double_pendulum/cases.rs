//! The three published double pendulums: data, scene and reference.
//!
//! Equations, symbols and sources are in the example `double_pendulum`.

#![allow(
    dead_code,
    reason = "examples that share this file use some of the cases"
)]

use std::error::Error;

use eem::prelude::*;

use eem_studies::record::Record;
use eem_studies::simulate::{self, Watched};
use eem_studies::time_grid::TimeGrid;

/// Stiffness logarithmic in the temperature, or constant when `softening` is zero.
#[derive(Clone, Copy, Debug, FreeEnergy)]
#[free_energy(|lambda: Stretch, theta: Temperature| {
    let strain = ln(lambda / natural_length);
    let current_stiffness = stiffness - softening * theta_ref * ln(theta / theta_ref);
    0.5 * current_stiffness * strain.powi(2)
        - coupling * (theta - theta_ref) * strain
        + capacity * (theta - theta_ref - theta * ln(theta / theta_ref))
})]
pub(crate) struct ThermoelasticSpring {
    #[unit("J")]
    pub(crate) stiffness: f64,
    #[unit("J/K")]
    pub(crate) softening: f64,
    #[unit("J/K")]
    pub(crate) coupling: f64,
    #[unit("J/K")]
    pub(crate) capacity: f64,
    #[unit("m")]
    pub(crate) natural_length: f64,
    #[unit("K")]
    pub(crate) theta_ref: f64,
}

/// One of the published cases; SI units, first what belongs to the anchor's side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    pub(crate) springs: [ThermoelasticSpring; 2],
    pub(crate) temperatures: [f64; 2],
    pub(crate) conductance: f64,
    pub(crate) masses: [f64; 2],
    pub(crate) positions: [[f64; 3]; 2],
    pub(crate) momenta: [[f64; 3]; 2],
    pub(crate) end: f64,
    pub(crate) step: f64,
    /// The reference takes steps of at most this size (s).
    pub(crate) reference_step: f64,
    /// Until when (s) it is meaningful to compare positions: later the motion is chaotic, and
    /// paths part from the slightest difference.
    pub(crate) comparable: f64,
    /// Until when (s) lengths are drawn, to tell one oscillation from the next.
    pub(crate) drawn: f64,
    /// What rounding may do to the energy, relative to itself.
    pub(crate) energy_defect: f64,
}

/// What rounding may do to E over the run. The state is kept to twice the working precision and
/// energy is closed in every step, so that its defect does not grow with their number; evaluating E
/// from the state costs a dozen roundings of ε/2.
const ENERGY_DEFECT: f64 = 4e-15;

/// The same over 500 s: what closing leaves of a step's defect adds up like a random walk.
const ENERGY_DEFECT_OF_LONG_RUNS: f64 = 2e-14;

/// The reference's step is at most this share of the schemes' step.
const REFERENCE_SHARE: f64 = 0.05;

/// The reference is recorded at least this often (s), to draw a smooth curve.
const REFERENCE_SAMPLING: f64 = 0.05;

const SOFT_SPRING: ThermoelasticSpring = ThermoelasticSpring {
    stiffness: 0.1,
    softening: 0.0,
    coupling: 0.2,
    capacity: 5.0,
    natural_length: 2.0,
    theta_ref: 300.0,
};

const STIFF_SPRING: ThermoelasticSpring = ThermoelasticSpring {
    stiffness: 100.0,
    capacity: 1000.0,
    ..SOFT_SPRING
};

const LOGARITHMIC_SPRING: ThermoelasticSpring = ThermoelasticSpring {
    stiffness: 5000.0,
    softening: 50.0,
    coupling: 20.0,
    capacity: 5000.0,
    ..SOFT_SPRING
};

pub(crate) const ROMERO: Case = Case {
    springs: [
        SOFT_SPRING,
        ThermoelasticSpring {
            stiffness: 1.0,
            natural_length: 1.0,
            ..SOFT_SPRING
        },
    ],
    temperatures: [380.0, 310.0],
    conductance: 300.0,
    masses: [1.0, 2.0],
    positions: [[1.0, 0.0, 0.0], [2.2, 0.0, 0.0]],
    momenta: [[0.0, 2.0, 0.0], [1.0, 0.0, 0.0]],
    end: 25.0,
    step: 0.3,
    reference_step: 2e-3,
    comparable: f64::INFINITY,
    drawn: f64::INFINITY,
    energy_defect: ENERGY_DEFECT,
};

pub(crate) const KRUEGER: Case = Case {
    springs: [
        STIFF_SPRING,
        ThermoelasticSpring {
            natural_length: 1.0,
            ..STIFF_SPRING
        },
    ],
    conductance: 10.0,
    momenta: [[0.0, 1.0, 0.0], [0.0, 4.4, 0.0]],
    end: 500.0,
    step: 0.1,
    reference_step: 2.5e-3,
    comparable: 2.0,
    drawn: 10.0,
    energy_defect: ENERGY_DEFECT_OF_LONG_RUNS,
    ..ROMERO
};

pub(crate) const LOG: Case = Case {
    springs: [
        LOGARITHMIC_SPRING,
        ThermoelasticSpring {
            stiffness: 10_000.0,
            softening: 60.0,
            capacity: 2000.0,
            natural_length: 1.0,
            ..LOGARITHMIC_SPRING
        },
    ],
    temperatures: [380.0, 298.0],
    conductance: 300.0,
    masses: [10.0, 20.0],
    positions: [[3.0, 0.0, 0.5], [3.0, 1.0, 1.0]],
    momenta: [[0.0, 10.0, 0.0], [0.0, 0.0, -20.0]],
    end: 25.0,
    step: 0.1,
    reference_step: 1e-3,
    comparable: 10.0,
    drawn: 12.5,
    energy_defect: ENERGY_DEFECT,
};

impl Case {
    /// The pendulum ready to run, and what to record of it.
    pub(crate) fn pendulum(
        &self,
        scheme: Scheme,
        step: f64,
    ) -> Result<(Simulation<3>, Watched), SceneError> {
        let (scene, watched) = self.scene();
        Ok((Simulation::new(scene, scheme, step)?, watched))
    }

    /// The pendulum at t = 0, and what to record of it.
    pub(crate) fn scene(&self) -> (Scene<3>, Watched) {
        let mut scene = Scene::<3>::new();
        let anchor = scene.anchor([0.0; 3]);
        let masses = [0, 1].map(|i| {
            let mass = scene.mass(self.masses[i], self.positions[i], [0.0; 3]);
            scene.set_momentum(mass, self.momenta[i]);
            mass
        });
        let ends = [[anchor, masses[0]], masses];
        let springs = [0, 1].map(|i| {
            let spring = scene.spring(self.springs[i], ends[i]);
            scene.set_temperature(spring, self.temperatures[i]);
            spring
        });
        scene.conduct(springs[0], springs[1], self.conductance);
        let watched = Watched {
            masses: masses.to_vec(),
            elements: springs.to_vec(),
            has_reservoirs: false,
        };
        (scene, watched)
    }

    /// The same motion in steps so small that the scheme no longer matters while positions are
    /// comparable.
    pub(crate) fn reference(&self, grid: TimeGrid) -> Result<Record, Box<dyn Error>> {
        let longest = self.reference_step.min(REFERENCE_SHARE * grid.step);
        let grid = grid.refined(longest, REFERENCE_SAMPLING);
        let (mut simulation, watched) = self.pendulum(Scheme::EemTemperature, grid.step)?;
        simulate::record("reference", &mut simulation, &watched, grid)
    }
}

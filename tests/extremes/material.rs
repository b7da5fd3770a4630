//! Springs of all kinds with random data.

use eem::prelude::*;

use super::model::Body;
use super::models::{
    Hencky, Hooke, LogarithmicStiffness, Maxwell, Morse, ThermoViscoElastic, Thermoelastic,
    TwoDashpots, TwoLinearDashpots,
};
use super::random::Random;
use super::world::World;

/// One of the models.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Material {
    Hooke(Hooke),
    Hencky(Hencky),
    Morse(Morse),
    Maxwell(Maxwell),
    Thermoelastic(Thermoelastic),
    Logarithmic(LogarithmicStiffness),
    Published(ThermoViscoElastic),
    TwoDashpots(TwoDashpots),
    TwoLinearDashpots(TwoLinearDashpots),
}

/// Calls an expression with the model, whichever it is.
macro_rules! with {
    ($material:expr, $model:ident => $body:expr) => {
        match $material {
            Material::Hooke($model) => $body,
            Material::Hencky($model) => $body,
            Material::Morse($model) => $body,
            Material::Maxwell($model) => $body,
            Material::Thermoelastic($model) => $body,
            Material::Logarithmic($model) => $body,
            Material::Published($model) => $body,
            Material::TwoDashpots($model) => $body,
            Material::TwoLinearDashpots($model) => $body,
        }
    };
}

/// What the models have in common.
#[derive(Clone, Copy, Debug)]
struct Data {
    /// N/m.
    stiffness: f64,
    branch: f64,
    /// N m, for logarithmic strains.
    modulus: f64,
    eta: f64,
    capacity: f64,
    /// N/K.
    coupling: f64,
    length: f64,
    theta_ref: f64,
}

impl Data {
    /// Stiffness about 100 N/m, or of many decades; η of about a second of relaxation, or anything.
    fn at_random(random: &mut Random, wild: bool, length: f64, theta: f64) -> Self {
        let decades = |random: &mut Random, ordinary: [f64; 2], all: [f64; 2]| {
            let [low, high] = if wild { all } else { ordinary };
            random.decades(low, high)
        };
        let stiffness = decades(random, [30.0, 300.0], [1e-2, 1e8]);
        // Heat of the size of the elastic energy changes θ by a percent.
        let capacity =
            stiffness * length * length / theta * decades(random, [1.0, 1.0], [1e-3, 1e3]);
        let theta_ref = theta * random.uniform(0.9, 1.1);
        Self {
            stiffness,
            branch: stiffness * random.decades(0.1, 1.0),
            modulus: stiffness * length * length,
            eta: decades(random, [0.1, 1e3], [1e-9, 1e9]),
            capacity,
            // Thermal strain of a percent at 10 % more than the reference.
            coupling: 0.1 * stiffness * length / theta_ref * random.uniform(-1.0, 1.0),
            length,
            theta_ref,
        }
    }
}

impl Material {
    /// Any of the models.
    pub(crate) fn at_random(random: &mut Random, wild: bool, length: f64, theta: f64) -> Self {
        let data = Data::at_random(random, wild, length, theta);
        match random.below(9) {
            kind @ 0..=3 => Self::without_temperature(kind, data),
            kind => Self::with_temperature(kind, data),
        }
    }

    fn without_temperature(kind: usize, data: Data) -> Self {
        let Data {
            stiffness,
            branch,
            modulus,
            eta,
            length,
            ..
        } = data;
        match kind {
            0 => Self::Hooke(Hooke { stiffness, length }),
            1 => Self::Hencky(Hencky {
                stiffness: modulus,
                length,
            }),
            2 => {
                let steepness = 1.0 / length;
                Self::Morse(Morse {
                    depth: 0.5 * modulus,
                    steepness,
                    length,
                })
            }
            _ => Self::Maxwell(Maxwell {
                stiffness,
                branch,
                length,
                eta,
            }),
        }
    }

    fn with_temperature(kind: usize, data: Data) -> Self {
        let Data {
            stiffness,
            branch,
            modulus,
            eta,
            capacity,
            coupling,
            length,
            theta_ref,
        } = data;
        match kind {
            4 => Self::Thermoelastic(Thermoelastic {
                stiffness,
                length,
                coupling,
                capacity,
                theta_ref,
            }),
            5 => Self::Logarithmic(LogarithmicStiffness {
                stiffness: modulus,
                softening: 0.2 * modulus / theta_ref,
                coupling: coupling * length,
                capacity,
                length,
                theta_ref,
            }),
            6 => Self::Published(ThermoViscoElastic {
                k0: modulus,
                k1: 0.1 * modulus / theta_ref,
                ratio: 0.1,
                coupling: coupling * length,
                capacity,
                mu0: 0.05 * stiffness,
                mu1: 0.005 * stiffness / theta_ref,
                eta0: eta,
                a: 0.1 * theta_ref,
                length,
                theta_ref,
            }),
            7 => Self::TwoDashpots(TwoDashpots {
                stiffness: modulus,
                first: branch * length * length,
                second: 0.7 * branch * length * length,
                coupling: coupling * length,
                capacity,
                length,
                theta_ref,
                // Their stretches are strains.
                eta1: eta * length * length,
                eta2: 3.0 * eta * length * length,
                a: theta_ref,
                n: 1.5,
            }),
            _ => Self::TwoLinearDashpots(TwoLinearDashpots {
                stiffness,
                first: branch,
                second: 0.7 * branch,
                coupling,
                capacity,
                length,
                theta_ref,
                eta1: eta,
                eta2: 0.1 * eta,
            }),
        }
    }

    fn body(&self) -> &dyn Body {
        with!(self, model => model)
    }

    /// c, J/K, if there is a temperature.
    pub(crate) fn capacity(&self) -> Option<f64> {
        match self {
            Self::Hooke(_) | Self::Hencky(_) | Self::Morse(_) | Self::Maxwell(_) => None,
            Self::Thermoelastic(model) => Some(model.capacity),
            Self::Logarithmic(model) => Some(model.capacity),
            Self::Published(model) => Some(model.capacity),
            Self::TwoDashpots(model) => Some(model.capacity),
            Self::TwoLinearDashpots(model) => Some(model.capacity),
        }
    }

    /// About the stiffness in the natural state, N/m.
    pub(crate) fn stiffness(&self) -> f64 {
        match self {
            Self::Hooke(model) => model.stiffness,
            Self::Hencky(model) => model.stiffness / model.length.powi(2),
            Self::Morse(model) => 2.0 * model.depth * model.steepness.powi(2),
            Self::Maxwell(model) => model.stiffness,
            Self::Thermoelastic(model) => model.stiffness,
            Self::Logarithmic(model) => model.stiffness / model.length.powi(2),
            Self::Published(model) => model.k0 / model.length.powi(2),
            Self::TwoDashpots(model) => model.stiffness / model.length.powi(2),
            Self::TwoLinearDashpots(model) => model.stiffness,
        }
    }

    /// f and the stiffness at constant γ = 0 and entropy.
    pub(crate) fn slope(&self, lambda: f64, theta: f64) -> (f64, f64) {
        let body = self.body();
        let mut x = vec![lambda];
        x.resize(1 + body.dashpots(), 0.0);
        if body.thermal() {
            x.push(theta);
        }
        let (gradient, hessian) = (body.gradient(&x), body.hessian(&x));
        let last = x.len() - 1;
        let adiabatic = if body.thermal() {
            hessian[0][last].powi(2) / hessian[last][last].abs()
        } else {
            0.0
        };
        (gradient[0], hessian[0][0].abs() + adiabatic)
    }

    pub(crate) fn put<const D: usize>(
        &self,
        world: &mut World<D>,
        ends: [Node; 2],
        theta: f64,
    ) -> Element {
        let thermal = self.body().thermal();
        with!(*self, model => if thermal {
            world.warm(model, ends, theta)
        } else {
            world.spring(model, ends)
        })
    }
}

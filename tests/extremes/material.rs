//! Springs of all kinds with random data.

use std::sync::Arc;

use eem::prelude::*;

use super::model::{Body, Model};
use super::models::{
    Hencky, Hooke, LogarithmicStiffness, Maxwell, Morse, ThermoViscoElastic, Thermoelastic,
    TwoDashpots, TwoLinearDashpots,
};
use super::random::Random;
use super::world::World;

/// What can be put into a scene, whichever model it is.
pub(crate) trait Law<const D: usize>: Body {
    fn put(&self, world: &mut World<D>, ends: [Node; 2], theta: f64) -> Element;
}

impl<M: Model, const D: usize> Law<D> for M {
    fn put(&self, world: &mut World<D>, ends: [Node; 2], theta: f64) -> Element {
        if M::THERMAL {
            world.warm(self.clone(), ends, theta)
        } else {
            world.spring(self.clone(), ends)
        }
    }
}

/// A model with its data.
#[derive(Clone)]
pub(crate) struct Material<const D: usize> {
    law: Arc<dyn Law<D>>,
    /// In the natural state, about, N/m.
    pub(crate) stiffness: f64,
    /// c of the natural length, J/K, if there is a temperature.
    pub(crate) capacity: Option<f64>,
}

/// Between what the data lie.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ranges {
    /// N/m.
    pub(crate) stiffness: [f64; 2],
    /// N s/m.
    pub(crate) eta: [f64; 2],
    /// In units of `k l²/θ`: heat of the size of the elastic energy then changes θ by as much as it is large.
    pub(crate) capacity: [f64; 2],
}

impl Ranges {
    /// Stiffness about 100 N/m, η of about a second of relaxation.
    pub(crate) const ORDINARY: Self = Self {
        stiffness: [30.0, 300.0],
        eta: [0.1, 1e3],
        capacity: [1.0, 1.0],
    };
    /// Many decades.
    pub(crate) const WILD: Self = Self {
        stiffness: [1e-2, 1e8],
        eta: [1e-9, 1e9],
        capacity: [1e-3, 1e3],
    };
}

/// What the models have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Data {
    /// N/m.
    pub(crate) stiffness: f64,
    pub(crate) branch: f64,
    /// N m, for logarithmic strains.
    pub(crate) modulus: f64,
    pub(crate) eta: f64,
    pub(crate) capacity: f64,
    /// N/K.
    pub(crate) coupling: f64,
    pub(crate) length: f64,
    pub(crate) theta_ref: f64,
}

impl Data {
    pub(crate) fn at_random(random: &mut Random, ranges: &Ranges, length: f64, theta: f64) -> Self {
        let mut within = |[low, high]: [f64; 2]| random.decades(low, high);
        let stiffness = within(ranges.stiffness);
        let capacity = stiffness * length * length / theta * within(ranges.capacity);
        let theta_ref = theta * random.uniform(0.9, 1.1);
        Self {
            stiffness,
            branch: stiffness * random.decades(0.1, 1.0),
            modulus: stiffness * length * length,
            eta: random.decades(ranges.eta[0], ranges.eta[1]),
            capacity,
            // Thermal strain of a percent at 10 % more than the reference.
            coupling: 0.1 * stiffness * length / theta_ref * random.uniform(-1.0, 1.0),
            length,
            theta_ref,
        }
    }
}

/// Makes a model from data.
type Kind<const D: usize> = fn(&Data) -> Arc<dyn Law<D>>;

impl<const D: usize> Material<D> {
    /// Any of the models.
    pub(crate) fn at_random(random: &mut Random, ranges: &Ranges, length: f64, theta: f64) -> Self {
        let data = Data::at_random(random, ranges, length, theta);
        let kinds: [Kind<D>; 9] = [
            hooke,
            hencky,
            morse,
            maxwell,
            thermoelastic,
            logarithmic,
            published,
            two_dashpots,
            two_linear_dashpots,
        ];
        Self::new(kinds[random.below(kinds.len())](&data), &data, theta)
    }

    /// A law about its natural length.
    pub(crate) fn new(law: Arc<dyn Law<D>>, data: &Data, theta: f64) -> Self {
        let mut material = Self {
            law,
            stiffness: data.stiffness,
            capacity: None,
        };
        let is_thermal = material.law.thermal();
        material.capacity = is_thermal.then(|| material.capacity_at(data.length, theta));
        material
    }

    /// c, J/K.
    pub(crate) fn capacity_at(&self, lambda: f64, theta: f64) -> f64 {
        let x = at(&*self.law, lambda, theta);
        self.law.caloric(&x).heat_capacity
    }

    /// f and the stiffness at constant γ = 0 and entropy.
    pub(crate) fn slope(&self, lambda: f64, theta: f64) -> (f64, f64) {
        let x = at(&*self.law, lambda, theta);
        let (gradient, hessian) = (self.law.gradient(&x), self.law.hessian(&x));
        let last = x.len() - 1;
        let adiabatic = if self.law.thermal() {
            hessian[0][last].powi(2) / hessian[last][last].abs()
        } else {
            0.0
        };
        (gradient[0], hessian[0][0].abs() + adiabatic)
    }

    /// The fastest relaxation of its dashpots, 1/s.
    pub(crate) fn relaxation(&self, lambda: f64, theta: f64) -> f64 {
        let hessian = self.law.hessian(&at(&*self.law, lambda, theta));
        let viscosities = self.law.viscosities(theta);
        let rates = (1..).zip(&viscosities).map(|(k, eta)| hessian[k][k] / eta);
        rates.fold(0.0, f64::max)
    }

    pub(crate) fn put(&self, world: &mut World<D>, ends: [Node; 2], theta: f64) -> Element {
        self.law.put(world, ends, theta)
    }
}

/// (λ, 0 …, θ).
fn at(body: &(impl Body + ?Sized), lambda: f64, theta: f64) -> Vec<f64> {
    let mut x = vec![lambda];
    x.resize(1 + body.dashpots(), 0.0);
    x.extend(body.thermal().then_some(theta));
    x
}

pub(crate) fn hooke<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    let &Data {
        stiffness, length, ..
    } = data;
    Arc::new(Hooke { stiffness, length })
}

pub(crate) fn hencky<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(Hencky {
        stiffness: data.modulus,
        length: data.length,
    })
}

pub(crate) fn morse<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(Morse {
        depth: 0.5 * data.modulus,
        steepness: 1.0 / data.length,
        length: data.length,
    })
}

pub(crate) fn maxwell<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(Maxwell {
        stiffness: data.stiffness,
        branch: data.branch,
        length: data.length,
        eta: data.eta,
    })
}

pub(crate) fn thermoelastic<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(Thermoelastic {
        stiffness: data.stiffness,
        length: data.length,
        coupling: data.coupling,
        capacity: data.capacity,
        theta_ref: data.theta_ref,
    })
}

pub(crate) fn logarithmic<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(LogarithmicStiffness {
        stiffness: data.modulus,
        softening: 0.2 * data.modulus / data.theta_ref,
        coupling: data.coupling * data.length,
        capacity: data.capacity,
        length: data.length,
        theta_ref: data.theta_ref,
    })
}

pub(crate) fn published<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    let &Data {
        stiffness,
        modulus,
        theta_ref,
        ..
    } = data;
    Arc::new(ThermoViscoElastic {
        k0: modulus,
        k1: 0.1 * modulus / theta_ref,
        ratio: 0.1,
        coupling: data.coupling * data.length,
        capacity: data.capacity,
        mu0: 0.05 * stiffness,
        mu1: 0.005 * stiffness / theta_ref,
        eta0: data.eta,
        a: 0.1 * theta_ref,
        length: data.length,
        theta_ref,
    })
}

pub(crate) fn two_dashpots<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    let square = data.length * data.length;
    Arc::new(TwoDashpots {
        stiffness: data.modulus,
        first: data.branch * square,
        second: 0.7 * data.branch * square,
        coupling: data.coupling * data.length,
        capacity: data.capacity,
        length: data.length,
        theta_ref: data.theta_ref,
        // Their stretches are strains.
        eta1: data.eta * square,
        eta2: 3.0 * data.eta * square,
        a: data.theta_ref,
        n: 1.5,
    })
}

pub(crate) fn two_linear_dashpots<const D: usize>(data: &Data) -> Arc<dyn Law<D>> {
    Arc::new(TwoLinearDashpots {
        stiffness: data.stiffness,
        first: data.branch,
        second: 0.7 * data.branch,
        coupling: data.coupling,
        capacity: data.capacity,
        length: data.length,
        theta_ref: data.theta_ref,
        eta1: data.eta,
        eta2: 0.1 * data.eta,
    })
}

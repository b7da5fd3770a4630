//! The thermo-visco-elastic pendulum in the plane, in contact with a reservoir.
//!
//! Unknowns: q (2), p (2), γ, s or θ, and the entropy σ of the reservoir, whose heat `θ_r σ` is part of the
//! energy.

use super::{State, System, Variables, Warm, norm};
use crate::inversion::temperature;
use crate::single_pendulum::{CONDUCTANCE, CreepingSpring, SPRING};
use crate::springs::{Number, Spring, Stretched};

/// kg.
const MASS: f64 = 1.0;

/// K.
const RESERVOIR: f64 = 300.0;

/// The pendulum and where it starts.
#[derive(Clone, Debug)]
pub(crate) struct Single {
    spring: CreepingSpring,
    conductance: f64,
    variables: Variables,
    start: State,
}

/// What the unknowns say of the spring.
struct Taut<R: Number> {
    lambda: R,
    gamma: R,
    theta: R,
    at: <CreepingSpring as Spring>::At<R>,
}

impl Single {
    /// With the state at t = 0.
    pub(crate) const fn new(variables: Variables, start: State) -> Self {
        Self {
            spring: SPRING,
            conductance: CONDUCTANCE,
            variables,
            start,
        }
    }

    fn taut<R: Number>(&self, y: &[R; 7], warm: &mut f64) -> Taut<R> {
        let &[x, z, _, _, gamma, heat, _] = y;
        let lambda = (x * x + z * z).sqrt();
        let at = self.spring.at(lambda, gamma);
        let theta = match self.variables {
            Variables::Entropy => temperature(at.caloric(), heat, warm),
            Variables::Temperature => heat,
        };
        Taut {
            lambda,
            gamma,
            theta,
            at,
        }
    }

    fn settled(&self, y: &[f64; 7]) -> Taut<f64> {
        self.taut(y, &mut self.warm()[0])
    }
}

impl System<7> for Single {
    fn start(&self) -> [f64; 7] {
        let State {
            positions: q,
            momenta: p,
            temperatures,
            viscous,
        } = &self.start;
        let (gamma, theta) = (viscous[0], temperatures[0]);
        let heat = match self.variables {
            Variables::Entropy => self.spring.at(norm(q), gamma).entropy(theta),
            Variables::Temperature => theta,
        };
        [q[0], q[1], p[0], p[1], gamma, heat, 0.0]
    }

    fn warm(&self) -> Warm {
        [self.start.temperatures[0]; 2]
    }

    fn rates<R: Number>(&self, y: &[R; 7], warm: &mut Warm) -> [R; 7] {
        let &[x, z, px, pz, ..] = y;
        let Taut {
            lambda, theta, at, ..
        } = self.taut(y, &mut warm[0]);
        let (vx, vz) = (px / MASS, pz / MASS);
        let pull = -at.force(theta) / lambda;
        let dashpot = at.dashpot_force(theta);
        let creep = dashpot / at.viscosity(theta);
        let lost = (theta - RESERVOIR) * self.conductance;
        let heat = dashpot * creep - lost;
        let thermal = match self.variables {
            Variables::Entropy => heat / theta,
            Variables::Temperature => {
                let stretching = (x * vx + z * vz) / lambda;
                let [by_lambda, by_gamma] = at.slopes(theta);
                let latent = theta * (by_lambda * stretching + by_gamma * creep);
                (heat - latent) / at.capacity(theta)
            }
        };
        [vx, vz, pull * x, pull * z, creep, thermal, lost / RESERVOIR]
    }

    fn energy(&self, y: &[f64; 7]) -> f64 {
        let &[_, _, px, pz, _, _, sigma] = y;
        let Taut { theta, at, .. } = self.settled(y);
        (px * px + pz * pz) / (2.0 * MASS) + at.energy(theta) + RESERVOIR * sigma
    }

    #[cfg(test)]
    fn entropy(&self, y: &[f64; 7]) -> f64 {
        let Taut { theta, at, .. } = self.settled(y);
        at.entropy(theta) + y[6]
    }

    #[cfg(test)]
    fn forces(&self, y: &[f64; 7]) -> Vec<f64> {
        let Taut { theta, at, .. } = self.settled(y);
        vec![at.force(theta)]
    }

    fn state(&self, y: &[f64; 7]) -> State {
        let Taut { gamma, theta, .. } = self.settled(y);
        State {
            positions: y[..2].to_vec(),
            momenta: y[2..4].to_vec(),
            temperatures: vec![theta],
            viscous: vec![gamma],
        }
    }

    fn sizes(&self, momentum: f64) -> [f64; 7] {
        let length = norm(&self.start.positions);
        let capacity = Spring::capacity(&self.spring);
        let heat = match self.variables {
            Variables::Entropy => capacity,
            Variables::Temperature => self.start.temperatures[0],
        };
        [length, length, momentum, momentum, length, heat, capacity]
    }
}

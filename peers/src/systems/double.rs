//! The thermoelastic double pendulum in space, its springs in thermal contact.
//!
//! Unknowns: q₁, q₂, p₁, p₂ (3 each), s₁, s₂ or θ₁, θ₂.

use std::array;

use super::{State, System, Variables, Warm, norm};
use crate::double_pendulum::{Case, ThermoelasticSpring};
use crate::inversion::temperature;
use crate::springs::{Number, Spring, Stretched};

/// The pendulum and where it starts.
#[derive(Clone, Debug)]
pub(crate) struct Double {
    case: Case,
    variables: Variables,
    start: State,
}

/// A spring as the unknowns have it.
struct Taut<R: Number> {
    /// From its end at the anchor's side to the other, m.
    arm: [R; 3],
    lambda: R,
    theta: R,
    at: <ThermoelasticSpring as Spring>::At<R>,
}

impl Double {
    /// With the state at t = 0.
    pub(crate) const fn new(case: &Case, variables: Variables, start: State) -> Self {
        Self {
            case: *case,
            variables,
            start,
        }
    }

    fn taut<R: Number>(&self, y: &[R; 14], warm: &mut Warm) -> [Taut<R>; 2] {
        let arms: [[R; 3]; 2] = [[y[0], y[1], y[2]], [y[3] - y[0], y[4] - y[1], y[5] - y[2]]];
        array::from_fn(|i| {
            let arm = arms[i];
            let lambda = dot(arm, arm).sqrt();
            let at = self.case.springs[i].at(lambda, R::from(0.0));
            let theta = match self.variables {
                Variables::Entropy => temperature(at.caloric(), y[12 + i], &mut warm[i]),
                Variables::Temperature => y[12 + i],
            };
            Taut {
                arm,
                lambda,
                theta,
                at,
            }
        })
    }

    fn settled(&self, y: &[f64; 14]) -> [Taut<f64>; 2] {
        self.taut(y, &mut self.warm())
    }
}

impl System<14> for Double {
    fn start(&self) -> [f64; 14] {
        let State {
            positions: q,
            momenta: p,
            temperatures,
            ..
        } = &self.start;
        let lengths = [
            norm(&q[..3]),
            norm(&[q[3] - q[0], q[4] - q[1], q[5] - q[2]]),
        ];
        array::from_fn(|i| match (i, self.variables) {
            (0..6, _) => q[i],
            (6..12, _) => p[i - 6],
            (_, Variables::Temperature) => temperatures[i - 12],
            (_, Variables::Entropy) => {
                let spring = self.case.springs[i - 12].at(lengths[i - 12], 0.0);
                spring.entropy(temperatures[i - 12])
            }
        })
    }

    fn warm(&self) -> Warm {
        [self.start.temperatures[0], self.start.temperatures[1]]
    }

    fn rates<R: Number>(&self, y: &[R; 14], warm: &mut Warm) -> [R; 14] {
        let springs = self.taut(y, warm);
        let [first, second] = self.case.masses;
        let v: [[R; 3]; 2] = [
            [y[6] / first, y[7] / first, y[8] / first],
            [y[9] / second, y[10] / second, y[11] / second],
        ];
        let pulls: [[R; 3]; 2] = array::from_fn(|i| {
            let Taut {
                arm,
                lambda,
                theta,
                at,
            } = &springs[i];
            let share = at.force(*theta) / *lambda;
            arm.map(|component| component * share)
        });
        let received = (springs[1].theta - springs[0].theta) * self.case.conductance;
        let stretching = [v[0], array::from_fn(|i| v[1][i] - v[0][i])];
        let heating: [R; 2] = array::from_fn(|i| {
            let Taut {
                arm,
                lambda,
                theta,
                at,
            } = &springs[i];
            let heat = if i == 0 { received } else { -received };
            match self.variables {
                Variables::Entropy => heat / *theta,
                Variables::Temperature => {
                    let rate = dot(*arm, stretching[i]) / *lambda;
                    let [by_lambda, _] = at.slopes(*theta);
                    (heat - *theta * by_lambda * rate) / at.capacity(*theta)
                }
            }
        });
        array::from_fn(|i| match i {
            0..3 => v[0][i],
            3..6 => v[1][i - 3],
            6..9 => pulls[1][i - 6] - pulls[0][i - 6],
            9..12 => -pulls[1][i - 9],
            _ => heating[i - 12],
        })
    }

    fn energy(&self, y: &[f64; 14]) -> f64 {
        let squares = [norm(&y[6..9]), norm(&y[9..12])].map(|p| p * p);
        let [first, second] = self.case.masses;
        let kinetic = squares[0] / (2.0 * first) + squares[1] / (2.0 * second);
        let [one, other] = self.settled(y).map(|spring| spring.at.energy(spring.theta));
        kinetic + one + other
    }

    #[cfg(test)]
    fn entropy(&self, y: &[f64; 14]) -> f64 {
        let springs = self
            .settled(y)
            .map(|spring| spring.at.entropy(spring.theta));
        springs.iter().sum()
    }

    #[cfg(test)]
    fn forces(&self, y: &[f64; 14]) -> Vec<f64> {
        let forces = self.settled(y).map(|spring| spring.at.force(spring.theta));
        forces.to_vec()
    }

    fn state(&self, y: &[f64; 14]) -> State {
        State {
            positions: y[..6].to_vec(),
            momenta: y[6..12].to_vec(),
            temperatures: self.settled(y).map(|spring| spring.theta).to_vec(),
            viscous: Vec::new(),
        }
    }

    fn sizes(&self, momentum: f64) -> [f64; 14] {
        let length = norm(&self.start.positions);
        array::from_fn(|i| match (i, self.variables) {
            (0..6, _) => length,
            (6..12, _) => momentum,
            (_, Variables::Temperature) => self.start.temperatures[i - 12],
            (_, Variables::Entropy) => self.case.springs[i - 12].capacity,
        })
    }
}

fn dot<R: Number>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

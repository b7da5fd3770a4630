//! A plane network of springs, its equations over one step, and their solution by differences.

use eem::{Array, FreeEnergy};
use nalgebra::{DMatrix, DVector};

/// Forces, dashpot forces, entropy at `(λ, γ…, θ)`, and viscosities at θ.
pub(crate) type Law = Box<dyn Fn(f64, &[f64], f64) -> (f64, Vec<f64>, f64, Vec<f64>)>;

/// What a model says, from its gradient alone.
pub(crate) fn law<M: FreeEnergy<f64> + 'static>(model: M) -> Law {
    Box::new(move |lambda, gamma, theta| {
        let mut x = M::Variables::filled(theta);
        x.as_mut()[0] = lambda;
        x.as_mut()[1..=gamma.len()].copy_from_slice(gamma);
        let gradient = model.gradient(&x);
        let [f, rest @ ..] = gradient.as_ref() else {
            unreachable!()
        };
        let g = rest[..gamma.len()].iter().map(|slope| -slope).collect();
        let eta = model.viscosity(theta).0.as_ref().to_vec();
        (*f, g, -rest[gamma.len()], eta)
    })
}

/// A spring between nodes `a` and `b`, in contact with others and with reservoirs.
pub(crate) struct Spring {
    pub(crate) law: Law,
    pub(crate) ends: [usize; 2],
    pub(crate) gamma: Vec<f64>,
    pub(crate) entropy: f64,
    /// Partner and conductance.
    pub(crate) contacts: Vec<(usize, f64)>,
    /// Temperature and conductance.
    pub(crate) reservoirs: Vec<(f64, f64)>,
    /// At the stages.
    pub(crate) prescribed: Option<[f64; 3]>,
}

/// A plane network at the beginning of a step.
pub(crate) struct Network {
    pub(crate) h: f64,
    /// `None` for anchors.
    pub(crate) masses: Vec<Option<f64>>,
    pub(crate) positions: Vec<[f64; 2]>,
    pub(crate) momenta: Vec<[f64; 2]>,
    /// Loads and positions of the anchors at the stages, per node.
    pub(crate) loads: Vec<[[f64; 2]; 3]>,
    pub(crate) supports: Vec<[[f64; 2]; 3]>,
    pub(crate) springs: Vec<Spring>,
}

/// The stages of one spring.
struct Stages {
    gamma: [Vec<f64>; 3],
    theta: [f64; 3],
}

/// The residuals, and what follows from the stages: momenta of the masses; per spring γ¹, s¹ and the
/// entropies of its reservoirs.
#[derive(Default)]
pub(crate) struct Outcome {
    pub(crate) residuals: Vec<f64>,
    pub(crate) momenta: Vec<[f64; 2]>,
    pub(crate) springs: Vec<Vec<f64>>,
}

impl Network {
    /// The stages that unknowns stand for: `q_m`, `q¹` of masses, then `γ_m`, `γ¹`, `θ_0`, `θ_1` of springs.
    fn stages(&self, unknowns: &[f64]) -> (Vec<[[f64; 2]; 3]>, Vec<Stages>) {
        let mut next = unknowns.iter().copied();
        let mut take = || next.next().unwrap();
        let nodes = self.masses.iter().zip(&self.positions).zip(&self.supports);
        let positions = nodes.map(|((mass, &old), &support)| match mass {
            Some(_) => [old, [take(), take()], [take(), take()]],
            None => [old, support[1], support[2]],
        });
        let positions = positions.collect();
        let springs = self.springs.iter().map(|spring| {
            let middle = spring.gamma.iter().map(|_| take()).collect();
            let end = spring.gamma.iter().map(|_| take()).collect();
            let theta = spring.prescribed.unwrap_or_else(|| {
                let [start, end] = [take(), take()];
                [start, 0.5 * (start + end), end]
            });
            let gamma = [spring.gamma.clone(), middle, end];
            Stages { gamma, theta }
        });
        (positions, springs.collect())
    }

    /// The equations of the module `variational_4` of the runtime, as they stand.
    fn evaluate(&self, unknowns: &[f64]) -> Outcome {
        let (q, stages) = self.stages(unknowns);
        // F_i − f_i of each node.
        let mut forces: Vec<[[f64; 2]; 3]> = self.loads.clone();
        for load in forces.iter_mut().flatten().flatten() {
            *load = -*load;
        }
        let mut outcome = Outcome::default();
        for i in 0..self.springs.len() {
            self.deform(i, &q, &stages, &mut forces, &mut outcome);
        }
        for (node, &mass) in self.masses.iter().enumerate() {
            if let Some(mass) = mass {
                self.move_mass(node, mass, &q[node], &forces[node], &mut outcome);
            }
        }
        outcome
    }

    /// Spring `i`: its forces, its equations, its new γ, s and σ.
    fn deform(
        &self,
        i: usize,
        q: &[[[f64; 2]; 3]],
        stages: &[Stages],
        forces: &mut [[[f64; 2]; 3]],
        outcome: &mut Outcome,
    ) {
        let (h, spring, own) = (self.h, &self.springs[i], &stages[i]);
        let [a, b] = spring.ends;
        let mut rates = [(); 3].map(|()| Vec::new());
        let (mut s, mut flow) = ([0.0; 3], [0.0; 3]);
        for i in 0..3 {
            let r = [0, 1].map(|axis| q[b][i][axis] - q[a][i][axis]);
            let lambda = r[0].hypot(r[1]);
            let theta = own.theta[i];
            let (f, g, entropy, eta) = (spring.law)(lambda, &own.gamma[i], theta);
            for axis in 0..2 {
                forces[b][i][axis] += f * r[axis] / lambda;
                forces[a][i][axis] -= f * r[axis] / lambda;
            }
            let mut heat: f64 = g.iter().zip(&eta).map(|(g, eta)| g * g / eta).sum();
            for &(partner, conductance) in &spring.contacts {
                heat += conductance * (stages[partner].theta[i] - theta);
            }
            for &(reservoir, conductance) in &spring.reservoirs {
                heat += conductance * (reservoir - theta);
            }
            rates[i] = g.iter().zip(&eta).map(|(g, eta)| g / eta).collect();
            (s[i], flow[i]) = (entropy, heat / theta);
        }
        for (k, &old) in spring.gamma.iter().enumerate() {
            let rate = [0, 1, 2].map(|i: usize| rates[i][k]);
            let middle = old + h / 24.0 * (5.0 * rate[0] + 8.0 * rate[1] - rate[2]);
            let end = old + h / 6.0 * (rate[0] + 4.0 * rate[1] + rate[2]);
            let residuals = [own.gamma[1][k] - middle, own.gamma[2][k] - end];
            outcome.residuals.extend(residuals);
        }
        let start = s[0] / 2.0 + 2.0 * s[1] / 3.0 - s[2] / 6.0 - h / 6.0 * flow[0];
        let rest = 2.0 * (s[0] - s[2]) / 3.0 + 2.0 * h / 3.0 * flow[1];
        let end = -s[0] / 6.0 + 2.0 * s[1] / 3.0 + s[2] / 2.0 + h / 6.0 * flow[2];
        let mut new = own.gamma[2].clone();
        if spring.prescribed.is_none() {
            outcome.residuals.extend([start - spring.entropy, rest]);
            new.push(end);
        } else {
            new.push(s[2]);
        }
        for &(reservoir, conductance) in &spring.reservoirs {
            let flow = own
                .theta
                .map(|theta| conductance * (theta - reservoir) / reservoir);
            new.push(h / 6.0 * (flow[0] + 4.0 * flow[1] + flow[2]));
        }
        outcome.springs.push(new);
    }

    /// A mass: its equations and its new momentum.
    fn move_mass(
        &self,
        node: usize,
        m: f64,
        q: &[[f64; 2]; 3],
        forces: &[[f64; 2]; 3],
        outcome: &mut Outcome,
    ) {
        let h = self.h;
        let mut new = [0.0; 2];
        for (axis, new) in new.iter_mut().enumerate() {
            let [q0, qm, q1] = q.map(|position| position[axis]);
            let [f0, fm, f1] = forces.map(|force| force[axis]);
            let v0 = (-3.0 * q0 + 4.0 * qm - q1) / h;
            let vm = (q1 - q0) / h;
            let v1 = (q0 - 4.0 * qm + 3.0 * q1) / h;
            let start = m * (v0 / 2.0 + 2.0 * vm / 3.0 - v1 / 6.0) + h / 6.0 * f0;
            let middle = 2.0 / 3.0 * m * (v0 - v1) - 2.0 * h / 3.0 * fm;
            let residuals = [start - self.momenta[node][axis], middle];
            outcome.residuals.extend(residuals);
            *new = m * (-v0 / 6.0 + 2.0 * vm / 3.0 + v1 / 2.0) - h / 6.0 * f1;
        }
        outcome.momenta.push(new);
    }

    /// Newton's method with central differences, until it stalls; the positions at the end and the outcome.
    pub(crate) fn solve(&self, temperatures: &[f64]) -> (Vec<[f64; 2]>, Outcome) {
        let mut unknowns = Vec::new();
        for ((mass, q), p) in self.masses.iter().zip(&self.positions).zip(&self.momenta) {
            let Some(m) = mass else { continue };
            for share in [0.5, 1.0] {
                unknowns.extend([0, 1].map(|axis| q[axis] + share * self.h * p[axis] / m));
            }
        }
        for (spring, &theta) in self.springs.iter().zip(temperatures) {
            unknowns.extend([spring.gamma.clone(), spring.gamma.clone()].concat());
            if spring.prescribed.is_none() {
                unknowns.extend([theta, theta]);
            }
        }
        let size = unknowns.len();
        for _ in 0..20 {
            let residual = DVector::from_vec(self.evaluate(&unknowns).residuals);
            let mut tangent = DMatrix::zeros(size, size);
            for column in 0..size {
                let step = 1e-6 * unknowns[column].abs().max(1.0);
                let shifted = |sign: f64| {
                    let mut shifted = unknowns.clone();
                    shifted[column] += sign * step;
                    DVector::from_vec(self.evaluate(&shifted).residuals)
                };
                let slope = (shifted(1.0) - shifted(-1.0)) / (2.0 * step);
                tangent.set_column(column, &slope);
            }
            let update = tangent.lu().solve(&residual).unwrap();
            for (unknown, change) in unknowns.iter_mut().zip(update.iter()) {
                *unknown -= change;
            }
        }
        let (positions, _) = self.stages(&unknowns);
        let ends = positions.iter().map(|stages| stages[2]).collect();
        (ends, self.evaluate(&unknowns))
    }
}

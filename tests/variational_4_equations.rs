//! A step of the variational integrator of fourth order solves its equations, as written down and solved
//! here once more, with tangents from differences.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod support;

use eem::prelude::*;
use eem::{Array, FreeEnergy};
use nalgebra::{DMatrix, DVector};
use support::{LogarithmicStiffness, ThermoViscoElastic};

/// Newton's method with a tangent from central differences stalls at the rounding of the residuals
/// times the condition of the tangent, some 10² here; and so does that of the scheme.
const TOLERANCE: f64 = 1e-13;

/// Forces, dashpot forces, entropy at `(λ, γ…, θ)`, and viscosities at θ.
type Law = Box<dyn Fn(f64, &[f64], f64) -> (f64, Vec<f64>, f64, Vec<f64>)>;

/// What a model says, from its gradient alone.
fn law<M: FreeEnergy<f64> + 'static>(model: M) -> Law {
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
struct Spring {
    law: Law,
    ends: [usize; 2],
    gamma: Vec<f64>,
    entropy: f64,
    /// Partner and conductance.
    contacts: Vec<(usize, f64)>,
    /// Temperature and conductance.
    reservoirs: Vec<(f64, f64)>,
    /// At the stages.
    prescribed: Option<[f64; 3]>,
}

/// A plane network at the beginning of a step.
struct Network {
    h: f64,
    /// `None` for anchors.
    masses: Vec<Option<f64>>,
    positions: Vec<[f64; 2]>,
    momenta: Vec<[f64; 2]>,
    /// Loads and positions of the anchors at the stages, per node.
    loads: Vec<[[f64; 2]; 3]>,
    supports: Vec<[[f64; 2]; 3]>,
    springs: Vec<Spring>,
}

/// The stages of one spring.
struct Stages {
    gamma: [Vec<f64>; 3],
    theta: [f64; 3],
}

/// The residuals, and what follows from the stages: momenta; per spring γ¹, s¹ and the entropies of its reservoirs.
struct Outcome {
    residuals: Vec<f64>,
    momenta: Vec<[f64; 2]>,
    springs: Vec<Vec<f64>>,
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
        let h = self.h;
        let (mut residuals, mut springs) = (Vec::new(), Vec::new());
        // F_i − f_i of each node.
        let mut forces: Vec<[[f64; 2]; 3]> = self.loads.clone();
        for load in forces.iter_mut().flatten().flatten() {
            *load = -*load;
        }
        for (spring, own) in self.springs.iter().zip(&stages) {
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
                residuals.extend([own.gamma[1][k] - middle, own.gamma[2][k] - end]);
            }
            let start = s[0] / 2.0 + 2.0 * s[1] / 3.0 - s[2] / 6.0 - h / 6.0 * flow[0];
            let rest = 2.0 * (s[0] - s[2]) / 3.0 + 2.0 * h / 3.0 * flow[1];
            let end = -s[0] / 6.0 + 2.0 * s[1] / 3.0 + s[2] / 2.0 + h / 6.0 * flow[2];
            if spring.prescribed.is_none() {
                residuals.extend([start - spring.entropy, rest]);
            }
            let mut new = own.gamma[2].clone();
            new.push(if spring.prescribed.is_none() {
                end
            } else {
                s[2]
            });
            for &(reservoir, conductance) in &spring.reservoirs {
                let flow = own
                    .theta
                    .map(|theta| conductance * (theta - reservoir) / reservoir);
                new.push(h / 6.0 * (flow[0] + 4.0 * flow[1] + flow[2]));
            }
            springs.push(new);
        }
        let mut momenta = Vec::new();
        for (node, &mass) in self.masses.iter().enumerate() {
            let Some(m) = mass else { continue };
            let mut new = [0.0; 2];
            for axis in 0..2 {
                let [q0, qm, q1] = q[node].map(|position| position[axis]);
                let [f0, fm, f1] = forces[node].map(|force| force[axis]);
                let v0 = (-3.0 * q0 + 4.0 * qm - q1) / h;
                let vm = (q1 - q0) / h;
                let v1 = (q0 - 4.0 * qm + 3.0 * q1) / h;
                let start = m * (v0 / 2.0 + 2.0 * vm / 3.0 - v1 / 6.0) + h / 6.0 * f0;
                residuals.push(start - self.momenta[node][axis]);
                residuals.push(2.0 / 3.0 * m * (v0 - v1) - 2.0 * h / 3.0 * fm);
                new[axis] = m * (-v0 / 6.0 + 2.0 * vm / 3.0 + v1 / 2.0) - h / 6.0 * f1;
            }
            momenta.push(new);
        }
        Outcome {
            residuals,
            momenta,
            springs,
        }
    }

    /// Newton's method with central differences, until it stalls; the positions at the end and the outcome.
    fn solve(&self, temperatures: &[f64]) -> (Vec<[f64; 2]>, Outcome) {
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

#[test]
fn a_step_of_a_network_solves_the_equations() {
    const H: f64 = 0.06;
    const START: f64 = 0.0;
    let positions = [[0.0, 0.0], [1.3, 0.1], [1.2, -1.0]];
    let momenta = [[0.0, 0.0], [0.4, 1.0], [-0.5, 0.2]];
    let masses = [None, Some(1.0), Some(0.5)];
    let temperatures = [330.0, 320.0, thermostat(START)];
    let soft = LogarithmicStiffness {
        stiffness: 80.0,
        softening: 0.2,
        coupling: 0.5,
        capacity: 3.0,
        natural_length: 1.0,
        theta_ref: 300.0,
    };

    let mut scene = Scene::<2>::new();
    let anchor = scene.anchor(positions[0]);
    let nodes = [1, 2].map(|i| {
        let node = scene.mass(masses[i].unwrap(), positions[i], [0.0; 2]);
        scene.set_momentum(node, momenta[i]);
        node
    });
    let springs = [
        scene.spring(ThermoViscoElastic::PENDULUM, [anchor, nodes[0]]),
        scene.spring(TWO_DASHPOTS, [nodes[0], nodes[1]]),
        scene.spring(soft.clone(), [anchor, nodes[1]]),
    ];
    for (spring, theta) in springs.into_iter().zip(temperatures) {
        scene.set_temperature(spring, theta);
    }
    scene.set_viscous_stretch(springs[1], 0, 0.05);
    scene.conduct(springs[0], springs[1], 4.0);
    scene.conduct(springs[1], springs[2], 7.0);
    let air = scene.reservoir(295.0);
    scene.conduct(springs[0], air, 5.0);
    scene.set_gravity([0.0, -9.81]);
    scene.force(nodes[1], push);
    scene.move_anchor(anchor, support);
    scene.prescribe_temperature(springs[2], thermostat);
    let mut run = Simulation::new(scene, Scheme::Variational4, H).unwrap();
    assert_eq!(run.unknowns(), 2 * (2 * 2 + 3));
    let entropies = springs.map(|spring| run.entropy(spring).unwrap());

    let times = [START, START + 0.5 * H, START + H];
    let loads = |node: usize| {
        let weight = -9.81 * masses[node].unwrap_or(0.0);
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
        reservoirs: if i == 0 {
            vec![(295.0, 5.0)]
        } else {
            Vec::new()
        },
        prescribed: (i == 2).then_some(times.map(thermostat)),
    };
    let network = Network {
        h: H,
        masses: masses.to_vec(),
        positions: positions.to_vec(),
        momenta: momenta.to_vec(),
        loads: [0, 1, 2].map(loads).to_vec(),
        supports: vec![times.map(support); 3],
        springs: vec![
            spring(
                0,
                law(ThermoViscoElastic::PENDULUM),
                [0, 1],
                &[0.0],
                &[(1, 4.0)],
            ),
            spring(
                1,
                law(TWO_DASHPOTS),
                [1, 2],
                &[0.05, 0.0],
                &[(0, 4.0), (2, 7.0)],
            ),
            spring(2, law(soft), [0, 2], &[], &[(1, 7.0)]),
        ],
    };
    let (ends, outcome) = network.solve(&temperatures);
    let report = run.step().unwrap();
    println!("{} iterations", report.iterations);

    for (i, &node) in nodes.iter().enumerate() {
        let (q, p) = (run.position(node).unwrap(), run.momentum(node).unwrap());
        for axis in 0..2 {
            assert_close(q[axis], ends[1 + i][axis], 1.0, "position");
            assert_close(p[axis], outcome.momenta[i][axis], 1.0, "momentum");
        }
    }
    for (i, &spring) in springs.iter().enumerate() {
        // γ¹…, s¹, σ…
        let dashpots = [1, 2, 0][i];
        let (gamma, rest) = outcome.springs[i].split_at(dashpots);
        let s = rest[0];
        for (k, &gamma) in gamma.iter().enumerate() {
            assert_close(run.viscous_stretch(spring, k).unwrap(), gamma, 1.0, "γ");
        }
        assert_close(run.entropy(spring).unwrap(), s, s.abs(), "s");
    }
    let sigma = run.reservoir_entropy(air).unwrap();
    assert_close(sigma, outcome.springs[0][2], 1.0, "σ");
    assert_close(
        run.temperature(springs[2]).unwrap(),
        thermostat(H),
        300.0,
        "θ",
    );
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

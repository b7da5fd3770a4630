//! The variational integrator with λ at the mean configuration is the implicit midpoint rule in
//! entropy variables; with the mean of both lengths it is another scheme of second order.
//!
//! Kern, Romero, Conde Martín & García Orden (2021), §III.A, leave open how λ is discretised. Here
//! the discrete Lagrangian takes `λ_m = |q_m|`, `q_m = ½(q⁰ + q¹)`, so that `∂λ_m/∂q⁰ = ½ n` with
//! `n = q_m/|q_m|`:
//!
//! ```text
//! p⁰ = m v + ½h f_m n,   p¹ = m v − ½h f_m n,   v = (q¹ − q⁰)/h,   γ¹ − γ⁰ = h g_m/η(θ_m)
//! s⁰ = s_m − ½h Φ,   s¹ = s_m + ½h Φ,   Φ = (g_m²/η(θ_m) + κ (θr − θ_m))/θ_m
//! ```
//!
//! The solver below shares nothing with the library but ψ and its gradient.

use eem::prelude::*;
use nalgebra::{Matrix4, Vector2, Vector4};

use crate::support::{ThermoViscoElastic, single_pendulum};

const ROOM: f64 = 300.0;
const CONDUCTANCE: f64 = 10.0;
const MODEL: ThermoViscoElastic = ThermoViscoElastic::PENDULUM;

/// The variables of the single pendulum, whose mass is 1 kg.
#[derive(Clone, Copy, Debug)]
struct State {
    q: Vector2<f64>,
    p: Vector2<f64>,
    gamma: f64,
    entropy: f64,
    /// Temperature (K) of the last midpoint, where the next step's search begins.
    theta: f64,
    reservoir: f64,
}

/// What the discrete Lagrangian evaluates at the midpoint.
struct Midpoint {
    velocity: Vector2<f64>,
    pull: Vector2<f64>,
    creep: f64,
    entropy: f64,
    production: f64,
}

impl State {
    fn start() -> Self {
        let theta = 380.0;
        let gradient = MODEL.gradient(&[3.0, 0.0, theta]);
        Self {
            q: Vector2::new(3.0, 0.0),
            p: Vector2::new(0.0, 1.0),
            gamma: 0.0,
            entropy: -gradient[2],
            theta,
            reservoir: 0.0,
        }
    }

    /// The midpoint for the unknowns `(q¹ − q⁰, γ¹ − γ⁰, θ_m)`.
    fn midpoint(&self, unknowns: &Vector4<f64>, h: f64) -> Midpoint {
        let change = Vector2::new(unknowns[0], unknowns[1]);
        let (mean, theta) = (self.q + 0.5 * change, unknowns[3]);
        let gamma = self.gamma + 0.5 * unknowns[2];
        let [f, minus_g, minus_s] = MODEL.gradient(&[mean.norm(), gamma, theta]);
        let creep = -minus_g / MODEL.viscosity(theta).0[0];
        Midpoint {
            velocity: change / h,
            pull: f * mean / mean.norm(),
            creep,
            entropy: -minus_s,
            production: (-minus_g * creep + CONDUCTANCE * (ROOM - theta)) / theta,
        }
    }

    /// Zero at the solution.
    fn residual(&self, unknowns: &Vector4<f64>, h: f64) -> Vector4<f64> {
        let at = self.midpoint(unknowns, h);
        let momentum = at.velocity + 0.5 * h * at.pull - self.p;
        let creep = unknowns[2] - h * at.creep;
        let entropy = at.entropy - 0.5 * h * at.production - self.entropy;
        Vector4::new(momentum.x, momentum.y, creep, entropy)
    }

    /// One step by Newton's method with central differences for its matrix, ended when the residual
    /// no longer falls: its rounding decides the accuracy, not the matrix.
    fn step(&mut self, h: f64) {
        const MOST_ITERATIONS: usize = 60;
        let mut unknowns = Vector4::new(h * self.p.x, h * self.p.y, 0.0, self.theta);
        let mut residual = self.residual(&unknowns, h);
        for _ in 0..MOST_ITERATIONS {
            let columns: [Vector4<f64>; 4] = core::array::from_fn(|column| {
                // The cube root of ε balances truncation against rounding.
                let delta = f64::EPSILON.cbrt() * f64::max(1.0, unknowns[column].abs());
                let mut shift = Vector4::zeros();
                shift[column] = delta;
                let [up, down] = [unknowns + shift, unknowns - shift].map(|x| self.residual(&x, h));
                (up - down) / (2.0 * delta)
            });
            let matrix = Matrix4::from_columns(&columns);
            let next = unknowns - matrix.lu().solve(&residual).unwrap();
            let next_residual = self.residual(&next, h);
            if next_residual.norm() >= residual.norm() {
                break;
            }
            (unknowns, residual) = (next, next_residual);
        }
        assert!(residual.norm() < 1e-10, "no solution: {residual}");
        let at = self.midpoint(&unknowns, h);
        self.q += Vector2::new(unknowns[0], unknowns[1]);
        self.p = at.velocity - 0.5 * h * at.pull;
        self.gamma += unknowns[2];
        self.entropy = at.entropy + 0.5 * h * at.production;
        self.theta = unknowns[3];
        self.reservoir += h * CONDUCTANCE * (self.theta - ROOM) / ROOM;
    }

    fn row(&self) -> [f64; 7] {
        let Self { q, p, .. } = self;
        [q.x, q.y, p.x, p.y, self.gamma, self.entropy, self.reservoir]
    }
}

/// The same row of the library's run after `steps` steps.
fn library(scheme: Scheme, h: f64, steps: u32) -> [f64; 7] {
    let mut pendulum = single_pendulum(scheme, h);
    for _ in 0..steps {
        pendulum.run.step().unwrap();
    }
    let [qx, qy, px, py, _, gamma, sigma] = pendulum.row();
    let entropy = pendulum.run.entropy(pendulum.spring).unwrap();
    [qx, qy, px, py, gamma, entropy, sigma]
}

fn variant(h: f64, steps: u32) -> [f64; 7] {
    let mut state = State::start();
    for _ in 0..steps {
        state.step(h);
    }
    state.row()
}

/// The size of every entry of a row: m, kg m/s, m, J/K. The pendulum's momentum reaches 60 kg m/s.
const SCALES: [f64; 7] = [3.0, 3.0, 60.0, 60.0, 0.1, 6.0, 6.0];

/// The largest difference of two rows, in units of the scales.
fn distance(a: [f64; 7], b: [f64; 7]) -> f64 {
    let differences = (0..7).map(|i| (a[i] - b[i]).abs() / SCALES[i]);
    differences.fold(0.0, f64::max)
}

/// What the two solvers may differ by: each leaves a few roundings of the residual in every step,
/// ten together, and the motion, which is damped, carries them along without amplifying them.
fn solver_tolerance(steps: u32) -> f64 {
    10.0 * f64::EPSILON * f64::from(steps)
}

#[test]
fn length_of_the_mean_configuration_gives_the_midpoint_rule() {
    for (h, steps) in [(0.001, 200), (0.01, 100), (0.05, 20), (0.2, 10)] {
        let off = distance(variant(h, steps), library(Scheme::Midpoint, h, steps));
        let tolerance = solver_tolerance(steps);
        println!("h = {h} s, {steps} steps: off by {off:e} (bound {tolerance:e})");
        assert!(off <= tolerance);
    }
}

#[test]
fn mean_of_both_lengths_differs_at_second_order() {
    const END: f64 = 0.1;
    let differences = [50, 100, 200].map(|steps| {
        let h = END / f64::from(steps);
        distance(variant(h, steps), library(Scheme::Variational, h, steps))
    });
    let slopes = [0, 1].map(|i| (differences[i] / differences[i + 1]).log2());
    println!("differences {differences:?}, slopes {slopes:?}");
    // Both schemes are symmetric, so that the next term is smaller by (ωh)², 2 % at the largest step
    // for the pendulum's ω = 73/s, which is 0.03 in the slope.
    assert!(slopes.iter().all(|slope| (slope - 2.0).abs() <= 0.1));
    // And the difference is no rounding.
    assert!(differences[2] > 1e3 * solver_tolerance(200));
}

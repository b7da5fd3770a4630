//! Rates of the unknowns and of the integrals.
//!
//! ```text
//! q̇ = p/m,   ṗ = −f n at the end of a spring, + f n at its beginning,   γ̇ = g/η
//! heat:      Q = g γ̇ ± κ (θ₁ − θ₀)
//! integrals: A = κ (θ₁ − θ₀)/θ₀,   Π = A (θ₁ − θ₀)/θ₁,   D = g γ̇/θ₀
//! θ̇ = (Q − θ s_λ λ̇ − θ s_γ γ̇)/c,   λ̇ = n·(v_b − v_a)
//! ```

use super::model::{Edge, Pendulum, Point, edges, relative};
use super::quadrature::{DASHPOT, GIVEN, PRODUCED};

/// Rates at the twelve stages of a step. Those of the first are there before it: they belong to the state.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stages<const N: usize, const X: usize> {
    /// ẏ.
    pub(super) y: [[f64; N]; 12],
    /// Rates of the integrals.
    pub(super) x: [[f64; X]; 12],
}

impl<const N: usize, const X: usize> Stages<N, X> {
    pub(super) const fn new() -> Self {
        Self {
            y: [[0.0; N]; 12],
            x: [[0.0; X]; 12],
        }
    }

    /// The rates of a stage at y; false if the state is not admissible.
    #[inline(always)]
    pub(super) fn evaluate<C: Pendulum<N, X>>(&mut self, stage: usize, y: &[f64; N]) -> bool {
        let edges = edges::<C, N, X>(y);
        let mut points = [Point::default(); 2];
        let mut is_admissible = true;
        for spring in 0..C::COUNT {
            let gamma = gamma_of::<C, N, X>(y, spring);
            let theta = y[C::THETA + spring];
            points[spring] = C::at_temperature(spring, edges[spring].length, gamma, theta);
            is_admissible &= points[spring].is_admissible();
        }
        self.store::<C>(stage, y, &edges, &points);
        is_admissible
    }

    /// Stores the rates at y, with springs that have been evaluated.
    #[inline(always)]
    pub(super) fn store<C: Pendulum<N, X>>(
        &mut self,
        stage: usize,
        y: &[f64; N],
        edges: &[Edge; 2],
        points: &[Point; 2],
    ) {
        let rates = &mut self.y[stage];
        for mass in 0..C::COUNT {
            let inverse = 1.0 / C::MASSES[mass];
            for i in C::DIMENSION * mass..C::DIMENSION * (mass + 1) {
                rates[i] = y[C::P + i] * inverse;
                rates[C::P + i] = 0.0;
            }
        }
        let heat = self.exchange::<C>(stage, edges, points);
        let rates = &mut self.y[stage];
        for spring in 0..C::COUNT {
            let Point {
                theta,
                entropy_by_lambda,
                entropy_by_gamma,
                capacity,
                ..
            } = points[spring];
            let mut lambda_rate = 0.0;
            for d in 0..C::DIMENSION {
                let velocity = relative::<C, N, X>(rates, spring, d);
                lambda_rate += edges[spring].direction[d] * velocity;
            }
            let mut absorbed = theta * entropy_by_lambda * lambda_rate;
            if C::DASHPOTS > 0 {
                absorbed += theta * entropy_by_gamma * rates[C::GAMMA + spring];
            }
            rates[C::THETA + spring] = (heat[spring] - absorbed) / capacity;
        }
    }

    /// Forces, dashpots and conduction: adds ṗ, sets γ̇ and the rates of the integrals, returns Q of both bodies, W.
    #[inline(always)]
    fn exchange<C: Pendulum<N, X>>(
        &mut self,
        stage: usize,
        edges: &[Edge; 2],
        points: &[Point; 2],
    ) -> [f64; 2] {
        let (rates, integrals) = (&mut self.y[stage], &mut self.x[stage]);
        let mut heat = [0.0; 2];
        for spring in 0..C::COUNT {
            let point = &points[spring];
            add_forces::<C, N, X>(&mut rates[C::P..], spring, &edges[spring], point.force);
            if C::DASHPOTS > 0 {
                let gamma_rate = point.dashpot_force / point.viscosity;
                rates[C::GAMMA + spring] = gamma_rate;
                heat[spring] = point.dashpot_force * gamma_rate;
                integrals[DASHPOT + spring] = heat[spring] * (1.0 / point.theta);
            }
        }
        let [near, far] = temperatures::<C, N, X>(points);
        let difference = far - near;
        let conducted = C::CONDUCTANCE * difference;
        heat[0] += conducted;
        heat[1] -= conducted;
        let given = conducted * (1.0 / near);
        integrals[GIVEN] = given;
        integrals[PRODUCED] = given * (difference * (1.0 / far));
        heat
    }
}

/// Adds the force f of a spring at both of its ends to forces of the masses, N.
#[inline(always)]
pub(super) fn add_forces<C: Pendulum<N, X>, const N: usize, const X: usize>(
    forces: &mut [f64],
    spring: usize,
    edge: &Edge,
    force: f64,
) {
    for d in 0..C::DIMENSION {
        let component = force * edge.direction[d];
        forces[C::DIMENSION * spring + d] -= component;
        if spring > 0 {
            forces[C::DIMENSION * (spring - 1) + d] += component;
        }
    }
}

/// θ of the two bodies that heat is conducted between, K.
#[inline(always)]
pub(super) fn temperatures<C: Pendulum<N, X>, const N: usize, const X: usize>(
    points: &[Point; 2],
) -> [f64; 2] {
    let second = if C::HAS_RESERVOIR {
        C::RESERVOIR
    } else {
        points[1].theta
    };
    [points[0].theta, second]
}

/// γ of a spring, m; zero without dashpots.
#[inline(always)]
pub(super) fn gamma_of<C: Pendulum<N, X>, const N: usize, const X: usize>(
    y: &[f64; N],
    spring: usize,
) -> f64 {
    if C::DASHPOTS > 0 {
        y[C::GAMMA + spring]
    } else {
        0.0
    }
}

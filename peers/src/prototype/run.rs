//! Steps of a pendulum.

use core::array;
use core::marker::PhantomData;

use super::closing::{Closing, Target};
use super::control::error;
use super::model::{Pendulum, angular_momentum, edges, kinetic_energy, vector};
use super::quadrature::{Entropies, book};
use super::stages::{Stages, gamma_of};
use crate::systems::{State, norm};

/// Largest relative defect of the energy before the closing, in steps without tolerance.
const MOST_DEFECT: f64 = 1e-3;

/// A pendulum in motion.
#[derive(Clone, Debug)]
pub(crate) struct Run<C, const N: usize, const X: usize> {
    /// s.
    pub(super) time: f64,
    /// (q, p, γ, θ).
    pub(super) y: [f64; N],
    entropies: Entropies,
    target: Target,
    pub(super) stages: Stages<N, X>,
    /// The largest |p|₂ so far, kg m/s: momenta are accurate relative to it.
    pub(super) largest_momentum: f64,
    pendulum: PhantomData<C>,
}

impl<C: Pendulum<N, X>, const N: usize, const X: usize> Run<C, N, X> {
    pub(crate) fn new() -> Self {
        let y = C::start();
        let edges = edges::<C, N, X>(&y);
        let mut entropies = [0.0; 2];
        for (spring, entropy) in entropies.iter_mut().enumerate().take(C::COUNT) {
            let gamma = gamma_of::<C, N, X>(&y, spring);
            let theta = y[C::THETA + spring];
            *entropy = C::entropy(spring, edges[spring].length, gamma, theta);
        }
        let mut start = Closing::new(y, Entropies::new(entropies));
        start.evaluate::<C, X>();
        let mut stages = Stages::new();
        stages.store::<C>(0, &start.y, &start.edges, &start.points);
        Self {
            time: 0.0,
            y: start.y,
            entropies: start.entropies,
            target: start.own_target::<C, X>(),
            stages,
            largest_momentum: 0.0,
            pendulum: PhantomData,
        }
    }

    /// A step of size h. The error in units of the tolerance, zero without one. If the step is rejected, the same or
    /// infinity as `Err`, and the state stays.
    #[inline]
    pub(crate) fn step(&mut self, h: f64, tolerance: Option<f64>) -> Result<f64, f64> {
        let is_admissible = self.stages.fill::<C>(h, &self.y);
        if !is_admissible {
            return Err(f64::INFINITY);
        }
        let (changes, integrals) = self.stages.changes(h);
        let mut y = self.y;
        for (y, change) in y.iter_mut().zip(changes) {
            *y += change;
        }
        let error = tolerance.map_or(0.0, |tolerance| error(self, h, &y, tolerance));
        if error.is_nan() || error > 1.0 {
            return Err(if error.is_finite() {
                error
            } else {
                f64::INFINITY
            });
        }
        if !y[C::THETA..].iter().all(|&theta| theta > 0.0) {
            return Err(f64::INFINITY);
        }
        let mut entropies = self.entropies;
        let production = book::<C, N, X>(integrals, &self.stages, h, &mut entropies);
        let mut closing = Closing::new(y, entropies);
        let defect = closing.close::<C, X>(h, &self.target, production);
        let defect = defect.ok_or(f64::INFINITY)?;
        let most = tolerance.unwrap_or(MOST_DEFECT);
        if defect > most {
            return Err(tolerance.map_or(f64::INFINITY, |tolerance| defect / tolerance));
        }
        self.y = closing.y;
        self.entropies = closing.entropies;
        self.time += h;
        self.stages
            .store::<C>(0, &self.y, &closing.edges, &closing.points);
        Ok(error)
    }

    /// The entropies of the two bodies, J/K.
    pub(crate) const fn entropies(&self) -> [f64; 2] {
        self.entropies.value
    }

    /// What rounding of the energy is relative to, J: |E| + T + Σ (|e| + θ (|s| + c)), the sum at the start.
    pub(crate) fn energy_size(&self) -> f64 {
        self.target.energy.abs() + kinetic_energy::<C, N, X>(&self.y) + self.target.size
    }

    /// |J − J(0)|, and Σ |q| |p|, which rounding of J is relative to, N m s.
    pub(crate) fn momentum_defect(&self) -> [f64; 2] {
        let now = angular_momentum::<C, N, X>(&self.y);
        let change: [f64; 3] = array::from_fn(|d| now[d] - self.target.momentum[d]);
        let sizes = (0..C::COUNT).map(|mass| {
            let q = vector::<C, N, X>(&self.y, 0, mass);
            norm(&q) * norm(&vector::<C, N, X>(&self.y, C::P, mass))
        });
        [norm(&change), sizes.sum()]
    }

    /// q, p, γ and θ.
    pub(crate) fn state(&self) -> State {
        State {
            positions: self.y[..C::P].to_vec(),
            momenta: self.y[C::P..C::GAMMA].to_vec(),
            temperatures: self.y[C::THETA..].to_vec(),
            viscous: self.y[C::GAMMA..C::THETA].to_vec(),
        }
    }
}

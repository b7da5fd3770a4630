//! The equations of one point in the adjoint of a step, and their elimination.

use crate::algebra::lu::{self, Singular};
use crate::element::group::{PointStep, PointWeights};
use eem_material::number::scalar::Real;

/// Heat that reaches a point, and its derivatives.
pub(super) struct Heat<S> {
    /// `Σ κ (Θ_b − Θ_a) + Σ κ_r (θ_r − θ*)`, W.
    pub(super) received: S,
    /// `Σ κ_r` and `Σ κ`, W/K.
    pub(super) to_reservoirs: S,
    pub(super) to_elements: S,
    /// `Σ λ_σ h κ_r/θ_r`.
    pub(super) of_reservoirs: S,
}

/// The equations of one point in a step, its own unknowns last: arms, Θ if it is coupled, then γ and θ.
pub(super) struct LocalStep<'a, S, const D: usize> {
    pub(super) point: &'a PointStep<S, D>,
    pub(super) step: S,
    pub(super) heat: Heat<S>,
    pub(super) is_coupled: bool,
    pub(super) is_held: bool,
}

/// Weights of the response, and of increments of measures and viscous stretches.
pub(super) struct ResponseWeights<S> {
    pub(super) response: Vec<S>,
    pub(super) extension: Vec<S>,
    pub(super) creep: Vec<S>,
}

impl<S: Real, const D: usize> LocalStep<'_, S, D> {
    /// Number of components of arms.
    pub(super) fn arms(&self) -> usize {
        (self.point.nodes.len() - 1) * D
    }

    /// Arms and Θ.
    pub(super) fn outer(&self) -> usize {
        self.arms() + usize::from(self.is_coupled)
    }

    pub(super) fn is_thermal(&self) -> bool {
        self.point.slots.thermal.is_some()
    }

    /// γ and θ.
    pub(super) fn inner(&self) -> usize {
        self.point.dashpots() + usize::from(self.is_thermal())
    }

    /// `D*π_a · w` of each measure.
    pub(super) fn along(&self, weights: &[S]) -> Vec<S> {
        let directions = self.point.direction.iter();
        let along = directions.map(|direction| {
            let components = direction.iter().flatten().zip(weights);
            components.fold(S::zero(), |sum, (&g, &w)| sum + g * w)
        });
        along.collect()
    }

    /// The weight of its entropy balance, or of its temperature where that is held; zero for the other one.
    pub(super) fn heat_weights(&self, weights: &[S]) -> [S; 2] {
        let at = self.outer() + self.point.dashpots();
        let own = weights.get(at).copied().unwrap_or(S::zero());
        if self.is_held {
            [S::zero(), own]
        } else {
            [own, S::zero()]
        }
    }

    /// The weight of its entropy balance.
    pub(super) fn entropy_weight(&self, weights: &[S]) -> S {
        self.heat_weights(weights)[0]
    }

    /// The heat of its dashpots, W, at viscosities `η` of those in series and in parallel.
    pub(super) fn dissipation(&self, viscosities: &[S], drag: &[S]) -> S {
        let rates = |increments: &[S], factors: &[S]| {
            let pairs = increments.iter().zip(factors);
            pairs.fold(S::zero(), |sum, (&increment, &eta)| {
                let rate = increment / self.step;
                sum + eta * rate * rate
            })
        };
        rates(&self.point.creep, viscosities) + rates(&self.point.extension, drag)
    }

    /// The derivatives of `wᵀR` by the response and by the increments; `reservoirs` is 1 with the given weights of
    /// reservoirs, else 0.
    pub(super) fn response_weights(&self, weights: &[S], reservoirs: S) -> ResponseWeights<S> {
        let (point, h) = (self.point, self.step);
        let along = self.along(weights);
        let entropy = self.entropy_weight(weights);
        let two = S::from_f64(2.0);
        let mut response: Vec<S> = along.iter().map(|&along| h * along).collect();
        let mut extension = vec![S::zero(); point.extension.len()];
        let mut creep = vec![S::zero(); point.dashpots()];
        let theta = point.temperature;
        // Without a temperature there is no entropy balance.
        let per_theta = if self.is_thermal() {
            theta.recip()
        } else {
            S::zero()
        };
        let [eta, eta_slope] = &point.viscosities;
        let [drag, drag_slope] = &point.drag;
        let mut by_theta = S::zero();
        for (k, creep) in creep.iter_mut().enumerate() {
            let own = weights[self.outer() + k];
            response.push(-own);
            let rate = point.creep[k] / h;
            by_theta += own * eta_slope[k] * rate;
            *creep = own * eta[k] / h - two * entropy * eta[k] * rate * per_theta;
        }
        for a in 0..drag.len() {
            let rate = point.extension[a] / h;
            by_theta += drag_slope[a] * point.extension[a] * along[a];
            extension[a] = drag[a] * along[a] - two * entropy * drag[a] * rate * per_theta;
        }
        if self.is_thermal() {
            let heat = self.dissipation(eta, drag) + self.heat.received;
            let slope = self.dissipation(eta_slope, drag_slope) - self.heat.to_reservoirs;
            by_theta += entropy * h * per_theta * (heat * per_theta - slope);
            by_theta -= reservoirs * self.heat.of_reservoirs;
            if self.is_coupled {
                by_theta -= weights[self.arms()];
            }
            response.push(by_theta);
            response.push(entropy);
        }
        ResponseWeights {
            response,
            extension,
            creep,
        }
    }

    /// The derivatives of `wᵀR` by arms, Θ, γ and θ of the old state (`end` 0; without Θ) or of the new one.
    pub(super) fn pull(&self, end: usize, weights: &[S], reservoirs: S) -> Vec<S> {
        let (point, arms) = (self.point, self.arms());
        let by = self.response_weights(weights, reservoirs);
        let measures = point.extension.len();
        let variables = measures + self.inner();
        let mut slopes = vec![S::zero(); variables];
        for (row, &weight) in point.slopes[end].iter().zip(&by.response) {
            for (slope, &entry) in slopes.iter_mut().zip(row) {
                *slope += weight * entry;
            }
        }
        let sign = if end == 0 { -S::one() } else { S::one() };
        let increments = by.extension.iter().chain(&by.creep);
        for (slope, &increment) in slopes.iter_mut().zip(increments) {
            *slope += sign * increment;
        }
        let mut pulled = vec![S::zero(); self.outer() + self.inner()];
        for (gradient, &slope) in point.gradients[end].iter().zip(&slopes) {
            for (entry, &g) in pulled.iter_mut().zip(gradient.iter().flatten()) {
                *entry += slope * g;
            }
        }
        for (row, &weight) in point.curvature[end].iter().zip(&weights[..arms]) {
            for (entry, &curvature) in pulled[..arms].iter_mut().zip(row) {
                *entry += self.step * weight * curvature;
            }
        }
        if self.is_coupled && end == 1 {
            let entropy = self.entropy_weight(weights);
            pulled[arms] = weights[arms] + self.per_heat() * self.heat.to_elements * entropy;
        }
        let outer = self.outer();
        pulled[outer..].copy_from_slice(&slopes[measures..]);
        if self.is_held && end == 1 {
            pulled[outer + point.dashpots()] += self.heat_weights(weights)[1];
        }
        pulled
    }

    /// h/θ*, s/K.
    pub(super) fn per_heat(&self) -> S {
        self.step / self.point.temperature
    }

    /// The weights in the derivatives by the parameters.
    pub(super) fn parameter_weights(&self, weights: &[S]) -> PointWeights<S> {
        let point = self.point;
        let by = self.response_weights(weights, S::one());
        let entropy = self.entropy_weight(weights);
        let per_heat = if self.is_thermal() {
            entropy * self.per_heat()
        } else {
            S::zero()
        };
        let of = |along: S, increment: S| {
            let rate = increment / self.step;
            along * increment - per_heat * rate * rate
        };
        let along = self.along(weights);
        let creep = point.creep.iter().enumerate();
        let viscosities = creep.map(|(k, &creep)| of(weights[self.outer() + k] / self.step, creep));
        let drag = (0..point.drag[0].len()).map(|a| of(along[a], point.extension[a]));
        PointWeights {
            temperature: point.temperature,
            response: by.response.iter().map(|&weight| -weight).collect(),
            viscosities: viscosities.map(|weight| -weight).collect(),
            drag: drag.map(|weight| -weight).collect(),
        }
    }
}

/// The equations of a point after its own unknowns are eliminated: what they are, given the outer weights.
pub(super) struct Eliminated<S> {
    /// The own weights without outer ones, and their derivatives by the outer ones, column by column.
    pub(super) constant: Vec<S>,
    pub(super) by_outer: Vec<Vec<S>>,
    /// The outer rows: constant part, and derivatives by the outer weights, column by column.
    pub(super) outer: Vec<S>,
    pub(super) outer_by_outer: Vec<Vec<S>>,
}

impl<S: Real> Eliminated<S> {
    pub(super) fn new<const D: usize>(
        local: &LocalStep<'_, S, D>,
        inner: &[S],
    ) -> Result<Self, Singular> {
        let (outer, own) = (local.outer(), local.inner());
        let all = outer + own;
        let zeros = vec![S::zero(); all];
        let constant = local.pull(1, &zeros, S::one());
        let columns: Vec<Vec<S>> = (0..all)
            .map(|column| {
                let mut unit = zeros.clone();
                unit[column] = S::one();
                local.pull(1, &unit, S::zero())
            })
            .collect();
        let mut matrix = vec![S::zero(); own * own];
        for row in 0..own {
            for column in 0..own {
                matrix[row * own + column] = columns[outer + column][outer + row];
            }
        }
        let mut pivots = vec![0; own];
        lu::factor(&mut matrix, &mut pivots)?;
        let solve = |right: Vec<S>| {
            let mut right: Vec<[S; 1]> = right.into_iter().map(|entry| [entry]).collect();
            lu::solve(&matrix, &pivots, &mut right);
            right.into_iter().map(|[entry]| entry).collect::<Vec<S>>()
        };
        let open = (0..own).map(|row| inner[row] - constant[outer + row]);
        let open = solve(open.collect());
        let by_outer = (0..outer).map(|column| {
            let right = (0..own).map(|row| -columns[column][outer + row]);
            solve(right.collect())
        });
        let by_outer: Vec<Vec<S>> = by_outer.collect();
        let through = |row: usize, own_weights: &[S]| {
            let pairs = own_weights.iter().enumerate();
            pairs.fold(S::zero(), |sum, (k, &weight)| {
                sum + columns[outer + k][row] * weight
            })
        };
        let outer_constant = (0..outer).map(|row| constant[row] + through(row, &open));
        let outer_by_outer = (0..outer).map(|column| {
            let rows = (0..outer).map(|row| columns[column][row] + through(row, &by_outer[column]));
            rows.collect()
        });
        Ok(Self {
            outer: outer_constant.collect(),
            outer_by_outer: outer_by_outer.collect(),
            constant: open,
            by_outer,
        })
    }
}

/// The momentum balances of the points of one cell, by their arms.
pub(super) struct Cell<S> {
    pub(super) nodes: Vec<u32>,
    /// Row by row.
    pub(super) matrix: Vec<S>,
    pub(super) right: Vec<S>,
}

impl<S> Default for Cell<S> {
    fn default() -> Self {
        Self {
            nodes: Vec::new(),
            matrix: Vec::new(),
            right: Vec::new(),
        }
    }
}

impl<S: Real> Cell<S> {
    pub(super) fn new<const D: usize>(local: &LocalStep<'_, S, D>) -> Self {
        let arms = local.arms();
        Self {
            nodes: local.point.nodes.clone(),
            matrix: vec![S::zero(); arms * arms],
            right: vec![S::zero(); arms],
        }
    }

    pub(super) fn add(&mut self, own: &Eliminated<S>) {
        let arms = self.right.len();
        for (sum, &entry) in self.right.iter_mut().zip(&own.outer) {
            *sum += entry;
        }
        for (column, entries) in own.outer_by_outer[..arms].iter().enumerate() {
            for (row, &entry) in entries[..arms].iter().enumerate() {
                self.matrix[row * arms + column] += entry;
            }
        }
    }
}

//! The adjoint of a step of the energy–entropy–momentum forms: from the derivatives of a number by the new state to those by
//! the old state, and the weights that give its derivatives by everything else.
//!
//! A step satisfies `R(x¹, x⁰) = 0` with
//!
//! ```text
//! R_q = Δq − (h/2)(v⁰ + v¹)                        R_γ = η Δγ/h − g*
//! R_v = M Δv + h (Σ (f* + f_d) D*π − f_ext)        R_s = Δs − (h/θ*)(Σ η Δγ²/h² + Σ η_d Δπ²/h² + Σ κ (Θ_b − Θ_a) + Σ κ_r (θ_r − θ*))
//! R_Θ = Θ − θ*                                     R_σ = Δσ − (h/θ_r) Σ κ_r (θ* − θ_r)
//! R_p = θ¹ − θ_p  instead of R_s where a thermostat holds the temperature
//! ```
//!
//! With λ¹ the derivatives by x¹, `(∂R/∂x¹)ᵀ w = λ¹` and `λ⁰ = −(∂R/∂x⁰)ᵀ w`. As in a step, v¹ and the variables of a point are
//! eliminated; what remains has the pattern of the system of a step.

use crate::algebra::lu::{self, Singular};
use crate::algebra::system::LinearSystem;
use crate::element::conduction::{Conduction, Partner};
use crate::element::group::{PointStep, PointWeights};
use crate::element::layout::Layout;
use crate::element::masses::Masses;
use eem_material::number::scalar::Real;

/// The derivatives of a number by a state, or by the conditions at the start.
#[derive(Clone, Debug)]
pub(crate) struct Costate<S> {
    /// By the positions of all nodes, anchors too, and by the velocities of the masses.
    pub(crate) positions: Vec<S>,
    pub(crate) velocities: Vec<S>,
    pub(crate) viscous: Vec<S>,
    pub(crate) temperatures: Vec<S>,
    /// By the entropies that reservoirs have received.
    pub(crate) reservoirs: Vec<S>,
}

impl<S: Real> Costate<S> {
    /// Zero, for a scene with so many coordinates.
    pub(crate) fn zero(coordinates: usize, layout: &Layout, reservoirs: usize) -> Self {
        let zeros = |count| vec![S::zero(); count];
        Self {
            positions: zeros(coordinates),
            velocities: zeros(coordinates),
            viscous: zeros(layout.viscous),
            temperatures: zeros(layout.thermal),
            reservoirs: zeros(reservoirs),
        }
    }

    /// All its numbers.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = S> + '_ {
        let parts = [
            &self.positions,
            &self.velocities,
            &self.viscous,
            &self.temperatures,
            &self.reservoirs,
        ];
        parts.into_iter().flatten().copied()
    }
}

/// What does not change from step to step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place<'a, S> {
    pub(crate) layout: &'a Layout,
    pub(crate) conduction: &'a Conduction<S>,
    pub(crate) masses: &'a Masses<S>,
    /// Whether thermostats hold the temperatures, by thermal slot.
    pub(crate) held: &'a [bool],
}

/// The weights w of a step.
#[derive(Clone, Debug)]
pub(crate) struct StepWeights<S> {
    /// Of the momentum balances of all nodes, zero at anchors.
    pub(crate) motion: Vec<S>,
    /// Of the entropy balances, of the temperatures that are held, and θ*, by thermal slot.
    pub(crate) entropies: Vec<S>,
    pub(crate) held: Vec<S>,
    pub(crate) temperatures: Vec<S>,
    /// The derivatives by the positions of anchors in the old state and in the new one, zero at masses.
    pub(crate) anchors: [Vec<S>; 2],
    /// Of the points in the derivatives by their parameters.
    pub(crate) points: Vec<PointWeights<S>>,
}

/// Heat that reaches a point, and its derivatives.
struct Heat<S> {
    /// `Σ κ (Θ_b − Θ_a) + Σ κ_r (θ_r − θ*)`, W.
    received: S,
    /// `Σ κ_r` and `Σ κ`, W/K.
    to_reservoirs: S,
    to_elements: S,
    /// `Σ λ_σ h κ_r/θ_r`.
    of_reservoirs: S,
}

/// The equations of one point in a step, its own unknowns last: arms, Θ if it is coupled, then γ and θ.
struct LocalStep<'a, S, const D: usize> {
    point: &'a PointStep<S, D>,
    step: S,
    heat: Heat<S>,
    is_coupled: bool,
    is_held: bool,
}

/// Weights of the response, and of increments of measures and viscous stretches.
struct ResponseWeights<S> {
    response: Vec<S>,
    extension: Vec<S>,
    creep: Vec<S>,
}

impl<S: Real, const D: usize> LocalStep<'_, S, D> {
    /// Number of components of arms.
    fn arms(&self) -> usize {
        (self.point.nodes.len() - 1) * D
    }

    /// Arms and Θ.
    fn outer(&self) -> usize {
        self.arms() + usize::from(self.is_coupled)
    }

    fn is_thermal(&self) -> bool {
        self.point.slots.thermal.is_some()
    }

    /// γ and θ.
    fn inner(&self) -> usize {
        self.point.dashpots + usize::from(self.is_thermal())
    }

    /// `D*π_a · w` of each measure.
    fn along(&self, weights: &[S]) -> Vec<S> {
        let directions = self.point.direction.iter();
        let along = directions.map(|direction| {
            let components = direction.iter().flatten().zip(weights);
            components.fold(S::zero(), |sum, (&g, &w)| sum + g * w)
        });
        along.collect()
    }

    /// The weight of its entropy balance, or of its temperature where that is held; zero for the other one.
    fn heat_weights(&self, weights: &[S]) -> [S; 2] {
        let at = self.outer() + self.point.dashpots;
        let own = weights.get(at).copied().unwrap_or(S::zero());
        if self.is_held {
            [S::zero(), own]
        } else {
            [own, S::zero()]
        }
    }

    /// The weight of its entropy balance.
    fn entropy_weight(&self, weights: &[S]) -> S {
        self.heat_weights(weights)[0]
    }

    /// The heat of its dashpots, W, at viscosities `η` of those in series and in parallel.
    fn dissipation(&self, viscosities: &[S], drag: &[S]) -> S {
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
    fn response_weights(&self, weights: &[S], reservoirs: S) -> ResponseWeights<S> {
        let (point, h) = (self.point, self.step);
        let along = self.along(weights);
        let entropy = self.entropy_weight(weights);
        let two = S::from_f64(2.0);
        let mut response: Vec<S> = along.iter().map(|&along| h * along).collect();
        let mut extension = vec![S::zero(); point.measures];
        let mut creep = vec![S::zero(); point.dashpots];
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
        for a in 0..point.drags {
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
    fn pull(&self, end: usize, weights: &[S], reservoirs: S) -> Vec<S> {
        let (point, arms) = (self.point, self.arms());
        let by = self.response_weights(weights, reservoirs);
        let variables = point.measures + self.inner();
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
        pulled[outer..].copy_from_slice(&slopes[point.measures..]);
        if self.is_held && end == 1 {
            pulled[outer + point.dashpots] += self.heat_weights(weights)[1];
        }
        pulled
    }

    /// h/θ*, s/K.
    fn per_heat(&self) -> S {
        self.step / self.point.temperature
    }

    /// The weights in the derivatives by the parameters.
    fn parameter_weights(&self, weights: &[S]) -> PointWeights<S> {
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
        let drag = (0..point.drags).map(|a| of(along[a], point.extension[a]));
        PointWeights {
            response: by.response.iter().map(|&weight| -weight).collect(),
            viscosities: viscosities.map(|weight| -weight).collect(),
            drag: drag.map(|weight| -weight).collect(),
        }
    }
}

/// The equations of a point after its own unknowns are eliminated: what they are, given the outer weights.
struct Eliminated<S> {
    /// The own weights without outer ones, and their derivatives by the outer ones, column by column.
    constant: Vec<S>,
    by_outer: Vec<Vec<S>>,
    /// The outer rows: constant part, and derivatives by the outer weights, column by column.
    outer: Vec<S>,
    outer_by_outer: Vec<Vec<S>>,
}

impl<S: Real> Eliminated<S> {
    fn new<const D: usize>(local: &LocalStep<'_, S, D>, inner: &[S]) -> Result<Self, Singular> {
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
struct Cell<S> {
    nodes: Vec<u32>,
    /// Row by row.
    matrix: Vec<S>,
    right: Vec<S>,
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
    fn new<const D: usize>(local: &LocalStep<'_, S, D>) -> Self {
        let arms = local.arms();
        Self {
            nodes: local.point.nodes.clone(),
            matrix: vec![S::zero(); arms * arms],
            right: vec![S::zero(); arms],
        }
    }

    fn add(&mut self, own: &Eliminated<S>) {
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

impl<S: Real> Place<'_, S> {
    /// The heat of a point at temperatures θ* by thermal slot.
    fn heat(
        &self,
        slot: Option<usize>,
        step: S,
        temperatures: &[S],
        costate: &Costate<S>,
    ) -> Heat<S> {
        let mut heat = Heat {
            received: S::zero(),
            to_reservoirs: S::zero(),
            to_elements: S::zero(),
            of_reservoirs: S::zero(),
        };
        let Some(slot) = slot else {
            return heat;
        };
        for link in self.conduction.links(slot) {
            let conductance = link.conductance;
            let other = match link.partner {
                Partner::Slot(other) => {
                    heat.to_elements += conductance;
                    temperatures[other]
                }
                Partner::Reservoir(index) => {
                    let theta = self.conduction.reservoirs[index];
                    heat.to_reservoirs += conductance;
                    heat.of_reservoirs += costate.reservoirs[index] * step * conductance / theta;
                    theta
                }
            };
            heat.received += conductance * (other - temperatures[slot]);
        }
        heat
    }

    /// Solves the adjoint equations of a step for the derivatives by its new state.
    pub(crate) fn solve<const D: usize>(
        &self,
        step: S,
        points: &[PointStep<S, D>],
        new: &Costate<S>,
        system: &mut LinearSystem<S, 1>,
    ) -> Result<(Costate<S>, StepWeights<S>), Singular> {
        let mut temperatures = vec![S::one(); self.layout.thermal];
        for point in points {
            if let Some(slot) = point.slots.thermal {
                temperatures[slot] = point.temperature;
            }
        }
        let locals: Vec<LocalStep<'_, S, D>> = points
            .iter()
            .map(|point| LocalStep {
                point,
                step,
                heat: self.heat(point.slots.thermal, step, &temperatures, new),
                is_coupled: point
                    .slots
                    .thermal
                    .is_some_and(|slot| self.layout.coupled[slot].is_some()),
                is_held: point.slots.thermal.is_some_and(|slot| self.held[slot]),
            })
            .collect();
        self.begin::<D>(step, new, system);
        let mut eliminated = Vec::with_capacity(locals.len());
        let mut cell = Cell::default();
        for local in &locals {
            let own = Eliminated::new(local, &inner_of(local.point, new))?;
            if cell.nodes != local.point.nodes {
                self.add_cell::<D>(&cell, system);
                cell = Cell::new(local);
            }
            cell.add(&own);
            self.add_heat(local, &own, system);
            eliminated.push(own);
        }
        self.add_cell::<D>(&cell, system);
        system.solve()?;
        let unknown = |unknown: usize| system.solution()[unknown][0];
        let mut weights = StepWeights {
            motion: vec![S::zero(); new.positions.len()],
            entropies: vec![S::zero(); self.layout.thermal],
            held: vec![S::zero(); self.layout.thermal],
            anchors: [(); 2].map(|()| vec![S::zero(); new.positions.len()]),
            temperatures,
            points: Vec::with_capacity(points.len()),
        };
        for (node, first) in self.layout.nodes.iter().enumerate() {
            if let Some(first) = first {
                for axis in 0..D {
                    weights.motion[node * D + axis] = unknown(first + axis);
                }
            }
        }
        let mut old = self.of_motion::<D>(step, new, &weights.motion);
        for (local, own) in locals.iter().zip(&eliminated) {
            let point = local.point;
            let mut all = arms_of::<S, D>(&point.nodes, &weights.motion);
            if let Some(slot) = point.slots.thermal
                && let Some(at) = self.layout.coupled[slot]
            {
                all.push(unknown(at));
            }
            let mut inner = own.constant.clone();
            for (column, &weight) in own.by_outer.iter().zip(&all) {
                for (inner, &by) in inner.iter_mut().zip(column) {
                    *inner += by * weight;
                }
            }
            all.extend(inner);
            if let Some(slot) = point.slots.thermal {
                [weights.entropies[slot], weights.held[slot]] = local.heat_weights(&all);
            }
            self.subtract_old(local, &all, &mut old, &mut weights.anchors);
            weights.points.push(local.parameter_weights(&all));
        }
        Ok((old, weights))
    }

    /// Inertia, and the derivatives by positions and velocities.
    fn begin<const D: usize>(&self, step: S, new: &Costate<S>, system: &mut LinearSystem<S, 1>) {
        system.clear();
        let per = S::from_f64(2.0) / step;
        for (node, mass) in self.masses.iter().enumerate() {
            let (Some(mass), Some(first)) = (mass, self.layout.nodes[node]) else {
                continue;
            };
            for axis in 0..D {
                let (row, at) = (Some(first + axis), node * D + axis);
                let place = system.place(row, row);
                let (values, right) = system.parts();
                values[place] += per * mass;
                right[first + axis][0] += new.positions[at] + per * new.velocities[at];
            }
        }
        for pair in self.masses.pairs() {
            let [a, b] = pair.nodes().map(|node| self.layout.nodes[node]);
            for axis in 0..D {
                let [a, b] = [a, b].map(|first| first.map(|first| first + axis));
                let places = [system.place(a, b), system.place(b, a)];
                let (values, _) = system.parts();
                for place in places {
                    values[place] += per * pair.mass;
                }
            }
        }
    }

    /// Adds the momentum balances of a cell.
    fn add_cell<const D: usize>(&self, cell: &Cell<S>, system: &mut LinearSystem<S, 1>) {
        let (arms, all) = (cell.right.len(), cell.nodes.len() * D);
        // The first node has the negative sums of the others.
        let mut rows = vec![S::zero(); arms * all];
        for (row, entries) in cell.matrix.chunks_exact(arms.max(1)).enumerate() {
            let row = &mut rows[row * all..(row + 1) * all];
            for (column, &entry) in entries.iter().enumerate() {
                row[column % D] -= entry;
                row[column + D] = entry;
            }
        }
        let mut matrix = vec![S::zero(); all * all];
        for (row, entries) in rows.chunks_exact(all.max(1)).enumerate() {
            for (column, &entry) in entries.iter().enumerate() {
                matrix[(row % D) * all + column] -= entry;
                matrix[(row + D) * all + column] = entry;
            }
        }
        let unknown = |at: usize| {
            let first = self.layout.nodes[cell.nodes[at / D] as usize];
            first.map(|first| first + at % D)
        };
        for row in 0..all {
            let Some(own) = unknown(row) else { continue };
            let right = if let Some(arm) = row.checked_sub(D) {
                cell.right[arm]
            } else {
                let axis = cell.right.iter().skip(row).step_by(D);
                -axis.fold(S::zero(), |sum, &entry| sum + entry)
            };
            system.parts().1[own][0] -= right;
            for column in 0..all {
                if let Some(other) = unknown(column) {
                    let place = system.place(Some(own), Some(other));
                    system.parts().0[place] += matrix[row * all + column];
                }
            }
        }
    }

    /// Adds what the interface temperatures of a point and of its neighbours have to do with it.
    fn add_heat<const D: usize>(
        &self,
        local: &LocalStep<'_, S, D>,
        own: &Eliminated<S>,
        system: &mut LinearSystem<S, 1>,
    ) {
        if !local.is_coupled {
            return;
        }
        let unknowns = self.unknowns(local);
        let heat = local.arms();
        for (row, rows) in unknowns.iter().enumerate() {
            if row == heat {
                for &(unknown, _) in rows {
                    let at = system.row(unknown);
                    system.parts().1[at][0] -= own.outer[row];
                }
            }
            for (column, columns) in unknowns.iter().enumerate() {
                if row != heat && column != heat {
                    continue;
                }
                let entry = own.outer_by_outer[column][row];
                for &(unknown, sign) in rows {
                    for &(other, other_sign) in columns {
                        let place = system.place(unknown, other);
                        system.parts().0[place] += sign * other_sign * entry;
                    }
                }
            }
        }
        if local.is_held {
            return;
        }
        let Some(slot) = local.point.slots.thermal else {
            return;
        };
        let entropy = local.point.dashpots;
        for link in self.conduction.links(slot) {
            let Partner::Slot(other) = link.partner else {
                continue;
            };
            let row = self.layout.coupled[other];
            let factor = -local.per_heat() * link.conductance;
            let at = system.row(row);
            system.parts().1[at][0] -= factor * own.constant[entropy];
            for (column, columns) in unknowns.iter().enumerate() {
                for &(unknown, sign) in columns {
                    let place = system.place(row, unknown);
                    system.parts().0[place] += factor * sign * own.by_outer[column][entropy];
                }
            }
        }
    }

    /// The unknowns of the outer variables of a point, with their signs.
    fn unknowns<const D: usize>(
        &self,
        local: &LocalStep<'_, S, D>,
    ) -> Vec<Vec<(Option<usize>, S)>> {
        let nodes = &local.point.nodes;
        let at = |node: u32, axis: usize| {
            let first = self.layout.nodes[node as usize];
            first.map(|first| first + axis)
        };
        let mut unknowns = Vec::with_capacity(local.outer());
        for &node in &nodes[1..] {
            for axis in 0..D {
                unknowns.push(vec![
                    (at(node, axis), S::one()),
                    (at(nodes[0], axis), -S::one()),
                ]);
            }
        }
        if let Some(slot) = local.point.slots.thermal
            && let Some(unknown) = self.layout.coupled[slot]
        {
            unknowns.push(vec![(Some(unknown), S::one())]);
        }
        for all in &mut unknowns {
            all.retain(|(unknown, _)| unknown.is_some());
        }
        unknowns
    }

    /// `λ_q⁰ = w_q = (2/h)(M w_v − λ_v)` and `λ_v⁰ = 2M w_v − λ_v` of the masses; anchors keep their sums.
    fn of_motion<const D: usize>(&self, step: S, new: &Costate<S>, motion: &[S]) -> Costate<S> {
        let mut old = Costate::zero(motion.len(), self.layout, new.reservoirs.len());
        old.reservoirs.copy_from_slice(&new.reservoirs);
        let mut inertia = vec![S::zero(); motion.len()];
        self.masses.find_momenta(D, motion, &mut inertia);
        let two = S::from_f64(2.0);
        for (node, mass) in self.masses.iter().enumerate() {
            for at in (0..D).map(|axis| node * D + axis) {
                if mass.is_none() {
                    old.positions[at] = new.positions[at];
                    continue;
                }
                old.positions[at] = two / step * (inertia[at] - new.velocities[at]);
                old.velocities[at] = two * inertia[at] - new.velocities[at];
            }
        }
        old
    }

    /// Subtracts `(∂R/∂x⁰)ᵀ w` of a point, and at anchors, which are the same in both states, `(∂R/∂x¹)ᵀ w` too.
    fn subtract_old<const D: usize>(
        &self,
        local: &LocalStep<'_, S, D>,
        weights: &[S],
        old: &mut Costate<S>,
        anchors: &mut [Vec<S>; 2],
    ) {
        let (point, arms, outer) = (local.point, local.arms(), local.outer());
        let [by_old, by_new] = [0, 1].map(|end| local.pull(end, weights, S::one()));
        let nodes = point.nodes.iter();
        for (place, &node) in nodes.enumerate() {
            let node = node as usize;
            let is_anchor = self.layout.nodes[node].is_none();
            for axis in 0..D {
                let of = |pulled: &[S]| match place {
                    0 => {
                        let own = pulled[..arms].iter().skip(axis).step_by(D);
                        own.fold(S::zero(), |sum, &entry| sum - entry)
                    }
                    _ => pulled[(place - 1) * D + axis],
                };
                let at = node * D + axis;
                old.positions[at] -= of(&by_old);
                if is_anchor {
                    old.positions[at] -= of(&by_new);
                    anchors[0][at] -= of(&by_old);
                    anchors[1][at] -= of(&by_new);
                }
            }
        }
        for k in 0..point.dashpots {
            old.viscous[point.slots.viscous + k] -= by_old[outer + k];
        }
        if let Some(slot) = point.slots.thermal {
            old.temperatures[slot] -= by_old[outer + point.dashpots];
        }
    }
}

/// The derivatives by γ and θ of a point.
fn inner_of<S: Real, const D: usize>(point: &PointStep<S, D>, costate: &Costate<S>) -> Vec<S> {
    let first = point.slots.viscous;
    let mut inner = costate.viscous[first..first + point.dashpots].to_vec();
    inner.extend(point.slots.thermal.map(|slot| costate.temperatures[slot]));
    inner
}

/// The arms of a point in a list of vectors of nodes.
fn arms_of<S: Real, const D: usize>(nodes: &[u32], vectors: &[S]) -> Vec<S> {
    let at = |node: u32, axis: usize| vectors[node as usize * D + axis];
    let others = nodes[1..].iter();
    let arms = others.flat_map(|&node| (0..D).map(move |axis| at(node, axis) - at(nodes[0], axis)));
    arms.collect()
}

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

mod local;

use crate::algebra::lu::Singular;
use crate::algebra::system::LinearSystem;
use crate::element::conduction::{Conduction, Partner};
use crate::element::group::{PointStep, PointWeights};
use crate::element::layout::Layout;
use crate::element::masses::Masses;
use eem_material::number::scalar::Real;
use local::{Cell, Eliminated, Heat, LocalStep};

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
        let entropy = local.point.dashpots();
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
        for k in 0..point.dashpots() {
            old.viscous[point.slots.viscous + k] -= by_old[outer + k];
        }
        if let Some(slot) = point.slots.thermal {
            old.temperatures[slot] -= by_old[outer + point.dashpots()];
        }
    }
}

/// The derivatives by γ and θ of a point.
fn inner_of<S: Real, const D: usize>(point: &PointStep<S, D>, costate: &Costate<S>) -> Vec<S> {
    let first = point.slots.viscous;
    let mut inner = costate.viscous[first..first + point.dashpots()].to_vec();
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

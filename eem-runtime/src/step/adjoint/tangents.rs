//! The tangents of a step: changes of its new state by changes of the old one and of inputs, in several directions.
//!
//! `(∂R/∂x¹) dx¹ = −(∂R/∂x⁰) dx⁰ − (∂R/∂μ) dμ` with the equations R of `adjoint.rs`. The unknowns are the changes of positions
//! beyond those of the old state, and the changes of interface temperatures; there is one elimination for all directions.

use crate::algebra::system::LinearSystem;
use crate::element::conduction::{Conduction, Partner};
use crate::element::group::{Direction, Group, PastStep, PerVariable};
use crate::element::layout::Layout;
use crate::element::masses::Masses;
use crate::step::adjoint::equations::{Equations, NoAdjoint};
use crate::step::adjoint::rockets::RocketStep;

/// Computes the tangents of one step after the other, with a workspace for all of them.
#[derive(Debug)]
pub(crate) struct Tangents<const D: usize> {
    equations: Equations,
    /// θ*, by thermal slot.
    temperatures: Vec<f64>,
    /// The slot at which each path of heat begins, and its partner.
    paths: Vec<(usize, Partner)>,
    /// `M` times velocities.
    velocities: Vec<f64>,
    momenta: Vec<f64>,
    rows: usize,
}

/// The changes of conductances of all paths, and of temperatures of all reservoirs; empty where none changes.
#[derive(Clone, Debug)]
pub(crate) struct HeatChange {
    pub(crate) conductances: Vec<f64>,
    pub(crate) reservoirs: Vec<f64>,
}

impl<const D: usize> Tangents<D> {
    pub(crate) fn new(
        layout: &Layout,
        masses: &Masses,
        conduction: &Conduction,
        system: &LinearSystem<1>,
    ) -> Self {
        let zeros = |count| vec![0.0; count];
        Self {
            equations: Equations::new(D, layout, masses, system),
            temperatures: vec![1.0; layout.thermal],
            paths: conduction.path_ends(),
            velocities: zeros(masses.len() * D),
            momenta: zeros(masses.len() * D),
            rows: system.right().len(),
        }
    }

    /// A direction that begins with a change of the state.
    pub(crate) fn direction(
        &self,
        start: PerVariable,
        parameters: Vec<Vec<f64>>,
        has_heat: bool,
    ) -> Direction {
        let slots = self.temperatures.len();
        Direction {
            old: start.clone(),
            new: start,
            middle: vec![0.0; slots],
            parameters,
            heat: vec![[0.0; 2]; if has_heat { slots } else { 0 }],
            right: vec![[0.0]; self.rows],
        }
    }

    /// Finds the changes of the new state of a step from those of the old one. The caller has set, in the new state,
    /// positions and velocities of anchors and prescribed temperatures, and in the right-hand side, the effect of changed
    /// masses and loads.
    pub(crate) fn step_forward(
        &mut self,
        past: &PastStep<'_>,
        (layout, rockets): (&Layout, &[RocketStep<D>]),
        groups: &mut [Box<dyn Group<D>>],
        system: &mut LinearSystem<1>,
        (directions, heats): (&mut [Direction], &[HeatChange]),
    ) -> Result<(), NoAdjoint> {
        let view = &past.view;
        self.equations.find_interfaces(past, groups)?;
        for (direction, of) in directions.iter_mut().zip(heats) {
            self.conduct(view.conduction, of, direction);
            self.push_inertia(view.masses, direction);
        }
        system.clear();
        self.equations.add_inertia(view.step, system);
        for group in &mut *groups {
            let temperatures = (&self.equations.interface, &mut self.temperatures[..]);
            group.push_forward(past, temperatures, system, directions)?;
        }
        for rocket in rockets {
            rocket.add_to(layout, false, system);
            for direction in &mut *directions {
                rocket.push(layout, direction);
            }
        }
        let columns = directions.iter_mut().map(|direction| &mut direction.right);
        system.solve_each(columns)?;
        let per = 2.0 / view.step;
        for direction in &mut *directions {
            let Direction {
                old, new, right, ..
            } = direction;
            // q¹ and v¹ = (2/h) Δq − v⁰ of masses.
            for of in &self.equations.moving {
                let (at, moved) = (of.coordinate, right[of.unknown][0]);
                new.positions[at] = old.positions[at] + moved;
                new.velocities[at] = per * moved - old.velocities[at];
            }
        }
        for group in &*groups {
            group.follow(directions);
        }
        for (direction, of) in directions.iter_mut().zip(heats) {
            self.book(view.step, view.conduction, of, direction);
        }
        Ok(())
    }

    /// Finds the change of heat by changes of conductances and reservoirs, at fixed temperatures of elements.
    fn conduct(&self, conduction: &Conduction, of: &HeatChange, direction: &mut Direction) {
        if direction.heat.is_empty() {
            return;
        }
        direction.heat.fill([0.0; 2]);
        for (&by, &(slot, partner)) in of.conductances.iter().zip(&self.paths) {
            match partner {
                Partner::Slot(other) => {
                    let flow = by * self.equations.interface.drop(slot, other);
                    direction.heat[slot][0] += flow;
                    direction.heat[other][0] -= flow;
                }
                Partner::Reservoir(at) => {
                    direction.heat[slot][0] += by * conduction.reservoirs[at];
                    direction.heat[slot][1] += by;
                }
            }
        }
        for (slot, heat) in direction.heat.iter_mut().enumerate() {
            for link in conduction.links(slot) {
                if let Partner::Reservoir(at) = link.partner {
                    let warmer = of.reservoirs.get(at).copied();
                    heat[0] += link.conductance * warmer.unwrap_or(0.0);
                }
            }
        }
    }

    /// Adds the known terms of `M Δv = (2/h) M Δq − 2 M v⁰` to the right-hand side; the velocities of anchors are given.
    fn push_inertia(&mut self, masses: &Masses, direction: &mut Direction) {
        let Direction {
            old, new, right, ..
        } = direction;
        let [v0, v1] = [&old.velocities, &new.velocities];
        if !masses.are_coupled() {
            for of in &self.equations.moving {
                let speed = v0[of.coordinate];
                right[of.unknown][0] += of.mass * (speed + speed);
            }
            return;
        }
        for (node, mass) in masses.iter().enumerate() {
            for at in (node * D..).take(D) {
                let rest = if mass.is_some() { -v0[at] } else { v1[at] };
                self.velocities[at] = v0[at] - rest;
            }
        }
        masses.find_momenta(D, &self.velocities, &mut self.momenta);
        for of in &self.equations.moving {
            right[of.unknown][0] += self.momenta[of.coordinate];
        }
    }

    /// Adds the changes of the entropies of reservoirs, `Δσ = (h/θ_r) Σ κ (θ* − θ_r)`.
    fn book(&self, step: f64, conduction: &Conduction, of: &HeatChange, direction: &mut Direction) {
        for (slot, &theta) in self.temperatures.iter().enumerate() {
            for link in conduction.links(slot) {
                if let Partner::Reservoir(at) = link.partner {
                    let outer = conduction.reservoirs[at];
                    let warmer = of.reservoirs.get(at).copied().unwrap_or(0.0);
                    let change = direction.middle[slot] - warmer * (theta / outer);
                    direction.new.reservoirs[at] += step * link.conductance * change / outer;
                }
            }
        }
        for (&by, &(slot, partner)) in of.conductances.iter().zip(&self.paths) {
            if let Partner::Reservoir(at) = partner {
                let outer = conduction.reservoirs[at];
                let drop = self.temperatures[slot] - outer;
                direction.new.reservoirs[at] += step * by * drop / outer;
            }
        }
    }
}

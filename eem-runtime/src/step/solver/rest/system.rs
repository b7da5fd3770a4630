//! The system of an iteration for a state at rest, and its updates.

use core::array;
use eem_material::number::scalar::Scalar;

use super::{AtRest, LONG, Place};
use crate::algebra::vector;
use crate::element::tally::Care;
use crate::step::error::StepFailure;

/// An update is shortened if the force along it is, at its end, backwards and above this fraction of that at its start.
const OVERSHOOT: f64 = 0.8;

/// The smallest part of an update that is tried.
const LEAST_PART: f64 = 1.0 / 1024.0;

/// No update turns or stretches an element by more than this share of its arms: so states of another branch are not reached
/// by a jump.
const LARGEST_TURN: f64 = 0.5;

/// Roundings of the entries of an element, as in the certificate of a step.
pub(super) const ROUNDINGS: f64 = 64.0;

/// Iterations for a step against friction after the first one. Each squares the relative error of lengths.
const SETTLING: usize = 6;

/// Where an update begins.
pub(super) struct Begin<const D: usize> {
    pub(super) place: Place<D>,
    /// R, N, and D per moving node, N/m.
    forces: Vec<f64>,
    sizes: Vec<f64>,
}

/// An update, as far as it was applied.
pub(super) struct Update<const D: usize> {
    pub(super) begin: Begin<D>,
    /// The largest change, in lengths of elements.
    pub(super) size: f64,
    pub(super) is_definite: bool,
    /// The part that was applied.
    pub(super) part: f64,
    /// Norms of R before and after, N.
    pub(super) before: f64,
    pub(super) after: f64,
    /// R along the update at its end, relative to that at its start.
    pub(super) left: f64,
}

impl<const D: usize> Update<D> {
    /// Whether the force along it at its end points backwards and exceeds [`OVERSHOOT`].
    pub(super) fn goes_too_far(&self) -> bool {
        self.left < -OVERSHOOT
    }
}

pub(super) fn norm(vector: &[f64]) -> f64 {
    vector
        .iter()
        .fold(0.0, |norm, &entry| Scalar::hypot(entry, norm))
}

pub(super) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

impl<const D: usize> AtRest<'_, D> {
    /// Builds the system at the trial.
    pub(super) fn renew(&mut self) -> Result<(), StepFailure> {
        self.solver.balance(self.view);
        self.assemble()
    }

    /// Evaluates the elements at a trial whose system has been started.
    pub(super) fn assemble(&mut self) -> Result<(), StepFailure> {
        self.solver.evaluate(self.groups, self.view, true)?;
        let (values, right) = self.solver.tangent.parts();
        let left = 1.0 - self.share;
        self.sizes.clear();
        for (at, node) in self.solver.nodes.iter().enumerate() {
            let first = self.first.get(at * D..).unwrap_or_default();
            for (force, first) in node.place.rows_mut(right).iter_mut().zip(first) {
                *force -= left * first;
            }
            let diagonal = node.place.diagonal().into_iter();
            let size = diagonal.fold(0.0_f64, |size, place| size.max(values[place].abs()));
            self.sizes.push(size);
        }
        // Nodes without stiffness, or only with that of viscous forces, η/h.
        let least = LONG.sqrt();
        let sizes = self.sizes.iter();
        let largest = sizes.fold(0.0_f64, |most, &size| most.max(size));
        let unit = if largest > least { largest } else { LONG };
        for size in self.sizes.iter_mut().filter(|size| **size <= least) {
            *size = unit;
        }
        if self.is_by_mass {
            self.weigh();
        }
        Ok(())
    }

    /// Makes D proportional to the masses, and nowhere smaller.
    fn weigh(&mut self) {
        let nodes = self.solver.nodes.iter().map(|node| node.place.node());
        let masses: Vec<f64> = nodes
            .filter_map(|node| self.view.masses.get(node))
            .collect();
        let sizes = self.sizes.iter().zip(&masses);
        let most = sizes.fold(0.0, |most, (size, mass)| Scalar::maximum(most, size / mass));
        for (size, mass) in self.sizes.iter_mut().zip(masses) {
            *size = most * mass;
        }
    }

    /// Adds a shift, in units of D, to K.
    pub(super) fn shift(&mut self, shift: f64) {
        let (values, _) = self.solver.tangent.parts();
        for (node, size) in self.solver.nodes.iter().zip(&self.sizes) {
            for place in node.place.diagonal() {
                values[place] += shift * size;
            }
        }
    }

    /// The largest coordinate, m.
    pub(super) fn extent(&self) -> f64 {
        let positions = self.view.state.positions.values();
        let moved = self.solver.trial.displacements.as_flattened();
        let all = positions.iter().zip(moved);
        all.fold(0.0, |most, (q, moved)| most.max((q + moved).abs()))
    }

    /// Whether the rounding of forces and of their arguments explains R: by node, with the terms of the forces of its
    /// elements as in the certificate of a step, of its loads, and of what is left of R(q⁰).
    pub(super) fn is_balanced(&mut self) -> bool {
        (self.solver).find_motion(self.groups, self.view, Care::Thorough);
        let left = 1.0 - self.share;
        let right = self.solver.tangent.right();
        let mut nodes = self.solver.nodes.iter().enumerate();
        nodes.all(|(at, node)| {
            let (place, first) = (&node.place, self.first.get(at * D..).unwrap_or_default());
            let loads = self.view.loads.total_force::<D>(place.node());
            let magnitude = self.solver.magnitudes[place.node()];
            (place.rows(right).iter().enumerate()).all(|(axis, force)| {
                let first = first.get(axis).map_or(0.0, |first| left * first.abs());
                let terms = magnitude + LONG * loads[axis].abs() + first;
                force.abs() <= ROUNDINGS * f64::EPSILON * terms
            })
        })
    }

    /// R, N.
    pub(crate) fn forces(&self) -> Vec<f64> {
        let nodes = self.solver.nodes.iter();
        nodes
            .flat_map(|node| *node.place.rows(self.solver.tangent.right()))
            .collect()
    }

    /// The last update, m.
    pub(super) fn solution(&self) -> Vec<f64> {
        let nodes = self.solver.nodes.iter();
        nodes
            .flat_map(|node| *node.place.rows(self.solver.tangent.solution()))
            .collect()
    }

    /// Replaces R.
    pub(super) fn set_right(&mut self, forces: &[f64]) {
        let (_, right) = self.solver.tangent.parts();
        for (node, force) in self.solver.nodes.iter().zip(forces.as_chunks::<D>().0) {
            *node.place.rows_mut(right) = *force;
        }
    }

    /// Solves the system with friction. Returns whether it is definite, which is not asked of one that is not symmetric.
    fn solve(&mut self, friction: f64) -> Result<bool, StepFailure> {
        self.shift(friction);
        let is_symmetric = self.solver.rockets.are_none();
        let is_definite = self.solver.tangent.solve_and_judge();
        Ok(is_definite.map_err(|_| StepFailure::SingularTangent)? || !is_symmetric)
    }

    /// An update with friction, or by Newton's method without. It is applied as far as elements are admissible and,
    /// without friction, forces along it do not turn round. After an error nothing is applied; if the tangent is
    /// singular, the system has to be built again.
    pub(super) fn update(&mut self, friction: f64) -> Result<Update<D>, StepFailure> {
        let begin = Begin {
            place: self.place(),
            forces: self.forces(),
            sizes: self.sizes.clone(),
        };
        let is_definite = self.solve(friction)?;
        let size = self.solver.correct(self.groups, self.view);
        let change = self.solution();
        if !size.is_finite() {
            // An update that is not finite cannot be taken back.
            self.start(Some(&begin.place))?;
            return Err(StepFailure::NotConverged { update: size });
        }
        if self.turn(&begin.place) > LARGEST_TURN {
            self.take_back(1.0, 0.0);
            self.assemble()?;
            return Err(StepFailure::NotConverged { update: size });
        }
        let slope = dot(&begin.forces, &change);
        let mut part = 1.0;
        loop {
            let next = match self.assemble() {
                Ok(()) => {
                    let now = dot(&self.forces(), &change);
                    let turns = slope > 0.0 && now < -OVERSHOOT * slope;
                    // Forces that are rounding have any direction.
                    if friction > 0.0 || !turns || part < LEAST_PART || self.is_balanced() {
                        break;
                    }
                    (part * slope / (slope - now)).clamp(0.1 * part, 0.5 * part)
                }
                Err(failure) if part < LEAST_PART => {
                    self.take_back(part, 0.0);
                    self.assemble()?;
                    return Err(failure);
                }
                Err(_) => 0.5 * part,
            };
            self.take_back(part, next);
            part = next;
        }
        let after = self.forces();
        Ok(Update {
            size,
            is_definite,
            part,
            before: norm(&begin.forces),
            after: norm(&after),
            left: if slope > 0.0 {
                dot(&after, &change) / slope
            } else {
                0.0
            },
            begin,
        })
    }

    /// Goes on with the iterations of a step against friction whose first one goes too far, `R(q) = μ D (q − q_n)`, until the
    /// force along the step does not turn round. Returns whether that was found.
    pub(super) fn settle(&mut self, friction: f64, update: &mut Update<D>) -> bool {
        let begin = &update.begin;
        for _ in 0..SETTLING {
            let (mut right, way) = (self.forces(), self.way_from(&begin.place));
            let sizes = begin.sizes.iter().flat_map(|&size| [size; D]);
            for (force, (way, size)) in right.iter_mut().zip(way.iter().zip(sizes)) {
                *force -= friction * size * way;
            }
            self.set_right(&right);
            self.sizes.clone_from(&begin.sizes);
            if self.solve(friction) != Ok(true)
                || !self.solver.correct(self.groups, self.view).is_finite()
                || self.turn(&begin.place) > LARGEST_TURN
                || self.assemble().is_err()
            {
                return false;
            }
            let (way, after) = (self.way_from(&begin.place), self.forces());
            let slope = dot(&begin.forces, &way);
            if !(slope > 0.0) {
                return false;
            }
            update.left = dot(&after, &way) / slope;
            update.after = norm(&after);
            if !update.goes_too_far() {
                return true;
            }
        }
        false
    }

    /// The displacements of moving nodes from a place, m.
    fn way_from(&self, (from, _): &Place<D>) -> Vec<f64> {
        let now = &self.solver.trial.displacements;
        let nodes = self.solver.nodes.iter().map(|node| node.place.node());
        let ways =
            nodes.map(|node| array::from_fn::<_, D, _>(|axis| now[node][axis] - from[node][axis]));
        ways.flatten().collect()
    }

    /// The largest motion of an arm since it was at a place, in lengths of the arm there.
    pub(super) fn turn(&self, (from, _): &Place<D>) -> f64 {
        let now = &self.solver.trial.displacements;
        let moved: Vec<[f64; D]> = now
            .iter()
            .zip(from)
            .map(|(now, from)| vector(|axis| now[axis] - from[axis]))
            .collect();
        let turns = self.arms.iter().map(|ends| {
            let [from, to] = ends.map(|end| self.position(end));
            let by: [f64; D] = vector(|axis| moved[ends[1]][axis] - moved[ends[0]][axis]);
            let before: [f64; D] = vector(|axis| (to[axis] - from[axis]) - by[axis]);
            norm(&by) / norm(&before)
        });
        turns.fold(0.0, f64::max)
    }

    /// Reduces the part of the last update that is applied, and starts the next system.
    pub(super) fn take_back(&mut self, part: f64, next: f64) {
        self.solver.take_back(self.view, part - next);
        for group in &mut *self.groups {
            group.apply(next);
        }
    }
}

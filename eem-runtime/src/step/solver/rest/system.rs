//! The system of an iteration for a state at rest, and its updates.

use eem_material::number::scalar::Scalar;

use super::{AtRest, LONG, Place};
use crate::algebra::{dot, hypot, largest};
use crate::scene::loads::extent;
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
pub(super) struct Begin {
    pub(super) place: Place,
    /// R, N, and D per moving node, N/m.
    forces: Vec<f64>,
    sizes: Vec<f64>,
}

/// An update, as far as it was applied.
pub(super) struct Update {
    pub(super) begin: Begin,
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

impl Update {
    /// Whether the force along it at its end points backwards and exceeds [`OVERSHOOT`].
    pub(super) fn goes_too_far(&self) -> bool {
        self.left < -OVERSHOOT
    }
}

/// Replaces the sizes of nodes without stiffness, or only with that of viscous forces, η/h.
fn fill_sizes(sizes: &mut [f64]) {
    let (least, most) = (LONG.sqrt(), largest(sizes));
    let unit = if most > least { most } else { LONG };
    for size in sizes.iter_mut().filter(|size| **size <= least) {
        *size = unit;
    }
}

/// The largest change of an arm by displacements, m, in units of its length before, given all coordinates now.
fn largest_turn(dimension: usize, arms: &[[usize; 2]], places: &[f64], moved: &[f64]) -> f64 {
    let mut largest = 0.0_f64;
    for &[from, to] in arms {
        let (mut change, mut before) = (0.0, 0.0);
        for axis in 0..dimension {
            let [from, to] = [from * dimension + axis, to * dimension + axis];
            let by = moved[to] - moved[from];
            change = Scalar::hypot(by, change);
            before = Scalar::hypot((places[to] - places[from]) - by, before);
        }
        largest = largest.max(change / before);
    }
    largest
}

impl AtRest<'_> {
    /// Builds the system at the trial.
    pub(super) fn renew(&mut self) -> Result<(), StepFailure> {
        self.search.balance();
        self.assemble()
    }

    /// Evaluates the elements at a trial whose system has been started.
    pub(super) fn assemble(&mut self) -> Result<(), StepFailure> {
        self.search.evaluate()?;
        let (values, right) = self.search.tangent_mut().parts();
        let left = 1.0 - self.share;
        for (force, first) in right.as_flattened_mut().iter_mut().zip(&self.first) {
            *force -= left * first;
        }
        self.sizes.clear();
        for node in &self.nodes {
            let sizes = node.diagonal.iter();
            let sizes = sizes.map(|&place| values[place as usize].abs());
            self.sizes.push(sizes.fold(0.0, f64::max));
        }
        fill_sizes(&mut self.sizes);
        if self.is_by_mass {
            self.weigh();
        }
        Ok(())
    }

    /// Makes D proportional to the masses, and nowhere smaller.
    fn weigh(&mut self) {
        let mut most = 0.0;
        for (size, node) in self.sizes.iter().zip(&self.nodes) {
            most = Scalar::maximum(most, size / node.mass);
        }
        for (size, node) in self.sizes.iter_mut().zip(&self.nodes) {
            *size = most * node.mass;
        }
    }

    /// Adds a shift, in units of D, to K.
    pub(super) fn shift(&mut self, shift: f64) {
        let (values, _) = self.search.tangent_mut().parts();
        for (node, size) in self.nodes.iter().zip(&self.sizes) {
            for &place in &node.diagonal {
                values[place as usize] += shift * size;
            }
        }
    }

    /// The largest coordinate, m.
    pub(super) fn extent(&self) -> f64 {
        extent(&self.positions())
    }

    /// Whether the rounding of forces and of their arguments explains R: by node, with the terms of the forces of its
    /// elements as in the certificate of a step, of its loads, and of what is left of R(q⁰).
    pub(super) fn is_balanced(&mut self) -> bool {
        let (forces, left) = (self.forces(), 1.0 - self.share);
        let magnitudes = self.search.magnitudes();
        for (row, force) in forces.iter().enumerate() {
            let node = self.nodes[row / self.dimension].node;
            let first = self.first.get(row).map_or(0.0, |first| left * first.abs());
            let place = node * self.dimension + row % self.dimension;
            let load = self.view.loads.total_force.get(place);
            let load = load.map_or(0.0, |load| LONG * load.abs());
            let terms = magnitudes[node] + load + first;
            if !(force.abs() <= ROUNDINGS * f64::EPSILON * terms) {
                return false;
            }
        }
        true
    }

    /// The number of rows of moving nodes, the first ones of the system.
    fn rows(&self) -> usize {
        self.nodes.len() * self.dimension
    }

    /// R, N.
    pub(crate) fn forces(&self) -> Vec<f64> {
        self.search.tangent().right().as_flattened()[..self.rows()].to_vec()
    }

    /// The last update, m.
    pub(super) fn solution(&self) -> Vec<f64> {
        self.search.tangent().solution().as_flattened()[..self.rows()].to_vec()
    }

    /// Replaces R.
    pub(super) fn set_right(&mut self, forces: &[f64]) {
        let rows = self.rows();
        let (_, right) = self.search.tangent_mut().parts();
        right.as_flattened_mut()[..rows].copy_from_slice(forces);
    }

    /// Solves the system with friction. Returns whether it is definite, which is not asked of one that is not symmetric.
    fn solve(&mut self, friction: f64) -> Result<bool, StepFailure> {
        self.shift(friction);
        let is_symmetric = self.search.is_symmetric();
        Ok(self.search.tangent_mut().solve_and_judge()? || !is_symmetric)
    }

    /// An update with friction, or by Newton's method without. It is applied as far as elements are admissible and,
    /// without friction, forces along it do not turn round. After an error nothing is applied; if the tangent is
    /// singular, the system has to be built again.
    pub(super) fn update(&mut self, friction: f64) -> Result<Update, StepFailure> {
        let begin = Begin {
            place: self.place(),
            forces: self.forces(),
            sizes: self.sizes.clone(),
        };
        let is_definite = self.solve(friction)?;
        let size = self.search.correct();
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
        let left = dot(&after, &change) / slope;
        let left = if slope > 0.0 { left } else { 0.0 };
        Ok(Update {
            size,
            is_definite,
            part,
            before: hypot(&begin.forces),
            after: hypot(&after),
            left,
            begin,
        })
    }

    /// Goes on with the iterations of a step against friction whose first one goes too far, `R(q) = μ D (q − q_n)`, until the
    /// force along the step does not turn round. Returns whether that was found.
    pub(super) fn settle(&mut self, friction: f64, update: &mut Update) -> bool {
        let begin = &update.begin;
        for _ in 0..SETTLING {
            let (mut right, way) = (self.forces(), self.way_from(&begin.place));
            for (row, (force, way)) in right.iter_mut().zip(&way).enumerate() {
                *force -= friction * begin.sizes[row / self.dimension] * way;
            }
            self.set_right(&right);
            self.sizes.clone_from(&begin.sizes);
            if self.solve(friction) != Ok(true)
                || !self.search.correct().is_finite()
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
            update.after = hypot(&after);
            if !update.goes_too_far() {
                return true;
            }
        }
        false
    }

    /// The displacements of moving nodes from a place, m.
    fn way_from(&self, from: &Place) -> Vec<f64> {
        let all = self.moved_from(from);
        let mut moved = Vec::with_capacity(self.first.len());
        for node in &self.nodes {
            let first = node.node * self.dimension;
            moved.extend_from_slice(&all[first..first + self.dimension]);
        }
        moved
    }

    /// The displacements of all nodes from a place, m.
    fn moved_from(&self, [from, _]: &Place) -> Vec<f64> {
        let [now, _] = self.search.place();
        now.iter().zip(from).map(|(now, from)| now - from).collect()
    }

    /// The largest motion of an arm since it was at a place, in lengths of the arm there.
    pub(super) fn turn(&self, from: &Place) -> f64 {
        largest_turn(
            self.dimension,
            &self.arms,
            &self.positions(),
            &self.moved_from(from),
        )
    }

    /// Reduces the part of the last update that is applied, and starts the next system.
    pub(super) fn take_back(&mut self, part: f64, next: f64) {
        self.search.take_back(part, next);
    }
}

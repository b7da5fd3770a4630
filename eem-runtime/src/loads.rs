//! What acts on a scene from outside: forces, moved anchors, prescribed temperatures.
//!
//! The forces of a step are constant over it, so that their work `F·Δq` is exact; a moved anchor
//! does the work of the force it needs; a thermostat gives the heat that its element needs. A scheme with
//! stages evaluates them at the time of each, as steps of no length.

use std::collections::BTreeSet;

use nalgebra::SVector;

use crate::error::StepFailure;
use crate::handle::{Element, Node};
use crate::layout::Layout;
use crate::masses::Masses;
use crate::scalar::{Mask, Real, is_positive};
use crate::scheme::Scheme;

/// By how many ε of its size a prescribed function may differ from a state that follows it: a
/// formula `c + a f(t)` rounds function, product and sum, each by ε at most of a size that is also
/// that of the result or of the scene; a fourth ε is for the state, whose value is itself rounded.
///
/// In a step, `q⁰ + (x(t) − q⁰)` differs from `x(t)` by less: half an ε for each of the two sums, of
/// at most twice the size, and half an ε for what was carried over.
pub(crate) const MOTION_ROUNDINGS: f64 = 4.0;

/// The largest magnitude of some coordinates, m.
///
/// Motions are judged in this unit and not in that of their own coordinates: elements see
/// differences of positions, which have the rounding of the largest ones.
pub(crate) fn extent<'a, S: Real>(coordinates: impl Iterator<Item = &'a S>) -> S {
    coordinates.fold(S::zero(), |most, coordinate| most.maximum(coordinate.abs()))
}

/// A vector (force in N, position in m) as a function of time in s.
pub(crate) type OfTime<S, const D: usize> = Box<dyn Fn(S) -> SVector<S, D> + Send + Sync>;

/// A temperature in K as a function of time in s.
pub(crate) type TemperatureOfTime<S> = Box<dyn Fn(S) -> S + Send + Sync>;

/// Everything that acts on a scene, as the user gave it.
pub(crate) struct Loads<S: Real, const D: usize> {
    /// Acceleration of free fall, m/s².
    pub(crate) gravity: SVector<S, D>,
    pub(crate) forces: Vec<(Node, OfTime<S, D>)>,
    pub(crate) motions: Vec<(Node, OfTime<S, D>)>,
    pub(crate) temperatures: Vec<(Element, TemperatureOfTime<S>)>,
}

impl<S: Real, const D: usize> Loads<S, D> {
    /// Nothing acts.
    pub(crate) fn none() -> Self {
        Self {
            gravity: SVector::from_element(S::zero()),
            forces: Vec::new(),
            motions: Vec::new(),
            temperatures: Vec::new(),
        }
    }

    pub(crate) fn are_none(&self) -> bool {
        let has_force = self.have_weight() || !self.forces.is_empty();
        !has_force && self.motions.is_empty() && self.temperatures.is_empty()
    }

    fn have_weight(&self) -> bool {
        self.has_weight().any()
    }

    fn has_weight(&self) -> S::Mask {
        let none = S::Mask::none();
        let components = self.gravity.iter();
        components.fold(none, |any, &component| any | !component.equal(S::zero()))
    }

    /// Whether several numbers in one S have weight all of them, or none of them.
    pub(crate) fn suit_lanes(&self) -> bool {
        let has_weight = self.has_weight();
        has_weight.decide().is_ok()
    }
}

impl<S: Real, const D: usize> core::fmt::Debug for Loads<S, D> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Loads")
            .field("gravity", &self.gravity)
            .field("forces", &self.forces.len())
            .field("motions", &self.motions.len())
            .field("temperatures", &self.temperatures.len())
            .finish()
    }
}

/// A prescribed temperature during one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prescribed<S> {
    /// In the middle of the step, K.
    pub(crate) middle: S,
    /// At its end, K.
    pub(crate) end: S,
}

/// What acts during one step. There is no memory for kinds of loads that the scene does not have.
#[derive(Clone, Debug)]
pub(crate) struct StepLoads<S> {
    /// Loads that do work, per coordinate, N.
    force: Vec<S>,
    /// Loads and weight, per coordinate, N.
    total_force: Vec<S>,
    /// Displacements of moved anchors, per coordinate, m.
    motion: Vec<S>,
    /// The nodes that are moved.
    pub(crate) moved: Vec<usize>,
    /// Per thermal slot.
    prescribed: Vec<Option<Prescribed<S>>>,
    /// The thermal slots of the elements whose temperatures are prescribed, in the order of the loads.
    slots: Vec<Option<usize>>,
}

impl<S: Real> StepLoads<S> {
    /// Memory for a scene.
    pub(crate) fn new<const D: usize>(
        coordinates: usize,
        layout: &Layout,
        loads: &Loads<S, D>,
    ) -> Self {
        let zeros = |needed: bool| vec![S::zero(); if needed { coordinates } else { 0 }];
        let slots = if loads.temperatures.is_empty() {
            0
        } else {
            layout.thermal
        };
        let temperatures = loads.temperatures.iter();
        let thermal = temperatures.map(|(element, _)| layout.elements[element.index].thermal);
        let moved = loads.motions.iter().map(|(node, _)| node.index);
        let moved: BTreeSet<_> = moved.collect();
        Self {
            moved: moved.into_iter().collect(),
            force: zeros(!loads.forces.is_empty()),
            total_force: zeros(!loads.forces.is_empty() || loads.have_weight()),
            motion: zeros(!loads.motions.is_empty()),
            prescribed: vec![None; slots],
            slots: thermal.collect(),
        }
    }

    /// Whether there are loads that do work on nodes.
    pub(crate) fn has_force(&self) -> bool {
        !self.force.is_empty()
    }

    /// Whether there are loads or weights.
    pub(crate) fn has_total_force(&self) -> bool {
        !self.total_force.is_empty()
    }

    /// The load on a node that does work, N.
    #[inline]
    pub(crate) fn force<const D: usize>(&self, node: usize) -> [S; D] {
        point(&self.force, node)
    }

    /// Load and weight of a node, N.
    #[inline]
    pub(crate) fn total_force<const D: usize>(&self, node: usize) -> [S; D] {
        point(&self.total_force, node)
    }

    /// The displacement of a moved anchor, m.
    #[inline]
    pub(crate) fn motion<const D: usize>(&self, node: usize) -> [S; D] {
        point(&self.motion, node)
    }

    /// The temperature prescribed on a thermal slot.
    #[inline]
    pub(crate) fn prescribed(&self, slot: usize) -> Option<Prescribed<S>> {
        self.prescribed.get(slot).copied().flatten()
    }

    /// Evaluates the loads of the step from `time` by `step` at the positions `q0`.
    ///
    /// A force of time is taken in the middle of the step; the trapezoidal rule takes the mean of both ends.
    /// A step of no length evaluates everything at one time.
    pub(crate) fn evaluate<const D: usize>(
        &mut self,
        loads: &Loads<S, D>,
        masses: &Masses<S>,
        scheme: Scheme,
        [time, step]: [S; 2],
        q0: &[S],
    ) -> Result<(), StepFailure> {
        let half = S::from_f64(0.5);
        let (middle, end) = (time + half * step, time + step);
        self.evaluate_forces(loads, scheme, [time, middle, end])?;
        self.add_weights(loads, masses);
        self.evaluate_motions(loads, end, q0)?;
        self.evaluate_temperatures(loads, [middle, end])
    }

    /// Evaluates what is prescribed in the step from `time` by `step`, motions and temperatures; forces are
    /// those of its stages.
    pub(crate) fn evaluate_supports<const D: usize>(
        &mut self,
        loads: &Loads<S, D>,
        [time, step]: [S; 2],
        q0: &[S],
    ) -> Result<(), StepFailure> {
        let (middle, end) = (time + S::from_f64(0.5) * step, time + step);
        self.evaluate_motions(loads, end, q0)?;
        self.evaluate_temperatures(loads, [middle, end])
    }

    fn evaluate_forces<const D: usize>(
        &mut self,
        loads: &Loads<S, D>,
        scheme: Scheme,
        [start, middle, end]: [S; 3],
    ) -> Result<(), StepFailure> {
        let half = S::from_f64(0.5);
        self.force.fill(S::zero());
        for (node, force) in &loads.forces {
            let value = if scheme.has_old_forces() {
                let [start, end] = [start, end].map(|time| force(time).map(|f| half * f));
                start + end
            } else {
                force(middle)
            };
            for axis in 0..D {
                // The sum of all loads on the node, which may overflow where none of them does.
                let sum = &mut self.force[node.index * D + axis];
                *sum += value[axis];
                if !sum.is_finite() {
                    return Err(StepFailure::Load {
                        node: *node,
                        axis,
                        value: sum.to_f64(),
                        time: middle.to_f64(),
                    });
                }
            }
        }
        Ok(())
    }

    fn evaluate_motions<const D: usize>(
        &mut self,
        loads: &Loads<S, D>,
        end: S,
        q0: &[S],
    ) -> Result<(), StepFailure> {
        for (node, motion) in &loads.motions {
            let position = motion(end);
            for axis in 0..D {
                let at = node.index * D + axis;
                self.motion[at] = position[axis] - q0[at];
                if !self.motion[at].is_finite() {
                    return Err(StepFailure::Motion {
                        node: *node,
                        axis,
                        value: position[axis].to_f64(),
                        time: end.to_f64(),
                    });
                }
            }
        }
        Ok(())
    }

    fn evaluate_temperatures<const D: usize>(
        &mut self,
        loads: &Loads<S, D>,
        [middle, end]: [S; 2],
    ) -> Result<(), StepFailure> {
        for ((element, temperature), slot) in loads.temperatures.iter().zip(&self.slots) {
            let at = |time: S| match temperature(time) {
                value if is_positive(value) => Ok(value),
                value => Err(StepFailure::PrescribedTemperature {
                    element: *element,
                    value: value.to_f64(),
                    time: time.to_f64(),
                }),
            };
            if let Some(slot) = *slot {
                self.prescribed[slot] = Some(Prescribed {
                    middle: at(middle)?,
                    end: at(end)?,
                });
            }
        }
        Ok(())
    }

    fn add_weights<const D: usize>(&mut self, loads: &Loads<S, D>, masses: &Masses<S>) {
        let total = self.total_force.as_chunks_mut::<D>().0;
        for (node, (total, mass)) in total.iter_mut().zip(masses.iter()).enumerate() {
            *total = point(&self.force, node);
            weigh(total, mass.unwrap_or(S::zero()), loads);
        }
        for pair in masses.pairs() {
            for node in pair.nodes() {
                if let Some(total) = total.get_mut(node) {
                    weigh(total, pair.mass, loads);
                }
            }
        }
    }
}

/// Adds the weight of a mass.
fn weigh<S: Real, const D: usize>(total: &mut [S; D], mass: S, loads: &Loads<S, D>) {
    for (total, &acceleration) in total.iter_mut().zip(loads.gravity.iter()) {
        *total += mass * acceleration;
    }
}

/// What belongs to a node, among coordinates that may all be missing.
#[inline]
fn point<S: Real, const D: usize>(coordinates: &[S], node: usize) -> [S; D] {
    let points = coordinates.as_chunks::<D>().0;
    points.get(node).copied().unwrap_or([S::zero(); D])
}

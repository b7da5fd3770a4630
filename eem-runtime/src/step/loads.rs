//! The loads of a step from the functions of the user.
//!
//! The forces of a step are constant over it, so that their work `F·Δq` is exact; a moved anchor does the work of the force
//! it needs; a thermostat gives the heat that its element needs. A scheme with stages evaluates them at the time of each.

use core::ops::Range;

use crate::algebra::{add, ascending};
use crate::element::layout::Layout;
use crate::element::loads::{Prescribed, Push, StepLoads};
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::scene::loads::{Course, SceneLoads};
use crate::step::error::StepFailure;
use crate::step::timed::TimedLoad;
use eem_material::number::scalar::is_positive;

impl StepLoads {
    /// Memory for a scene; `is_coupled` says whether masses couple nodes.
    pub(crate) fn new(
        coordinates: usize,
        layout: &Layout,
        loads: &SceneLoads,
        is_coupled: bool,
    ) -> Self {
        let zeros = |needed: bool| vec![0.0; if needed { coordinates } else { 0 }];
        let slots = if loads.temperatures.is_empty() {
            0
        } else {
            layout.thermal
        };
        let (mut thermal, mut pushes) = (Vec::new(), Vec::new());
        let mut moved = Vec::with_capacity(loads.motions.len());
        for (element, _) in &loads.temperatures {
            thermal.push(layout.elements[element.index()].thermal);
        }
        for (node, _) in &loads.motions {
            moved.push(node.index);
        }
        for line in loads.rocket_lines() {
            pushes.push(Push { line, thrust: 0.0 });
        }
        Self {
            moved: ascending(moved),
            force: zeros(!loads.forces.is_empty()),
            total_force: zeros(!loads.forces.is_empty() || loads.have_weight()),
            pushes,
            motion: zeros(!loads.motions.is_empty()),
            speeds: zeros(!loads.motions.is_empty() && is_coupled),
            value: vec![0.0; loads.dimension()],
            prescribed: vec![None; slots],
            slots: thermal,
        }
    }

    /// Evaluates the loads of a step of size `step` that begins at `time` in the state `old`.
    ///
    /// A force that depends on time is evaluated in the middle of the step, even with the trapezoidal rule: forces at
    /// both ends would halve the impulse of a load that is switched on between two steps.
    pub(crate) fn evaluate(
        &mut self,
        loads: &SceneLoads,
        masses: &Masses,
        [time, step]: [f64; 2],
        old: &State,
    ) -> Result<(), StepFailure> {
        self.evaluate_forces_at(loads, masses, time + 0.5 * step)?;
        self.evaluate_supports_by(&CUBIC, loads, ([time, step], 1.0), old)
    }

    /// Evaluates prescribed motions and temperatures at the end of a span of time that is a given fraction of the step;
    /// forces are evaluated at the stages instead.
    pub(crate) fn evaluate_supports(
        &mut self,
        loads: &SceneLoads,
        span: ([f64; 2], f64),
        old: &State,
    ) -> Result<(), StepFailure> {
        self.evaluate_supports_by(&SEXTIC, loads, span, old)
    }

    fn evaluate_supports_by(
        &mut self,
        polynomial: &Polynomial,
        loads: &SceneLoads,
        ([time, span], share): ([f64; 2], f64),
        old: &State,
    ) -> Result<(), StepFailure> {
        let q0 = old.positions.values();
        self.evaluate_motions(loads, [time, span], q0)?;
        self.evaluate_speeds(loads, [time, span], q0, polynomial)?;
        self.evaluate_temperatures(loads, ([time, span], share), &old.temperatures)
    }

    /// Evaluates forces, rockets and weights at a time.
    pub(crate) fn evaluate_forces_at(
        &mut self,
        loads: &SceneLoads,
        masses: &Masses,
        time: f64,
    ) -> Result<(), StepFailure> {
        self.evaluate_own_forces(loads, time, true)?;
        for (push, rocket) in self.pushes.iter_mut().zip(&loads.rockets) {
            push.thrust = (rocket.thrust)(time);
            let load = TimedLoad::Thrust(push.line.node);
            expect_finite(load, 0, push.thrust, time)?;
        }
        self.add_weights(loads, masses);
        Ok(())
    }

    /// Evaluates forces that do not depend on time, and weights.
    pub(crate) fn evaluate_constant_forces(
        &mut self,
        loads: &SceneLoads,
        masses: &Masses,
        time: f64,
    ) -> Result<(), StepFailure> {
        self.evaluate_own_forces(loads, time, false)?;
        self.add_weights(loads, masses);
        Ok(())
    }

    /// Sums the forces at a time, with those that are functions of it or without.
    fn evaluate_own_forces(
        &mut self,
        loads: &SceneLoads,
        time: f64,
        with_functions: bool,
    ) -> Result<(), StepFailure> {
        self.force.fill(0.0);
        for (node, force) in &loads.forces {
            let value = match force {
                Course::Function(of) if with_functions => {
                    of(time, &mut self.value);
                    &self.value
                }
                Course::Function(_) => continue,
                Course::Constant(force) | Course::Set(force) => &force[..],
            };
            let own = &mut self.force[node.index * value.len()..];
            for (axis, (sum, value)) in own.iter_mut().zip(value).enumerate() {
                // The sum of all loads on the node may overflow although none of them does.
                *sum += value;
                expect_finite(TimedLoad::Force(*node), axis, *sum, time)?;
            }
        }
        Ok(())
    }

    /// Finds the total forces, from the forces and weights.
    fn add_weights(&mut self, loads: &SceneLoads, masses: &Masses) {
        let (total, gravity) = (&mut self.total_force, &loads.gravity[..]);
        if self.force.is_empty() {
            total.fill(0.0);
        } else {
            total.copy_from_slice(&self.force);
        }
        let nodes = total.chunks_exact_mut(gravity.len());
        for (total, mass) in nodes.zip(masses.iter()) {
            add(total, mass.unwrap_or(0.0), gravity);
        }
        for ([row, _], mass) in masses.coupled() {
            if let Some(total) = total.get_mut(row * gravity.len()..) {
                add(total, mass, gravity);
            }
        }
    }

    fn evaluate_motions(
        &mut self,
        loads: &SceneLoads,
        [time, span]: [f64; 2],
        q0: &[f64],
    ) -> Result<(), StepFailure> {
        for (node, motion) in &loads.motions {
            let end = time + span;
            let own = range(node.index, loads.dimension());
            let (moved, from) = (&mut self.motion[own.clone()], &q0[own]);
            motion.find_position(end, from, span, moved);
            for (axis, (moved, from)) in moved.iter_mut().zip(from).enumerate() {
                let position = *moved;
                *moved -= from;
                if !moved.is_finite() {
                    let load = TimedLoad::Motion(*node);
                    return Err(StepFailure::of_load(load, axis, position, end));
                }
            }
        }
        Ok(())
    }

    /// The velocities of moved anchors at the end of a span, of a polynomial through their positions in it: more accurate
    /// than the step, and without oscillations from step to step.
    fn evaluate_speeds(
        &mut self,
        loads: &SceneLoads,
        [time, span]: [f64; 2],
        q0: &[f64],
        polynomial: &Polynomial,
    ) -> Result<(), StepFailure> {
        if self.speeds.is_empty() {
            return Ok(());
        }
        let part = span / polynomial.degree;
        let span_of_sum = polynomial.divisor * span;
        for (node, motion) in &loads.motions {
            let own = range(node.index, loads.dimension());
            let (sums, from) = (&mut self.speeds[own.clone()], &q0[own.clone()]);
            let (moved, position) = (&self.motion[own], &mut self.value[..]);
            sums.fill(0.0);
            let mut before = polynomial.degree;
            for &weight in polynomial.weights {
                before -= 1.0;
                let at = time + before * part;
                let moves = before > 0.0;
                if moves {
                    motion.find_position(at, from, before * part, position);
                }
                for (axis, sum) in sums.iter_mut().enumerate() {
                    // No displacement at the start.
                    let place = if moves {
                        position[axis] - from[axis]
                    } else {
                        0.0
                    };
                    if !place.is_finite() {
                        let (load, value) = (TimedLoad::Motion(*node), place + from[axis]);
                        return Err(StepFailure::of_load(load, axis, value, at));
                    }
                    *sum += weight * (moved[axis] - place);
                }
            }
            for (axis, speed) in sums.iter_mut().enumerate() {
                *speed /= span_of_sum;
                if !speed.is_finite() {
                    return Err(StepFailure::MotionSpeed {
                        node: *node,
                        axis,
                        value: *speed,
                        time: time + span,
                    });
                }
            }
        }
        Ok(())
    }

    fn evaluate_temperatures(
        &mut self,
        loads: &SceneLoads,
        ([time, span], share): ([f64; 2], f64),
        old: &[f64],
    ) -> Result<(), StepFailure> {
        for ((element, temperature), slot) in loads.temperatures.iter().zip(&self.slots) {
            let Some(slot) = *slot else {
                continue;
            };
            let at = |time: f64, share: f64| match temperature.at(time, old[slot], share) {
                value if is_positive(value) => Ok(value),
                value => {
                    let load = TimedLoad::Temperature(*element);
                    Err(StepFailure::of_load(load, 0, value, time))
                }
            };
            self.prescribed[slot] = Some(Prescribed {
                middle: at(time + 0.5 * span, 0.5 * share)?,
                end: at(time + span, share)?,
            });
        }
        Ok(())
    }
}

/// An error unless a component of a load is finite at a time.
fn expect_finite(load: TimedLoad, axis: usize, value: f64, time: f64) -> Result<(), StepFailure> {
    if value.is_finite() {
        return Ok(());
    }
    Err(StepFailure::of_load(load, axis, value, time))
}

/// The velocity at the end of a span, of the polynomial through positions at equal distances in time:
///
/// ```text
/// q̇ = Σ_k weights_k (q_end − q_k)/(divisor span)       k parts of the span before its end
/// ```
///
/// Differences from the position at the end have the least rounding.
struct Polynomial {
    degree: f64,
    weights: &'static [f64],
    divisor: f64,
}

/// For schemes of second order.
const CUBIC: Polynomial = Polynomial {
    degree: 3.0,
    weights: &[18.0, -9.0, 2.0],
    divisor: 2.0,
};

/// For schemes of fourth and sixth order.
const SEXTIC: Polynomial = Polynomial {
    degree: 6.0,
    weights: &[360.0, -450.0, 400.0, -225.0, 72.0, -10.0],
    divisor: 10.0,
};

/// The coordinates of a node.
fn range(node: usize, dimension: usize) -> Range<usize> {
    node * dimension..(node + 1) * dimension
}

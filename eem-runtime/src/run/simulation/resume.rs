//! Saving and restoring checkpoints: whether the scene can have a saved state at its time.

use super::memory::Unresolved;
use super::start::check_tolerance;
use super::{Run, Simulation};
use crate::element::conduction::{Conduction, Partner};
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::run::checkpoint::{Checkpoint, Numbers, Outline, RestoreError, SavedEnergies};
use crate::scene::loads::{Course, MOTION_ROUNDINGS, extent};
use crate::step::outcome::Corrections;
use crate::step::scheme::Closing;
use eem_material::number::compensated::Sum;
use eem_material::number::digest::Digest;
use eem_material::number::scalar::Scalar;

/// How far from the time of a state a function of time may have been evaluated for it, in ε of that time.
///
/// A step evaluates functions at `t + h` without the compensation of t: one ε, with the rounding of the sum. The compensated
/// sum of t and h is another ε, and a run moves its last time to the end time by at most two more.
const TIME_ROUNDINGS: f64 = 4.0;

impl<const D: usize> Simulation<D> {
    /// The present state with everything the next steps depend on.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut run = Simulation::new(Scene::<2>::new(), Scheme::EemEntropy, 0.1)?;
    /// run.step()?;
    /// let saved = run.checkpoint();
    /// run.set_step_size(0.5)?;
    /// run.step()?;
    /// run.restore(&saved)?;
    /// assert_eq!((run.time(), run.step_size()), (0.1, 0.1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn checkpoint(&self) -> Checkpoint {
        self.run.checkpoint()
    }

    /// Restores a saved state, of this simulation or of one of the same scene in another process. Nodes, elements
    /// and reservoirs must have been created in the same order.
    ///
    /// # Errors
    ///
    /// [`RestoreError`] if the checkpoint has another scheme, belongs to another scene (shape, materials, masses,
    /// conductances, reservoirs, gravity), or contains a state that no run of this scene can have: an entropy that
    /// does not match the temperature, an anchor in another place, a value that is not finite. The simulation is
    /// unchanged then.
    ///
    /// Prescribed motions and temperatures are evaluated at the time of the checkpoint for this comparison.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), RestoreError> {
        self.run.restore(checkpoint)
    }
}

impl Run {
    pub(super) fn checkpoint(&self) -> Checkpoint {
        let (past, explicit) = self.stepper.past(&self.state);
        let elements = (&self.places[..], &self.shapes[..]);
        let reservoirs = self.conduction.reservoirs.len();
        Checkpoint {
            scheme: self.scheme,
            outline: Outline::new(self.dimension, &self.masses, elements, reservoirs),
            numbers: self.numbers(),
            step: self.step,
            newton: self.effort.settings,
            control: self.control.as_ref().map(|control| control.memory),
            choice: self.saved_choice(),
            state: State {
                energies: Vec::new(),
                ..State::clone(&self.state)
            },
            energies: SavedEnergies {
                of: self.state.digest(),
                // The explicit scheme judges steps by the sums of `SavedExplicit`.
                list: match self.in_use.closing() {
                    Closing::Explicit => Vec::new(),
                    _ => self.state.energies.clone(),
                },
            },
            loads: self.saved_loads(),
            past,
            explicit,
            seals: Vec::new(),
        }
        .sealed()
    }

    pub(super) fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), RestoreError> {
        let (before, loads) = (self.scheme_at_work(), self.saved_loads());
        let saved = self.choice_in(checkpoint)?;
        if let Some(saved) = saved.filter(|saved| saved.scheme != before.scheme) {
            self.use_scheme(saved.scheme)?;
        }
        let taken = self.take_loads(&checkpoint.loads);
        let restored = taken.and_then(|()| self.restore_in_scheme(checkpoint));
        // What has not been touched is left as it is: the sums of an explicit scheme are evaluated again with other rounding.
        if restored.is_err() && (self.in_use != before.scheme || self.saved_loads() != loads) {
            if self.in_use != before.scheme {
                self.use_scheme(before.scheme)?;
            }
            self.take_loads(&loads)?;
            self.resume_scheme(&before);
        }
        restored
    }

    /// Restores a checkpoint whose scheme is in use.
    fn restore_in_scheme(&mut self, checkpoint: &Checkpoint) -> Result<(), RestoreError> {
        checkpoint.check(&self.checkpoint())?;
        self.audit(&checkpoint.state, checkpoint.step)?;
        if let Some(control) = &checkpoint.control {
            check_tolerance(&control.tolerance, (self.scheme, self.in_use))?;
        }
        self.set_newton_settings(checkpoint.newton)?;
        self.has_stepped = false;
        self.state.copy_from(&checkpoint.state);
        self.state.follow_velocities(self.dimension, &self.masses);
        let state = &mut self.state;
        let SavedEnergies { of, list } = &checkpoint.energies;
        if *of == state.digest() && list.len() == state.energies.len() {
            state.energies.copy_from_slice(list);
        } else {
            // The state has been edited, or the scheme is explicit.
            self.stepper.find_energies(state);
        }
        self.worst = None;
        self.corrections = Corrections::none();
        self.unresolved = Unresolved::none();
        // The rates and sums of the explicit scheme belong to another state if the state has been edited.
        let explicit = checkpoint.explicit.as_ref();
        let explicit = explicit.filter(|saved| saved.state == self.state.digest());
        self.stepper.restore(&checkpoint.past, explicit);
        self.step = checkpoint.step;
        self.set_control(checkpoint.control);
        self.restore_choice(checkpoint.choice);
        Ok(())
    }

    /// Digests of the numbers of the scene.
    pub(super) fn numbers(&self) -> Numbers {
        let mut reservoirs = self.conduction.reservoirs.clone();
        for (index, temperature) in &self.loads.ovens {
            reservoirs[*index] = temperature(self.start);
        }
        Numbers {
            materials: Digest::of(|digest| self.stepper.digest(digest)),
            masses: digest_of_masses(&self.masses),
            conductances: digest_of_paths(&self.conduction, self.state.temperatures.len()),
            reservoirs: digest_of(&reservoirs),
            gravity: digest_of(&self.loads.gravity),
        }
    }

    /// An error unless the scene can be in a state, whose numbers are finite, after a step of this size, s.
    pub(super) fn audit(&self, state: &State, step: f64) -> Result<(), RestoreError> {
        if state.time.value < self.start {
            return Err(RestoreError::Value {
                quantity: "time",
                value: state.time.value,
                required: "not before the start of the scene",
            });
        }
        self.audit_meters(&state.meters)?;
        self.audit_anchors(state, step)?;
        audit_velocities(self.dimension, state, &self.masses, &self.are_moved())?;
        self.audit_thermostats(state)?;
        self.stepper.audit(state)?;
        let infinite = self.ledger_in(state).infinite_entry(state, self.dimension);
        infinite.map_or(Ok(()), |(quantity, value, unit)| {
            Err(RestoreError::Total {
                quantity,
                value,
                unit,
            })
        })
    }

    /// Which nodes are anchors whose motion is given.
    pub(super) fn are_moved(&self) -> Vec<bool> {
        let mut are_moved = vec![false; self.masses.len()];
        for (node, _) in &self.loads.motions {
            are_moved[node.index] = true;
        }
        are_moved
    }

    /// Anchors must be where they were created or where their motion puts them, and have no momentum but that of solids.
    fn audit_anchors(&self, state: &State, step: f64) -> Result<(), RestoreError> {
        let scale = extent(state.positions.values());
        let (time, created) = (state.time.value, self.state.positions.values());
        let begin = Scalar::maximum(time - step, self.start);
        let mut motions = vec![None; self.masses.len()];
        for (node, motion) in &self.loads.motions {
            motions[node.index] = Some(motion);
        }
        let mut homes = vec![None; self.masses.len()];
        for (node, home) in &self.homes {
            homes[*node] = Some(home);
        }
        let mut place = vec![0.0; self.dimension];
        for node in self.masses.anchors() {
            for axis in 0..self.dimension {
                let at = node * self.dimension + axis;
                let momentum = not_zero(state.momenta.sum(at));
                if let Some(value) = momentum.filter(|_| !self.masses.are_coupled()) {
                    return Err(RestoreError::AnchorMomentum { node, axis, value });
                }
                let Sum { value, carry } = state.positions.sum(at);
                let created = homes[node].map_or(created[at], |home| home[axis]);
                let (is_right, expected) = match motions[node] {
                    // The position depends on what controllers have set before.
                    Some(Course::Set(_)) => continue,
                    Some(Course::Function(by)) => {
                        let mut by = |time: f64| {
                            by(time, &mut place);
                            place[axis]
                        };
                        (follows(&mut by, value, [time, begin], scale), by(time))
                    }
                    Some(Course::Constant(_)) | None => {
                        #[expect(clippy::float_cmp, reason = "nothing has moved it")]
                        let is_at_home = value == created && carry == 0.0;
                        (is_at_home, created)
                    }
                };
                if !is_right {
                    return Err(RestoreError::Anchor {
                        node,
                        axis,
                        checkpoint: value + carry,
                        simulation: expected,
                        time,
                    });
                }
            }
        }
        Ok(())
    }

    /// Elements with thermostats must have the prescribed temperatures.
    fn audit_thermostats(&self, state: &State) -> Result<(), RestoreError> {
        let time = state.time.value;
        for (element, temperature) in &self.loads.temperatures {
            let Some(slot) = self.slots(*element).thermal else {
                continue;
            };
            let own = state.temperatures[slot];
            let Course::Function(temperature) = temperature else {
                continue;
            };
            if !follows(&mut |time| temperature(time), own, [time; 2], own) {
                return Err(RestoreError::Thermostat {
                    element: *element,
                    checkpoint: own,
                    simulation: temperature(time),
                    time,
                });
            }
        }
        Ok(())
    }
}

/// The digest of some numbers.
fn digest_of(numbers: &[f64]) -> Digest {
    Digest::of(|digest| numbers.iter().for_each(|&number| digest.number(number)))
}

fn digest_of_masses(masses: &Masses) -> Digest {
    Digest::of(|digest| {
        for mass in masses.iter() {
            digest.number(mass.unwrap_or(0.0));
        }
        for pair in masses.pairs().iter().chain(masses.held()) {
            let [first, second] = pair.nodes();
            digest.count(first);
            digest.count(second);
            digest.number(pair.mass);
        }
    })
}

/// The digest of the paths of heat between so many slots.
fn digest_of_paths(conduction: &Conduction, slots: usize) -> Digest {
    Digest::of(|digest| {
        for slot in 0..slots {
            for link in conduction.links(slot) {
                let (kind, index) = match link.partner {
                    Partner::Slot(slot) => (0, slot),
                    Partner::Reservoir(reservoir) => (1, reservoir),
                };
                for count in [slot, kind, index] {
                    digest.count(count);
                }
                digest.number(link.conductance);
            }
        }
    })
}

/// Where masses couple nodes, `p = M v` must hold, and only moved anchors may have a velocity.
fn audit_velocities(
    dimension: usize,
    state: &State,
    masses: &Masses,
    are_moved: &[bool],
) -> Result<(), RestoreError> {
    if !state.velocities.values().is_empty() {
        for node in masses.anchors().filter(|&node| !are_moved[node]) {
            for axis in 0..dimension {
                if let Some(value) = not_zero(state.velocities.sum(node * dimension + axis)) {
                    return Err(RestoreError::AnchorVelocity { node, axis, value });
                }
            }
        }
    }
    let mut expected = state.clone();
    expected.follow_velocities(dimension, masses);
    let momenta = state.momenta.values().iter();
    let mut momenta = momenta.zip(expected.momenta.values());
    #[expect(clippy::float_cmp, reason = "they are computed in the same way")]
    let different = momenta.find(|(a, b)| a != b);
    different.map_or(Ok(()), |(&value, _)| {
        Err(RestoreError::Value {
            quantity: "momenta",
            value,
            required: "those of the velocities, p = M v",
        })
    })
}

/// A sum, unless it and its compensation are zero.
fn not_zero(Sum { value, carry }: Sum) -> Option<f64> {
    let is_zero = value == 0.0 && carry == 0.0;
    (!is_zero).then_some(value + carry)
}

/// Whether a value of this scale is that of a function at a time, to the rounding of both.
///
/// The function may have been evaluated a few roundings before or after the time. Its values there are compared only if
/// its value at the time does not explain the value. The scale of a position includes the function at the beginning of
/// the step, because the step added the difference.
fn follows(
    function: &mut dyn FnMut(f64) -> f64,
    value: f64,
    [time, begin]: [f64; 2],
    scale: f64,
) -> bool {
    let now = function(time);
    let roundings = MOTION_ROUNDINGS * f64::EPSILON;
    let bound = roundings * Scalar::maximum(scale, now.abs());
    if (value - now).abs() <= bound {
        return true;
    }
    let distance = TIME_ROUNDINGS * f64::EPSILON * time;
    let ends = [time - distance, time + distance].map(&mut *function);
    let begin = function(begin);
    let bound = Scalar::maximum(bound, roundings * begin.abs());
    let low = ends.into_iter().fold(now, Scalar::minimum) - bound;
    let high = ends.into_iter().fold(now, Scalar::maximum) + bound;
    (low..=high).contains(&value)
}

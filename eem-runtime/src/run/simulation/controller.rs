//! Loads that are set in the middle of a run.

use super::{Run, Simulation};
use crate::element::error::StateError;
use crate::element::handle::{Element, Node};
use crate::element::lineage::Lineage;
use crate::element::masses::Masses;
use crate::run::checkpoint::{RestoreError, SavedLoads};
use crate::scene::entry::infinite;
use crate::scene::error::SceneError;
use crate::scene::loads::{Course, VectorCourse};
use eem_material::number::scalar::is_positive;

/// # Controllers
///
/// A value that is set holds for all steps until another one is set. It is booked as work and heat like every load, and is part
/// of checkpoints. Set it between steps, for instance before each [`step`](Self::step).
///
/// With step control, the step in which a value jumps is as small as the jump needs: 10⁻⁴ s after a force of the size of the
/// others, 10⁻⁷ s after a temperature that rises by 1 K, for a vibration of 1 s at a tolerance of 10⁻⁶. Controllers that set values
/// often are cheaper with fixed steps.
impl<const D: usize> Simulation<D> {
    /// Sets a force on a mass, N, in addition to its weight. It is constant until another one is set, so that the work of a
    /// step is `f·Δq`.
    ///
    /// # Errors
    ///
    /// [`SceneError::WrongKind`] for an anchor, [`SceneError::GivenLoad`] if the scene has a force on this mass,
    /// [`SceneError::DeadLoad`] for a component that is not finite, [`SceneError::ForeignHandle`],
    /// [`SceneError::TooLarge`]. Nothing is changed then.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(2.0, [0.0], [0.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.5)?;
    /// run.set_force(mass, [4.0])?;
    /// run.run_until(1.0)?;
    /// run.set_force(mass, [0.0])?;
    /// run.run_until(2.0)?;
    /// assert_eq!(run.momentum(mass)?[0], 4.0);
    /// assert_eq!((run.ledger().work, run.ledger().kinetic_energy), (4.0, 4.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_force(&mut self, node: Node, force: [f64; D]) -> Result<(), SceneError> {
        self.run.expect_mass(node, true, "a force")?;
        if let Some((axis, value)) = infinite(&force).next() {
            return Err(SceneError::DeadLoad { node, axis, value });
        }
        let had_none = self.run.loads.forces.is_empty();
        let is_new = set(&mut self.run.loads.forces, node, &force, "force")?;
        let rebuilt = self.run.reload(is_new && had_none);
        rebuilt.inspect_err(|_| {
            self.run.loads.forces.pop();
        })
    }

    /// Sets the velocity of an anchor, m/s, with which it moves until another one is set. The ledger counts the work of the
    /// support. Next to a solid with consistent mass, the anchor reaches the velocity within the next step.
    ///
    /// # Errors
    ///
    /// [`SceneError::WrongKind`] for a mass, [`SceneError::GivenLoad`] if the scene [moves](crate::Scene::move_anchor) this
    /// anchor, [`SceneError::Velocity`] for a component that is not finite, [`SceneError::ForeignHandle`],
    /// [`SceneError::TooLarge`]. Nothing is changed then.
    ///
    /// ```
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [0.0])];
    /// scene.spring(Hooke { stiffness: 4.0, natural_length: 1.0 }, ends);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.125)?;
    /// run.set_motion(ends[0], [0.5])?;
    /// run.run_until(1.0)?;
    /// assert_eq!(run.position(ends[0])?[0], 0.5);
    /// let ledger = run.ledger();
    /// assert!((ledger.energy - ledger.work).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_motion(&mut self, anchor: Node, velocity: [f64; D]) -> Result<(), SceneError> {
        self.run.expect_mass(anchor, false, "a prescribed motion")?;
        if let Some((axis, value)) = infinite(&velocity).next() {
            let node = anchor;
            return Err(SceneError::Velocity { node, axis, value });
        }
        let is_new = set(&mut self.run.loads.motions, anchor, &velocity, "motion")?;
        let rebuilt = self.run.reload(is_new);
        rebuilt.inspect_err(|_| {
            self.run.loads.motions.pop();
        })?;
        self.run.note_home(anchor.index);
        Ok(())
    }

    /// Sets the temperature that an element with a thermostat reaches at the end of the next step, K, linearly in time; it
    /// keeps it until another one is set. The thermostat comes from [`hold_temperature`](crate::Scene::hold_temperature).
    ///
    /// # Errors
    ///
    /// [`SceneError::NoThermostat`] without one, [`SceneError::GivenLoad`] if the scene
    /// [prescribes](crate::Scene::prescribe_temperature) the temperature, [`StateError::Temperature`] unless it is positive
    /// and finite, [`SceneError::NotThermal`], [`SceneError::ForeignHandle`]. Nothing is changed then.
    ///
    /// ```
    /// use eem::materials::ThermoelasticSpring;
    /// use eem::prelude::*;
    ///
    /// let wire = ThermoelasticSpring {
    ///     stiffness: 5.0, coupling: 0.0, capacity: 2.0, natural_length: 1.0, theta_ref: 300.0,
    /// };
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.anchor([1.0])];
    /// let wire = scene.spring(wire, ends);
    /// scene.hold_temperature(wire, 300.0);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1)?;
    /// run.set_temperature_of(wire, 310.0)?;
    /// run.run_until(1.0)?;
    /// assert_eq!(run.temperature(wire)?, 310.0);
    /// assert!((run.ledger().heat - 20.0).abs() < 1e-11);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_temperature_of(
        &mut self,
        element: Element,
        temperature: f64,
    ) -> Result<(), SceneError> {
        self.run.thermal_slot(element)?;
        if !is_positive(temperature) {
            let value = temperature;
            return Err(StateError::Temperature { element, value }.into());
        }
        let mut all = self.run.loads.temperatures.iter_mut();
        match all.find(|(own, _)| *own == element) {
            Some((_, Course::Set(own))) => *own = temperature,
            Some(_) => return Err(given(&element, "temperature")),
            None => return Err(SceneError::NoThermostat { element }),
        }
        self.run.forget_loads();
        Ok(())
    }
}

impl Run {
    /// Remembers where an anchor is before it is moved for the first time.
    fn note_home(&mut self, anchor: usize) {
        if self.homes.iter().all(|&(own, _)| own != anchor) {
            let own = &self.state.positions.values()[anchor * self.dimension..];
            self.homes.push((anchor, own[..self.dimension].to_vec()));
        }
    }

    /// An error unless a node is of this scene, and a mass or an anchor as required.
    fn expect_mass(
        &self,
        node: Node,
        mass: bool,
        quantity: &'static str,
    ) -> Result<(), SceneError> {
        self.expect_own(&node)?;
        let is_mass = self.masses.get(node.index).is_some();
        SceneError::expect_kind(node, [is_mass, mass], quantity)
    }

    /// Prepares steps with the present loads, of which some are new.
    fn reload(&mut self, are_new: bool) -> Result<(), SceneError> {
        if are_new {
            self.use_scheme(self.in_use)?;
            self.set_control(self.control.as_ref().map(|control| control.memory));
        }
        self.forget_loads();
        Ok(())
    }

    /// Makes the next step evaluate its initial loads instead of taking those at the end of the last step.
    pub(super) fn forget_loads(&mut self) {
        self.has_loads = !self.loads.are_none();
        self.stepper.forget(&mut self.state);
    }

    /// All that controllers have set.
    pub(super) fn saved_loads(&self) -> SavedLoads {
        let mut saved = SavedLoads::default();
        (saved.forced, saved.forces) = set_ones(&self.loads.forces);
        (saved.moved, saved.velocities) = set_ones(&self.loads.motions);
        for (element, temperature) in &self.loads.temperatures {
            if let Course::Set(temperature) = temperature {
                saved.held.push(element.index());
                saved.temperatures.push(*temperature);
            }
        }
        saved
    }

    /// Sets what controllers had set in a checkpoint, and nothing else.
    pub(super) fn take_loads(&mut self, saved: &SavedLoads) -> Result<(), RestoreError> {
        let (old, loads) = (self.saved_loads(), &mut self.loads);
        if old == *saved {
            return Ok(());
        }
        if old.held != saved.held || saved.held.len() != saved.temperatures.len() {
            return Err(RestoreError::Loads);
        }
        let forces = (&saved.forced[..], &saved.forces[..]);
        let motions = (&saved.moved[..], &saved.velocities[..]);
        let are_possible = are_of(&self.masses, true, self.dimension, forces)
            && are_of(&self.masses, false, self.dimension, motions)
            && saved.temperatures.iter().all(|&theta| is_positive(theta));
        if !are_possible {
            return Err(RestoreError::Loads);
        }
        set_all(&mut loads.forces, self.dimension, forces, &self.scene);
        set_all(&mut loads.motions, self.dimension, motions, &self.scene);
        let mut temperatures = saved.temperatures.iter();
        for (_, own) in &mut loads.temperatures {
            if let (Course::Set(own), Some(saved)) = (own, temperatures.next()) {
                *own = *saved;
            }
        }
        for &anchor in &saved.moved {
            self.note_home(anchor);
        }
        self.reload(old.forced != saved.forced || old.moved != saved.moved)?;
        Ok(())
    }
}

/// The values that controllers have set.
fn set_ones(all: &[(Node, VectorCourse)]) -> (Vec<usize>, Vec<f64>) {
    let (mut nodes, mut values) = (Vec::new(), Vec::new());
    for (node, course) in all {
        if let Course::Set(value) = course {
            nodes.push(node.index);
            values.extend_from_slice(value);
        }
    }
    (nodes, values)
}

/// Replaces the values that controllers have set.
fn set_all(
    all: &mut Vec<(Node, VectorCourse)>,
    dimension: usize,
    (nodes, values): (&[usize], &[f64]),
    scene: &Lineage,
) {
    all.retain(|(_, course)| !matches!(course, Course::Set(_)));
    for (&index, value) in nodes.iter().zip(values.chunks_exact(dimension)) {
        all.push((scene.node(index), Course::Set(value.into())));
    }
}

/// Whether there are finite vectors of this dimension for these nodes, all masses or all anchors.
fn are_of(
    masses: &Masses,
    is_mass: bool,
    dimension: usize,
    (nodes, values): (&[usize], &[f64]),
) -> bool {
    let is_one = |&node: &usize| node < masses.len() && masses.get(node).is_some() == is_mass;
    let are_finite = values.iter().all(|value| value.is_finite());
    nodes.len() == values.len() / dimension && nodes.iter().all(is_one) && are_finite
}

/// Sets the value of a node. True if the node had none before; an error if the scene gives its value.
fn set(
    all: &mut Vec<(Node, VectorCourse)>,
    node: Node,
    value: &[f64],
    quantity: &'static str,
) -> Result<bool, SceneError> {
    match all.iter_mut().find(|(own, _)| *own == node) {
        Some((_, Course::Set(own))) => own.copy_from_slice(value),
        Some(_) => return Err(given(&node, quantity)),
        None => {
            all.push((node, Course::Set(value.into())));
            return Ok(true);
        }
    }
    Ok(false)
}

/// The error of setting a load that the scene already has as a function of time or as a constant.
fn given(handle: &dyn ToString, quantity: &'static str) -> SceneError {
    let handle = handle.to_string();
    SceneError::GivenLoad { handle, quantity }
}

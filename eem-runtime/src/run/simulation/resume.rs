//! Saving and restoring checkpoints.

use super::Simulation;
use super::compiled::Functions;
use super::memory::Unresolved;
use crate::element::state::State;
use crate::run::checkpoint::{Checkpoint, Outline, RestoreError, SavedEnergies};
use crate::step::outcome::Corrections;
use crate::step::scheme::Closing;

impl<const D: usize> Simulation<D> {
    /// The present state with everything the next steps depend on.
    ///
    /// ```
    /// use eem::{Scene, Scheme, Simulation};
    ///
    /// let mut scene = Scene::<2>::new();
    /// scene.anchor([0.0, 0.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.step()?;
    /// let saved = run.checkpoint();
    /// run.set_step_size(0.5)?;
    /// run.step()?;
    /// assert_eq!((run.time(), run.step_size()), (0.6, 0.5));
    /// run.restore(&saved)?;
    /// assert_eq!((run.time(), run.step_size()), (0.1, 0.1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn checkpoint(&self) -> Checkpoint {
        (Functions::get().checkpoint)(self)
    }

    pub(super) fn checkpoint_here(&self) -> Checkpoint {
        let (past, explicit) = self.stepper.past(&self.state);
        let shapes = self.places.iter();
        let mut shapes = shapes.map(|&[group, _]| self.shapes[group as usize]);
        let reservoirs = self.conduction.reservoirs.len();
        Checkpoint {
            scheme: self.scheme,
            outline: Outline::new(D, &self.masses, &mut shapes, reservoirs),
            numbers: self.numbers(),
            step: self.step,
            newton: self.newton_settings(),
            control: self.control.as_ref().map(|control| control.memory),
            choice: self.saved_choice(),
            state: State {
                energies: Vec::new(),
                ..State::clone(&self.state)
            },
            energies: self.saved_energies(),
            loads: self.saved_loads(),
            past,
            explicit,
            seals: Vec::new(),
        }
        .sealed()
    }

    /// The energies of the elements. Empty for the explicit scheme, which judges steps by the sums of `SavedExplicit`.
    fn saved_energies(&self) -> SavedEnergies {
        let list = match self.in_use.closing() {
            Closing::Explicit => Vec::new(),
            _ => self.state.energies.clone(),
        };
        SavedEnergies {
            of: self.state.digest(),
            list,
        }
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
        (Functions::get().restore)(self, checkpoint)
    }

    pub(super) fn restore_here(&mut self, checkpoint: &Checkpoint) -> Result<(), RestoreError> {
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
        checkpoint.check(&self.checkpoint_here())?;
        self.audit(&checkpoint.state, checkpoint.step)?;
        Self::check_control(checkpoint.control, (self.scheme, self.in_use))?;
        self.set_newton_settings(checkpoint.newton)?;
        self.has_stepped = false;
        self.state.copy_from(&checkpoint.state);
        self.state.follow_velocities(D, &self.masses);
        let state = &mut self.state;
        let SavedEnergies { of, list } = &checkpoint.energies;
        if *of == state.digest() && list.len() == state.energies.len() {
            state.energies.copy_from_slice(list);
        } else {
            // The state has been edited, or the scheme is explicit.
            self.stepper.each_mut(|group| group.find_energies(state));
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
}

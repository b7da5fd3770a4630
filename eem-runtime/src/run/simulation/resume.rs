//! Saving a state and going on from it.

use super::Simulation;
use super::compiled::Functions;
use crate::element::state::State;
use crate::run::checkpoint::{Checkpoint, Outline, RestoreError, Seals};
use crate::step::outcome::Corrections;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
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
    pub fn checkpoint(&self) -> Checkpoint<S> {
        (Functions::get().checkpoint)(self)
    }

    pub(super) fn checkpoint_here(&self) -> Checkpoint<S> {
        let (past, explicit) = self.stepper.past(&self.state);
        Checkpoint {
            scheme: self.scheme,
            outline: self.outline(),
            numbers: self.numbers(),
            step: self.step,
            newton: self.newton_settings(),
            control: self.control.as_ref().map(|control| control.memory),
            choice: self.saved_choice(),
            state: State {
                energies: Vec::new(),
                ..State::clone(&self.state)
            },
            past,
            explicit,
            seals: Seals::none(),
        }
        .sealed_up()
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
    pub fn restore(&mut self, checkpoint: &Checkpoint<S>) -> Result<(), RestoreError> {
        (Functions::get().restore)(self, checkpoint)
    }

    pub(super) fn restore_here(&mut self, checkpoint: &Checkpoint<S>) -> Result<(), RestoreError> {
        let own = (self.in_use, self.stepper.past(&self.state));
        let saved = self.choice_in(checkpoint)?;
        if let Some(saved) = saved.filter(|saved| saved.scheme != own.0) {
            self.use_scheme(saved.scheme).inspect_err(|_| self.part())?;
        }
        let Err(error) = self.restore_in_scheme(checkpoint) else {
            return Ok(());
        };
        self.part();
        let (scheme, past) = own;
        if self.in_use != scheme {
            self.use_scheme(scheme)?;
            self.stepper.restore(&past.0, past.1.as_ref());
        }
        Err(error)
    }

    /// The same where the scheme of the checkpoint is in use.
    fn restore_in_scheme(&mut self, checkpoint: &Checkpoint<S>) -> Result<(), RestoreError> {
        let past = self.stepper.past(&self.state);
        let past = (&past.0, past.1.as_ref());
        let scene = (&self.outline(), &self.numbers());
        checkpoint
            .check(self.scheme, scene, &self.state, past)
            .and_then(|()| self.audit(&checkpoint.state, checkpoint.step))?;
        self.check_control(checkpoint.control)?;
        self.set_newton_settings(checkpoint.newton)?;
        self.has_stepped = false;
        self.state.copy_from(&checkpoint.state);
        self.state.follow_velocities(D, &self.masses);
        let state = &mut self.state;
        self.stepper.each_mut(|group| group.find_energies(state));
        self.worst = None;
        self.corrections = Corrections::none();
        // Of a state that has been edited nothing is known.
        let explicit = checkpoint.explicit.as_ref();
        let explicit = explicit.filter(|saved| saved.state == self.state.digest());
        self.stepper.restore(&checkpoint.past, explicit);
        self.step = checkpoint.step;
        self.go_on_with(checkpoint.control);
        self.restore_choice(checkpoint.choice);
        Ok(())
    }

    fn outline(&self) -> Outline {
        let reservoirs = self.conduction.reservoirs.len();
        let places = self.places.iter();
        let shapes = places.map(|&[group, _]| self.shapes[group as usize]);
        Outline::new(D, &self.masses, shapes, reservoirs)
    }
}

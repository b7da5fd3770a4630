//! Settings: the step size, Newton's method, the energy correction of the explicit scheme.

use super::Simulation;
use super::check::check_step;
use super::stepper::Stepper;
use crate::scene::error::SceneError;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::is_positive;

impl<const D: usize> Simulation<D> {
    /// The size of the next steps, s.
    #[must_use]
    pub const fn step_size(&self) -> f64 {
        self.step
    }

    /// Changes the size of the next steps, s. This is allowed at any time, as all laws hold step by step.
    ///
    /// # Errors
    ///
    /// [`SceneError::Step`] unless it is finite and at least 2⁻⁵¹¹ s, 1.5e-154 s; the old size remains.
    pub fn set_step_size(&mut self, step: f64) -> Result<(), SceneError> {
        check_step(step)?;
        self.step = step;
        self.damp_fixed_steps();
        Ok(())
    }

    /// Whether the explicit scheme corrects the energy of a step by motion before heat.
    #[must_use]
    pub fn is_motion_first(&self) -> bool {
        match &self.stepper {
            Stepper::Explicit(explicit) if self.scheme != Scheme::Auto => {
                explicit.is_motion_first()
            }
            _ => self.automatic.is_motion_first,
        }
    }

    /// Selects how the explicit scheme corrects the energy of a step: first by heat (default), or first by motion.
    /// Heat is more accurate and changes the entropy production of elements in the step by at most 0.3 %; motion
    /// leaves it unchanged. No effect on other schemes.
    pub fn set_motion_first(&mut self, is_motion_first: bool) {
        if let Stepper::Explicit(explicit) = &mut self.stepper {
            explicit.set_motion_first(is_motion_first);
        }
        if self.scheme == Scheme::Auto {
            self.automatic.is_motion_first = is_motion_first;
        }
    }

    /// The settings of Newton's method.
    #[must_use]
    pub const fn newton_settings(&self) -> NewtonSettings {
        self.effort.settings
    }

    /// Changes the settings of Newton's method.
    ///
    /// # Errors
    ///
    /// [`SceneError::NewtonSettings`] unless there is at least one iteration and the tolerance lies between 0 and
    /// 1; the old settings remain.
    pub fn set_newton_settings(&mut self, settings: NewtonSettings) -> Result<(), SceneError> {
        let NewtonSettings {
            max_iterations,
            tolerance,
        } = settings;
        if max_iterations == 0 || !is_positive(tolerance) || tolerance >= 1.0 {
            return Err(SceneError::NewtonSettings {
                max_iterations,
                tolerance,
            });
        }
        self.effort.settings = settings;
        Ok(())
    }
}

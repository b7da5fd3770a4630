//! Another scheme in the middle of a run.

use core::error::Error;
use core::fmt;

use super::start::check_tolerance;
use super::{Run, Simulation};
use crate::algebra::indices;
use crate::algebra::memory::TooLarge;
use crate::element::ends::Ends;
use crate::element::layout::Layout;
use crate::run::checkpoint::SavedControl;
use crate::scene::entry;
use crate::scene::error::SceneError;
use crate::step::automatic::SchemeSelection;
use crate::step::control::{Controller, Tolerance};
use crate::step::explicit::Site;
use crate::step::scheme::Scheme;

impl<const D: usize> Simulation<D> {
    /// The same run with another scheme from here on.
    ///
    /// Time, state with its compensated rounding, sums of work and heat, loads, settings, step size and tolerance stay. Only the
    /// history from which steps are predicted begins anew. [`Scheme::Auto`] needs step control; without it,
    /// [`Tolerance::default`] is used.
    ///
    /// # Errors
    ///
    /// The run as it was, with the [`SceneError`] that says why: the scheme cannot step solids, rockets or dashpots in parallel
    /// with a spring, cannot use step control or its tolerance, or needs more memory than is allowed.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(1.0, [0.0], [3.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.run_until(1.0)?;
    /// let mut run = run.with_scheme(Scheme::EemExplicit)?;
    /// run.run_until(2.0)?;
    /// assert_eq!((run.scheme(), run.time()), (Scheme::EemExplicit, 2.0));
    /// assert!((run.position(mass)?[0] - 6.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_scheme(mut self, scheme: Scheme) -> Result<Self, RefusedChange<D>> {
        match self.run.change_scheme(scheme) {
            Ok(()) => Ok(self),
            Err(error) => Err(RefusedChange {
                run: Box::new(self),
                error,
            }),
        }
    }
}

impl Run {
    /// Changes the scheme, or nothing.
    pub(super) fn change_scheme(&mut self, scheme: Scheme) -> Result<(), SceneError> {
        if scheme == self.scheme {
            return Ok(());
        }
        let in_use = self.automatic.needs.first(scheme);
        let control = match &self.control {
            // The errors of earlier steps mean nothing for another scheme.
            Some(control) => Some(SavedControl {
                controller: Controller::new(),
                ..control.memory
            }),
            None if scheme == Scheme::Auto => Some(SavedControl::new(Tolerance::default())),
            None => None,
        };
        self.automatic.needs.check(in_use)?;
        if let Some(control) = &control {
            check_tolerance(&control.tolerance, (scheme, in_use))?;
        }
        self.automatic.is_motion_first = self.is_motion_first();
        if in_use != self.in_use {
            self.use_scheme(in_use)?;
        }
        self.scheme = scheme;
        self.automatic.selection = SchemeSelection::new();
        self.set_control(control);
        Ok(())
    }

    /// Replaces the scheme in use, but not its step control. If there is no memory for it, nothing changes.
    pub(super) fn use_scheme(&mut self, scheme: Scheme) -> Result<(), TooLarge> {
        let (layout, ends) = (self.numbering(), self.ends());
        let automatic = &mut self.automatic;
        let site = Site {
            masses: &self.masses,
            elements: &ends,
            layout: &layout,
            conduction: &self.conduction,
            loads: &self.loads,
        };
        let (evaluations, limit) = (self.stepper.evaluations(), automatic.memory_limit);
        (self.stepper).change(scheme, site, limit, &mut self.state)?;
        automatic.evaluations += evaluations;
        self.stepper.set_motion_first(automatic.is_motion_first);
        self.in_use = scheme;
        self.has_stepped = false;
        Ok(())
    }

    /// The numbering of the unknowns and state variables, as the scene had it.
    pub(super) fn numbering(&self) -> Layout {
        let elements = (&self.places[..], &self.shapes[..]);
        let mut layout = entry::layout(self.dimension, &self.masses, elements);
        layout.couple(|slot| self.conduction.meets_slots(slot));
        layout
    }

    /// The nodes of all elements.
    pub(super) fn ends(&self) -> Ends {
        let mut ends = Ends::none();
        for &place in &self.places {
            ends.push(self.stepper.nodes(indices(place)).iter().copied());
        }
        ends
    }
}

/// A run that cannot continue with another scheme, unchanged, and the reason.
///
/// `?` converts it to its [`SceneError`].
///
/// ```
/// use eem::prelude::*;
///
/// #[derive(FreeEnergy)]
/// #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - 1).powi(2))]
/// #[viscosity(lambda = eta)]
/// struct Damper { stiffness: f64, eta: f64 }
///
/// let mut scene = Scene::<1>::new();
/// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
/// scene.spring(Damper { stiffness: 4.0, eta: 0.1 }, ends);
/// let run = Simulation::new(scene, Scheme::EemTemperature, 0.1)?;
/// let refused = run.with_scheme(Scheme::EemExplicit).unwrap_err();
/// assert!(matches!(refused.error(), SceneError::NoDrag { scheme: "eem-explicit", .. }));
/// refused.into_run().run_until(1.0)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct RefusedChange<const D: usize> {
    run: Box<Simulation<D>>,
    error: SceneError,
}

impl<const D: usize> RefusedChange<D> {
    /// Why the scheme cannot step the scene.
    #[must_use]
    pub const fn error(&self) -> &SceneError {
        &self.error
    }

    /// The run as it was.
    #[must_use]
    pub fn into_run(self) -> Simulation<D> {
        *self.run
    }
}

impl<const D: usize> fmt::Display for RefusedChange<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl<const D: usize> fmt::Debug for RefusedChange<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut all = f.debug_struct("RefusedChange");
        all.field("error", &self.error).finish_non_exhaustive()
    }
}

impl<const D: usize> Error for RefusedChange<D> {}

impl<const D: usize> From<RefusedChange<D>> for SceneError {
    fn from(refused: RefusedChange<D>) -> Self {
        refused.error
    }
}

//! A scene that is rejected, with all its errors.

use core::error::Error;
use core::fmt;

use super::Scene;
use crate::scene::error::SceneError;

/// The largest number of errors in a message.
const MOST_NAMED: usize = 20;

/// A scene that [`Simulation::new`](crate::Simulation::new) rejects, and its errors: the first error of each part
/// (the parameters of an element, its initial state, a section). Initial states are checked once all numbers are
/// valid.
///
/// `?` converts it to its first [`SceneError`].
///
/// ```
/// use eem::prelude::*;
///
/// let mut scene = Scene::<1>::new();
/// scene.mass(-1.0, [0.0], [0.0]);
/// scene.mass(2.0, [f64::NAN], [0.0]);
/// let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
/// assert_eq!(
///     refused.to_string(),
///     "2 things are wrong with the scene:\n\
///      - the mass of node 0 is -1 kg, it must be positive and finite\n\
///      - coordinate 0 of the position of node 1 is NaN m, it must be finite",
/// );
/// assert!(matches!(refused.errors()[0], SceneError::Mass { value: -1.0, .. }));
/// let mut scene = refused.into_scene();
/// scene.mass(3.0, [0.0], [0.0]);
/// ```
pub struct RefusedScene<const D: usize> {
    scene: Box<Scene<D>>,
    /// At least one.
    errors: Vec<SceneError>,
}

impl<const D: usize> RefusedScene<D> {
    pub(crate) fn new(scene: Scene<D>, errors: Vec<SceneError>) -> Self {
        let scene = Box::new(scene);
        Self { scene, errors }
    }

    /// All errors, at least one.
    #[must_use]
    pub fn errors(&self) -> &[SceneError] {
        &self.errors
    }

    /// The scene as it was given.
    #[must_use]
    pub fn into_scene(self) -> Scene<D> {
        *self.scene
    }
}

impl<const D: usize> fmt::Display for RefusedScene<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = self.errors.len();
        if let [only] = &self.errors[..] {
            return only.fmt(f);
        }
        write!(f, "{count} things are wrong with the scene:")?;
        for error in self.errors.iter().take(MOST_NAMED) {
            write!(f, "\n- {error}")?;
        }
        if count > MOST_NAMED {
            write!(f, "\n- and {} more", count - MOST_NAMED)?;
        }
        Ok(())
    }
}

impl<const D: usize> fmt::Debug for RefusedScene<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut all = f.debug_struct("RefusedScene");
        all.field("errors", &self.errors).finish_non_exhaustive()
    }
}

impl<const D: usize> Error for RefusedScene<D> {}

impl<const D: usize> From<RefusedScene<D>> for SceneError {
    fn from(mut refused: RefusedScene<D>) -> Self {
        refused.errors.swap_remove(0)
    }
}

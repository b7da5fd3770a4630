//! How much memory the linear systems of a scene may take.

use crate::algebra::memory::MemoryLimit;
use crate::scene::Scene;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Scene<D, S> {
    /// Limits the memory of the matrix of Newton's method and its factors, bytes. Without a limit it is the memory
    /// available when the simulation begins.
    ///
    /// The factors of solids in space need most: about 16 GB for a block of 50³ cells with eight nodes. A scene
    /// that does not fit is rejected before memory is reserved, with
    /// [`SceneError::TooLarge`](crate::SceneError::TooLarge).
    ///
    /// ```
    /// use eem::TooLarge;
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let mut last = scene.anchor([0.0, 0.0]);
    /// for index in 1..=100 {
    ///     let next = scene.mass(1.0, [f64::from(index), 0.0], [0.0, 0.0]);
    ///     scene.spring(Hooke { stiffness: 1.0, natural_length: 1.0 }, [last, next]);
    ///     last = next;
    /// }
    /// scene.limit_memory(1_000);
    /// let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
    /// assert!(matches!(
    ///     refused.errors(),
    ///     [SceneError::TooLarge(TooLarge { unknowns: 200, available: Some(1_000), .. })]
    /// ));
    /// ```
    pub fn limit_memory(&mut self, bytes: u64) {
        self.memory_limit = MemoryLimit::new(Some(bytes));
    }
}

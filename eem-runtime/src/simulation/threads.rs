//! How many threads a step may use.

use core::num::NonZero;

use super::Simulation;
use crate::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// From here on, linear systems that are solved by sparse elimination use this many threads.
    ///
    /// The default is one. More pay for lattices and networks of thousands of springs, whose factors
    /// have large dense blocks; chains and trees have none. Results are the same to the last bit.
    /// Needs the features `parallel` and `sparse`; without one of them, all is done by one thread.
    ///
    /// ```
    /// use core::num::NonZero;
    /// use eem_runtime::{Scene, Scheme, Simulation};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut scene = Scene::<2>::new();
    /// scene.mass(1.0, [0.0, 0.0], [3.0, 4.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.1)?;
    /// run.set_threads(NonZero::new(2).ok_or("at least one")?);
    /// run.step()?;
    /// assert_eq!(run.ledger().energy, 12.5);
    /// # Ok(())
    /// # }
    /// ```
    #[cfg_attr(
        not(all(feature = "parallel", feature = "sparse")),
        expect(unused_variables, reason = "one thread does it all")
    )]
    pub fn set_threads(&mut self, threads: NonZero<usize>) {
        #[cfg(all(feature = "parallel", feature = "sparse"))]
        match &mut self.staged {
            Some(staged) => staged.solver.set_threads(threads),
            None => self.solver.set_threads(threads),
        }
    }
}

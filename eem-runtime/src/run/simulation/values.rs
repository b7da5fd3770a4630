//! All values of a state, kind by kind, and the number of evaluations.

use super::Simulation;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// q (m) and p (kg m/s) of the masses, θ (K) and γ (m) of the elements, each in the order of creation.
    #[doc(hidden)]
    #[must_use]
    pub fn values(&self) -> [Vec<f64>; 4] {
        let all = |values: &[S]| values.iter().map(|value| value.to_f64()).collect();
        let of_masses = |values: &[S]| {
            let nodes = self.masses.iter().zip(values.chunks_exact(D));
            let moving = nodes.filter(|(mass, _)| mass.is_some());
            all(&moving
                .flat_map(|(_, value)| value)
                .copied()
                .collect::<Vec<_>>())
        };
        let state = &self.state;
        [
            of_masses(state.positions.values()),
            of_masses(state.momenta.values()),
            all(&state.temperatures),
            all(state.viscous.values()),
        ]
    }

    /// How often the forces of all elements have been evaluated since the simulation was made, once for each
    /// stage of a scheme with several.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene: Scene<1> = Scene::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.0], [1.0])];
    /// scene.spring(eem::materials::Hooke { stiffness: 1.0, natural_length: 1.0 }, ends);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.step()?;
    /// assert!(run.evaluations() >= 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.automatic.evaluations + self.stepper.evaluations()
    }
}

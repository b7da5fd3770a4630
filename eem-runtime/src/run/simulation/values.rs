//! All values of a state, of one kind after the other.

use super::Simulation;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// q (m) and p (kg m/s) of the masses, θ (K) and γ (m) of the elements, each in the order of creation.
    #[doc(hidden)]
    #[must_use]
    pub fn values(&self) -> [Vec<f64>; 4] {
        let of_masses = |values: &[S]| {
            let nodes = self.masses.iter().zip(values.chunks_exact(D));
            let moving = nodes.filter(|(mass, _)| mass.is_some());
            moving
                .flat_map(|(_, value)| value.iter().map(|component| component.to_f64()))
                .collect()
        };
        let all = |values: &[S]| values.iter().map(|value| value.to_f64()).collect();
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
        let earlier = self
            .automatic
            .as_ref()
            .map_or(0, |automatic| automatic.evaluations);
        earlier + self.stepper.evaluations()
    }
}

//! All values of a state, of one kind after the other.

use super::Simulation;
use crate::number::scalar::Real;

/// The values of a state by kind: positions and momenta of the masses, temperatures, viscous stretches.
pub(crate) type Values = [Vec<f64>; 4];

impl<const D: usize, S: Real> Simulation<D, S> {
    /// q (m) and p (kg m/s) of the masses, θ (K) and γ (m) of the elements, each in the order of creation.
    pub(crate) fn values(&self) -> Values {
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
    pub(crate) fn evaluations(&self) -> u64 {
        let earlier = self
            .automatic
            .as_ref()
            .map_or(0, |automatic| automatic.evaluations);
        earlier + self.stepper.evaluations()
    }
}

//! The GENERIC form in temperatures instead of entropies.

use super::Simulation;
use super::generic::{Generic, Places};
use crate::element::group::EntropySlopes;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// The GENERIC form at the present state with temperatures instead of entropies as variables (Conde Martín,
    /// Betsch & García Orden 2016, eqs. 21–23):
    ///
    /// ```text
    /// z = (q, p of the masses; γ of all dashpots; θ of all elements; σ of all reservoirs)
    /// ∇_θ = Jᵀ ∇_s,   L_θ = J⁻¹ L_s J⁻ᵀ,   M_θ = J⁻¹ M_s J⁻ᵀ,   J = ∂(q, p, γ, s, σ)/∂(q, p, γ, θ, σ)
    /// ```
    ///
    /// L then depends on the state and couples momenta with temperatures.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// /// `c = 2 J/K`, `∂s/∂λ = 3 J/(K m)`.
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch, theta: Temperature| {
    ///     5.0 * lambda.powi(2) - 3.0 * theta * lambda - 2.0 * theta * ln(theta)
    /// })]
    /// struct Wire;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let nodes = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    /// let wire = scene.spring(Wire, nodes);
    /// scene.set_temperature(wire, 300.0);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.01)?;
    /// let form = run.generic_in_temperature();
    /// // z = (q, p, θ): ṗ has the part (∂s/∂θ)⁻¹ ∂s/∂λ ∂E/∂θ with ∂s/∂θ = c/θ.
    /// assert!((form.reversible[(1, 2)] - 3.0 * 300.0 / 2.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn generic_in_temperature(&mut self) -> Generic<S> {
        let (mut form, elements) = self.generic_and_elements();
        let places = self.generic_places();
        for slopes in elements
            .iter()
            .filter_map(|element| element.entropy.as_ref())
        {
            form.take_temperature(&places, slopes);
        }
        form
    }
}

impl<S: Real> Generic<S> {
    /// Replaces the entropy of an element by its temperature.
    fn take_temperature(&mut self, places: &Places, slopes: &EntropySlopes<S>) {
        let own = places.entropies + slopes.slot;
        let positions = slopes.by_position.iter();
        let positions = positions.filter_map(|&(coordinate, slope)| {
            places.positions[coordinate].map(|place| (place, slope))
        });
        let dashpots = slopes.by_viscous.iter();
        let dashpots = dashpots.map(|&(slot, slope)| (places.viscous + slot, slope));
        let others: Vec<_> = positions.chain(dashpots).collect();
        for gradient in [&mut self.energy_gradient, &mut self.entropy_gradient] {
            let by_entropy = gradient[own];
            for &(place, slope) in &others {
                gradient[place] += slope * by_entropy;
            }
            gradient[own] = slopes.by_temperature * by_entropy;
        }
        let per_slope = slopes.by_temperature.recip();
        for matrix in [&mut self.reversible, &mut self.irreversible] {
            // First J⁻¹ L, then (L J⁻ᵀ)ᵀ = J⁻¹ Lᵀ.
            for _ in 0..2 {
                for column in 0..matrix.ncols() {
                    let mut rate = matrix[(own, column)];
                    for &(place, slope) in &others {
                        rate -= slope * matrix[(place, column)];
                    }
                    matrix[(own, column)] = per_slope * rate;
                }
                matrix.transpose_mut();
            }
        }
    }
}

//! The GENERIC form of a scene, in entropies or in temperatures.

use nalgebra::{DMatrix, DVector};

use super::Simulation;
use super::stepper::Stepper;
use crate::element::conduction::Partner;
use crate::element::group::{ElementGeneric, Elements, EntropySlopes};
use crate::element::state::State;
use crate::step::scheme::Scheme;

/// The GENERIC form of a scene: the two gradients and the two matrices of `ż = L ∇E + M ∇S`.
///
/// ```text
/// z = (q, p of the masses; γ of all dashpots; s of all elements; σ of all reservoirs)
/// L = −Lᵀ,   M = Mᵀ ≥ 0,   L ∇S = 0,   M ∇E = 0
/// ```
///
/// in the order of creation (Öttinger 2005; García Orden & Romero 2012). For the form with temperatures in the place of
/// entropies (Conde Martín, Betsch & García Orden 2016) see [`generic_in_temperature`](Simulation::generic_in_temperature).
/// With discrete derivatives in the place of ∇, `z¹ − z⁰ = h (L DE + M DS)`. Loads and thermostats are not part of the form.
#[derive(Clone, Debug, PartialEq)]
pub struct Generic {
    /// `∇E` or `DE`.
    pub energy_gradient: DVector<f64>,
    /// `∇S` or `DS`.
    pub entropy_gradient: DVector<f64>,
    /// L, the reversible part.
    pub reversible: DMatrix<f64>,
    /// M, the irreversible part.
    pub irreversible: DMatrix<f64>,
}

impl<const D: usize> Simulation<D> {
    /// The state z of [`Generic`].
    #[must_use]
    pub fn generic_state(&self) -> DVector<f64> {
        let state = &self.run.state;
        let mut z = self.of_masses(&state.positions);
        z.extend(self.of_masses(&state.momenta));
        for sums in [&state.viscous, &state.entropies, &state.reservoir_entropies] {
            z.extend_from_slice(sums.values());
        }
        DVector::from_vec(z)
    }

    /// Gradients and matrices at the present state.
    pub fn generic(&mut self) -> Generic {
        self.generic_and_elements().0
    }

    /// Gradients and matrices at the present state, and the contributions of the elements.
    pub(super) fn generic_and_elements(&mut self) -> (Generic, Vec<ElementGeneric>) {
        // The elements are evaluated elsewhere than at the ends of their last step.
        self.run.has_stepped = false;
        let state = &self.run.state;
        let mut elements = Vec::new();
        let each = |group: &mut dyn Elements| {
            group.generic_in(state, &mut |element| elements.push(element));
        };
        self.run.stepper.of_mut::<D>().each_mut(each);
        let velocities = self.velocities_in(&self.run.state);
        (self.generic_from(&elements, &velocities), elements)
    }

    /// Discrete gradients and matrices of the last step; `None` before the first, after a failed
    /// one, and for a scheme that is not a discrete GENERIC system.
    #[must_use]
    pub fn generic_of_last_step(&self) -> Option<Generic> {
        let discrete = matches!(self.run.in_use, Scheme::EemEntropy | Scheme::EemTemperature);
        if !(discrete && self.run.has_stepped) {
            return None;
        }
        let ends = [&*self.run.next, &*self.run.state];
        let Stepper::Newton(newton) = self.stepper() else {
            return None;
        };
        let mut elements = Vec::new();
        for group in &newton.groups {
            group.generic_of_step(ends, &mut |element| elements.push(element));
        }
        let [mut mean, new] = ends.map(|state| self.velocities_in(state));
        for (mean, new) in mean.iter_mut().zip(new) {
            *mean = 0.5 * (*mean + new);
        }
        Some(self.generic_from(&elements, &mean))
    }

    /// The velocities of all nodes, m/s; zero for anchors.
    pub(super) fn velocities_in(&self, state: &State) -> Vec<f64> {
        let velocity = |(node, mass): (usize, Option<f64>)| {
            mass.map_or([0.0; D], |mass| state.velocity(node, mass))
        };
        self.run
            .masses
            .iter()
            .enumerate()
            .flat_map(velocity)
            .collect()
    }

    fn generic_from(&self, elements: &[ElementGeneric], velocities: &[f64]) -> Generic {
        let indices = self.generic_indices();
        let gradient = DVector::from_element(indices.size, 0.0);
        let (mut energy_gradient, mut entropy_gradient) = (gradient.clone(), gradient);
        let matrix = DMatrix::from_element(indices.size, indices.size, 0.0);
        let (mut reversible, mut irreversible) = (matrix.clone(), matrix);
        for (coordinate, place) in indices.positions.iter().enumerate() {
            let Some(q) = *place else {
                continue;
            };
            let p = q + indices.momenta;
            energy_gradient[p] = velocities[coordinate];
            reversible[(q, p)] = 1.0;
            reversible[(p, q)] = -1.0;
        }
        for (slot, &theta) in self.run.conduction.reservoirs.iter().enumerate() {
            energy_gradient[indices.reservoirs + slot] = theta;
            entropy_gradient[indices.reservoirs + slot] = 1.0;
        }
        let mut temperatures = vec![0.0; self.run.layout.thermal];
        for element in elements {
            for &(coordinate, force) in &element.forces {
                if let Some(q) = indices.positions[coordinate] {
                    energy_gradient[q] += force;
                }
            }
            for &(slot, force, _) in &element.dashpots {
                energy_gradient[indices.viscous + slot] = -force;
            }
            if let Some((slot, theta)) = element.temperature {
                energy_gradient[indices.entropies + slot] = theta;
                entropy_gradient[indices.entropies + slot] = 1.0;
                temperatures[slot] = theta;
                for &(viscous, force, eta) in &element.dashpots {
                    let w = [
                        (indices.viscous + viscous, 1.0),
                        (indices.entropies + slot, force / theta),
                    ];
                    add_rank_one(&mut irreversible, theta / eta, &w);
                }
                for (eta, by_position) in &element.drags {
                    let w = indices.drag(by_position, velocities, (slot, theta));
                    add_rank_one(&mut irreversible, *eta * theta, &w);
                }
            }
        }
        self.add_conduction(&indices, &temperatures, &mut irreversible);
        Generic {
            energy_gradient,
            entropy_gradient,
            reversible,
            irreversible,
        }
    }

    /// `κ θ_a θ_b w wᵀ` with `w = e_a/θ_a − e_b/θ_b` for every path of heat.
    fn add_conduction(&self, indices: &Indices, temperatures: &[f64], matrix: &mut DMatrix<f64>) {
        for (slot, &theta) in temperatures.iter().enumerate() {
            for link in self.run.conduction.links(slot) {
                let (partner, other) = match link.partner {
                    // Each path between elements is listed at both ends.
                    Partner::Slot(partner) if partner < slot => continue,
                    Partner::Slot(partner) => (indices.entropies + partner, temperatures[partner]),
                    Partner::Reservoir(index) => (
                        indices.reservoirs + index,
                        self.run.conduction.reservoirs[index],
                    ),
                };
                let w = [
                    (indices.entropies + slot, theta.recip()),
                    (partner, -other.recip()),
                ];
                add_rank_one(matrix, link.conductance * theta * other, &w);
            }
        }
    }

    pub(super) fn generic_indices(&self) -> Indices {
        let mut positions = Vec::with_capacity(self.run.masses.len() * D);
        let mut masses = 0;
        for mass in self.run.masses.iter().flat_map(|mass| [mass; D]) {
            positions.push(mass.map(|_| masses));
            masses += usize::from(mass.is_some());
        }
        let viscous = 2 * masses;
        let entropies = viscous + self.run.layout.viscous;
        let reservoirs = entropies + self.run.layout.thermal;
        Indices {
            positions,
            momenta: masses,
            viscous,
            entropies,
            reservoirs,
            size: reservoirs + self.run.conduction.reservoirs.len(),
        }
    }
}

/// The indices in z at which its parts begin.
pub(super) struct Indices {
    /// The index of each coordinate of a mass; `None` for anchors.
    pub(super) positions: Vec<Option<usize>>,
    momenta: usize,
    pub(super) viscous: usize,
    pub(super) entropies: usize,
    reservoirs: usize,
    size: usize,
}

impl Indices {
    /// `w` of the dashpot in parallel with a spring, `ηθ w wᵀ ∇S`: `ṗ = −η λ̇ ∂λ/∂q` and `ṡ = η λ̇²/θ`.
    fn drag(
        &self,
        by_position: &[(usize, f64)],
        velocities: &[f64],
        (slot, theta): (usize, f64),
    ) -> Vec<(usize, f64)> {
        let mut w = Vec::with_capacity(by_position.len() + 1);
        let mut rate = 0.0;
        for &(coordinate, entry) in by_position {
            if let Some(q) = self.positions[coordinate] {
                w.push((q + self.momenta, entry));
            }
            rate += entry * velocities[coordinate];
        }
        w.push((self.entropies + slot, -rate / theta));
        w
    }
}

/// Adds `factor w wᵀ` for a `w` with these entries.
fn add_rank_one(matrix: &mut DMatrix<f64>, factor: f64, w: &[(usize, f64)]) {
    for &(row, left) in w {
        for &(column, right) in w {
            matrix[(row, column)] += factor * (left * right);
        }
    }
}

impl<const D: usize> Simulation<D> {
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
    /// // z = (q, p, θ): ṗ has the part (∂s/∂θ)⁻¹ ∂s/∂λ ∂E/∂θ with ∂s/∂θ = c/θ.
    /// let entry = run.generic_in_temperature().reversible[(1, 2)];
    /// assert!((entry - 3.0 * 300.0 / 2.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn generic_in_temperature(&mut self) -> Generic {
        let (mut form, elements) = self.generic_and_elements();
        let indices = self.generic_indices();
        for slopes in elements
            .iter()
            .filter_map(|element| element.entropy.as_ref())
        {
            form.take_temperature(&indices, slopes);
        }
        form
    }
}

impl Generic {
    /// Replaces the entropy of an element by its temperature.
    fn take_temperature(&mut self, indices: &Indices, slopes: &EntropySlopes) {
        let own = indices.entropies + slopes.slot;
        let positions = slopes.by_position.iter();
        let positions = positions.filter_map(|&(coordinate, slope)| {
            indices.positions[coordinate].map(|place| (place, slope))
        });
        let dashpots = slopes.by_viscous.iter();
        let dashpots = dashpots.map(|&(slot, slope)| (indices.viscous + slot, slope));
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

//! The equations of a scene in GENERIC form.

use nalgebra::{DMatrix, DVector};

use super::Simulation;
use super::stepper::Stepper;
use crate::element::conduction::Partner;
use crate::element::group::{ElementGeneric, Elements};
use crate::element::state::State;
use crate::step::scheme::Scheme;
use eem_material::number::compensated::Compensated;
use eem_material::number::scalar::Real;

/// The GENERIC form of a scene: the two gradients and the two matrices of `ż = L ∇E + M ∇S`.
///
/// ```text
/// z = (q, p of the masses; γ of all dashpots; s of all elements; σ of all reservoirs)
/// L = −Lᵀ,   M = Mᵀ ≥ 0,   L ∇S = 0,   M ∇E = 0
/// ```
///
/// in the order of creation (Öttinger 2005; García Orden & Romero 2012). With temperatures in the place of entropies it is
/// that of Conde Martín, Betsch & García Orden (2016), see
/// [`generic_in_temperature`](Simulation::generic_in_temperature). With discrete derivatives in the place of ∇, `z¹ − z⁰ = h (L DE + M DS)`. Loads and
/// thermostats are not part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Generic<S: Real> {
    /// `∇E` or `DE`.
    pub energy_gradient: DVector<S>,
    /// `∇S` or `DS`.
    pub entropy_gradient: DVector<S>,
    /// L, the reversible part.
    pub reversible: DMatrix<S>,
    /// M, the irreversible part.
    pub irreversible: DMatrix<S>,
}

impl<const D: usize, S: Real> Simulation<D, S> {
    /// The state z of [`Generic`].
    #[must_use]
    pub fn generic_state(&self) -> DVector<S> {
        let masses = self
            .masses
            .iter()
            .enumerate()
            .filter(|(_, mass)| mass.is_some());
        let nodes = || {
            masses
                .clone()
                .flat_map(|(node, _)| node * D..(node + 1) * D)
        };
        let state = &self.state;
        let of = |sums: &Compensated<S>| sums.values().to_vec();
        let (q, p) = (state.positions.values(), state.momenta.values());
        let mechanical = nodes().map(|at| q[at]).chain(nodes().map(|at| p[at]));
        let internal = of(&state.viscous).into_iter().chain(of(&state.entropies));
        let z = mechanical
            .chain(internal)
            .chain(of(&state.reservoir_entropies));
        DVector::from_vec(z.collect())
    }

    /// Gradients and matrices at the present state.
    pub fn generic(&mut self) -> Generic<S> {
        self.generic_and_elements().0
    }

    /// The same with what the elements contribute to it.
    pub(super) fn generic_and_elements(&mut self) -> (Generic<S>, Vec<ElementGeneric<S>>) {
        // The elements look at another configuration than that of their last step.
        self.has_stepped = false;
        let state = &self.state;
        let mut elements = Vec::new();
        let each = |group: &mut dyn Elements<S, D>| elements.extend(group.generic_in(state));
        self.stepper.each_mut(each);
        let velocities = self.velocities_in(&self.state);
        (self.generic_from(&elements, &velocities), elements)
    }

    /// Discrete gradients and matrices of the last step; `None` before the first, after a failed
    /// one, and for a scheme that is not a discrete GENERIC system.
    #[must_use]
    pub fn generic_of_last_step(&self) -> Option<Generic<S>> {
        let discrete = matches!(self.in_use, Scheme::EemEntropy | Scheme::EemTemperature);
        if !(discrete && self.has_stepped) {
            return None;
        }
        let ends = [&*self.next, &*self.state];
        let Stepper::Newton(newton) = &self.stepper else {
            return None;
        };
        let elements = newton.groups.iter();
        let elements: Vec<_> = elements
            .flat_map(|group| group.generic_of_step(ends))
            .collect();
        let half = S::from_f64(0.5);
        let [old, new] = ends.map(|state| self.velocities_in(state));
        let mean: Vec<_> = old
            .iter()
            .zip(&new)
            .map(|(&old, &new)| half * (old + new))
            .collect();
        Some(self.generic_from(&elements, &mean))
    }

    /// v, m/s; zero for anchors.
    fn velocities_in(&self, state: &State<S>) -> Vec<S> {
        let nodes = self.masses.iter().enumerate();
        let of = |(node, mass): (usize, Option<S>)| {
            mass.map_or([S::zero(); D], |mass| state.velocity(node, mass))
        };
        nodes.flat_map(of).collect()
    }

    fn generic_from(&self, elements: &[ElementGeneric<S>], velocities: &[S]) -> Generic<S> {
        let places = self.generic_places();
        let size = places.size;
        let mut energy_gradient = DVector::from_element(size, S::zero());
        let mut entropy_gradient = energy_gradient.clone();
        let mut reversible = DMatrix::from_element(size, size, S::zero());
        let mut irreversible = reversible.clone();
        for (coordinate, place) in places.positions.iter().enumerate() {
            let Some(q) = *place else {
                continue;
            };
            let p = q + places.momenta;
            energy_gradient[p] = velocities[coordinate];
            reversible[(q, p)] = S::one();
            reversible[(p, q)] = -S::one();
        }
        for (slot, &theta) in self.conduction.reservoirs.iter().enumerate() {
            energy_gradient[places.reservoirs + slot] = theta;
            entropy_gradient[places.reservoirs + slot] = S::one();
        }
        let mut temperatures = vec![S::zero(); self.layout.thermal];
        for element in elements {
            for &(coordinate, force) in &element.forces {
                if let Some(q) = places.positions[coordinate] {
                    energy_gradient[q] += force;
                }
            }
            for &(slot, force, _) in &element.dashpots {
                energy_gradient[places.viscous + slot] = -force;
            }
            if let Some((slot, theta)) = element.temperature {
                energy_gradient[places.entropies + slot] = theta;
                entropy_gradient[places.entropies + slot] = S::one();
                temperatures[slot] = theta;
                for &(viscous, force, eta) in &element.dashpots {
                    let w = [
                        (places.viscous + viscous, S::one()),
                        (places.entropies + slot, force / theta),
                    ];
                    add_rank_one(&mut irreversible, theta / eta, &w);
                }
                for (eta, by_position) in &element.drags {
                    let w = places.drag(by_position, velocities, (slot, theta));
                    add_rank_one(&mut irreversible, *eta * theta, &w);
                }
            }
        }
        self.add_conduction(&places, &temperatures, &mut irreversible);
        Generic {
            energy_gradient,
            entropy_gradient,
            reversible,
            irreversible,
        }
    }

    /// `κ θ_a θ_b w wᵀ` with `w = e_a/θ_a − e_b/θ_b` for every path of heat.
    fn add_conduction(&self, places: &Places, temperatures: &[S], matrix: &mut DMatrix<S>) {
        for (slot, &theta) in temperatures.iter().enumerate() {
            for link in self.conduction.links(slot) {
                let (partner, other) = match link.partner {
                    // Each path between elements is listed at both ends.
                    Partner::Slot(partner) if partner < slot => continue,
                    Partner::Slot(partner) => (places.entropies + partner, temperatures[partner]),
                    Partner::Reservoir(index) => {
                        (places.reservoirs + index, self.conduction.reservoirs[index])
                    }
                };
                let w = [
                    (places.entropies + slot, theta.recip()),
                    (partner, -other.recip()),
                ];
                add_rank_one(matrix, link.conductance * theta * other, &w);
            }
        }
    }

    pub(super) fn generic_places(&self) -> Places {
        let mut positions = Vec::with_capacity(self.masses.len() * D);
        let mut masses = 0;
        for mass in self.masses.iter() {
            for _ in 0..D {
                positions.push(mass.map(|_| masses));
                masses += usize::from(mass.is_some());
            }
        }
        let viscous = 2 * masses;
        let entropies = viscous + self.layout.viscous;
        let reservoirs = entropies + self.layout.thermal;
        Places {
            positions,
            momenta: masses,
            viscous,
            entropies,
            reservoirs,
            size: reservoirs + self.conduction.reservoirs.len(),
        }
    }
}

/// Where the parts of z begin.
pub(super) struct Places {
    /// The place of each coordinate of a mass.
    pub(super) positions: Vec<Option<usize>>,
    momenta: usize,
    pub(super) viscous: usize,
    pub(super) entropies: usize,
    reservoirs: usize,
    size: usize,
}

impl Places {
    /// `w` of the dashpot beside a spring, `ηθ w wᵀ ∇S`: `ṗ = −η λ̇ ∂λ/∂q` and `ṡ = η λ̇²/θ`.
    fn drag<S: Real>(
        &self,
        by_position: &[(usize, S)],
        velocities: &[S],
        (slot, theta): (usize, S),
    ) -> Vec<(usize, S)> {
        let mut w = Vec::with_capacity(by_position.len() + 1);
        let mut rate = S::zero();
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
fn add_rank_one<S: Real>(matrix: &mut DMatrix<S>, factor: S, w: &[(usize, S)]) {
    for &(row, left) in w {
        for &(column, right) in w {
            matrix[(row, column)] += factor * (left * right);
        }
    }
}

//! Elements in the state that closes a step: temperatures from entropies, energies, and the rates with
//! which the next step begins.

use crate::element::conjugates::Infeasible;
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, measures_in};
use crate::element::group::certify::work_of;
use crate::element::group::explicit::closed::Closed;
use crate::element::group::explicit::point::ExplicitPoint;
use crate::element::group::explicit::rates::arms_of;
use crate::element::group::explicit::stage::Place;
use crate::element::group::explicit::temperature::Recovered;
use crate::element::group::explicit::view::ClosingView;
use crate::element::group::placed::admissible;
use crate::element::group::point::unless_infinite;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::state::Energy;
use eem_material::free_energy::{Array, Material};

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitPoint<M, K, D> {
    /// Adds its forces on places, and writes `γ̇` and `g γ̇` of its dashpots.
    pub(super) fn pull_at(
        &self,
        closed: &Closed<M, K, D>,
        (forces, creep): (&mut [[f64; D]], &mut [[f64; 2]]),
    ) {
        let mut pull = Arms::<K, D>::filled([0.0; D]);
        for a in 0..M::MEASURES {
            let force = closed.rates.forces[a];
            add_scaled::<K, D>(&mut pull, force, &closed.gradient[a]);
        }
        for (index, arm) in pull.as_ref().iter().enumerate() {
            for (axis, &pull) in arm.iter().enumerate() {
                forces[self.nodes[index + 1] as usize][axis] -= pull;
                forces[self.nodes[0] as usize][axis] += pull;
            }
        }
        for k in 0..self.model.dashpots() {
            let g = closed.rates.forces[M::MEASURES + k];
            let rate = g / closed.viscosities.0[k];
            creep[self.viscous(k)] = [rate, g * rate];
        }
    }

    /// Finds temperature and energy.
    #[inline]
    pub(super) fn close_at(
        &self,
        view: &mut ClosingView<'_, D>,
        closed: &mut Closed<M, K, D>,
    ) -> Result<(), StateError> {
        let r = &arms_of::<K, D>(&self.nodes, view.places, Place::q);
        let measures = admissible(&self.kinematics, self.element, r)?;
        let theta = self.temperature_in(view.stage);
        let x = self.variables_at(&measures, view.stage, theta);
        let at = self.model.rates_at(x);
        let thermal = self.slot();
        let free = thermal.filter(|&slot| !view.stage.is_held(slot));
        let stored = free.map(|slot| view.next.entropies.values()[slot]);
        let recovered = match stored {
            Some(entropy) => self.temperature_of(&x, &at, [entropy, theta], view.unkept)?,
            None => Recovered::given(theta, at(theta)),
        };
        let theta = recovered.theta;
        let (rates, [entropy, psi]) = recovered.evaluated;
        let mut found = Closed {
            theta,
            rates,
            viscosities: match M::DASHPOTS {
                0 => closed.viscosities,
                _ => self.model.viscosity(theta),
            },
            gradient: self.kinematics.gradient(r, &measures),
            values: closed.values,
        };
        unless_infinite(self.element, psi)?;
        let mut energy = Energy::without_temperature(psi);
        if let Some(slot) = thermal {
            let kept = stored.unwrap_or_else(|| {
                view.next.entropies.set(slot, entropy);
                entropy
            });
            let capacity = rates.forces[Self::TEMPERATURE];
            Infeasible::unless_stable(capacity, theta)
                .map_err(|infeasible| infeasible.of(self.element))?;
            // The energy is stationary in θ at the stored entropy: the last correction of θ does not change it.
            energy.value = psi + theta * kept;
            let heat = theta * (kept.abs() + capacity);
            energy.magnitude = energy.value.abs() + heat;
            energy.terms += heat;
            view.stage.inner[self.temperature()] = recovered.corrected;
            let caloric = &mut view.slots[slot];
            (caloric.capacity, caloric.bend) = (capacity, recovered.bend);
        }
        self.add_bounds_of(r, x, &mut found, &mut energy);
        *closed = found;
        self.write_energy(self.component, &energy, view);
        Ok(())
    }

    /// Adds the terms of a state with these arms that the bounds need, given its temperature and forces.
    #[inline]
    fn add_bounds_of(
        &self,
        r: &Arms<K, D>,
        mut x: M::Variables,
        found: &mut Closed<M, K, D>,
        energy: &mut Energy,
    ) {
        let forces = &found.rates.forces.as_ref()[..Self::TEMPERATURE];
        let measures = measures_in::<K::Measures>(&x);
        let sizes = self.kinematics.sizes(r, &measures);
        energy.add_forces(work_of(forces, sizes.as_ref(), &x));
        let theta = found.theta;
        energy.add_values(found.values.update(energy.terms, || {
            if self.model.is_thermal() {
                x[Self::TEMPERATURE] = theta;
            }
            self.model.energy_magnitude(&x)
        }));
    }

    /// Writes the energy in a new state and adds it to that of the component.
    #[inline]
    fn write_energy(&self, component: u32, energy: &Energy, view: &mut ClosingView<'_, D>) {
        view.energies[component as usize].add(energy);
        let stored = &mut view.next.energies[self.element.index()];
        stored.value = energy.value;
        stored.magnitude = energy.magnitude;
        stored.terms = energy.terms;
        stored.excess = energy.excess;
    }
}

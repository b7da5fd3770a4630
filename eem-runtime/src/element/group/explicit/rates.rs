//! Forces and rates of elements at a stage.
//!
//! ```text
//! γ̇ = g/η,     Q = Σ g γ̇ + heat that flows in,     θ̇ = (Q − θ (s_λ λ̇ + Σ s_γ γ̇))/c
//! ```

use crate::element::conjugates::{Infeasible, PointRule};
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, along};
use crate::element::group::explicit::group::FreeGroup;
use crate::element::group::explicit::view::{StageRates, StageView};
use crate::element::group::point::Point;
use crate::element::kinematics::{Arms, Gradient, Kinematics, Measures};
use eem_material::free_energy::{Array, FreeEnergy, Material, Rates};
use eem_material::number::scalar::{Mask, Real, is_positive};

/// What the rates of a point follow from.
pub(super) struct Found<'a, S: Real, M: FreeEnergy<S>, K: Kinematics<S, D>, const D: usize> {
    pub(super) theta: S,
    pub(super) rates: &'a Rates<M::Variables>,
    pub(super) viscosities: &'a M::Viscosities,
    pub(super) gradient: &'a Gradient<K, S, D>,
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> FreeGroup<S, M, K, D> {
    /// See [`ExplicitGroup::rates`](super::ExplicitGroup::rates).
    pub(super) fn rates_of_all(
        &self,
        view: &StageView<'_, S>,
        rates: &mut StageRates<'_, S>,
    ) -> Result<(), StateError> {
        for (member, nodes) in self.elements.members.iter().zip(&self.places) {
            // Positions and velocities are the first parts of their vectors.
            let r = arms_of::<K, S, D>(nodes, view.y);
            let motion = arms_of::<K, S, D>(nodes, rates.row);
            let mut pull = Arms::<K, S, D>::filled([S::zero(); D]);
            for point in member.points.as_ref() {
                point.add_rates(view, [&r, &motion], rates, &mut pull)?;
            }
            pull_nodes::<K, S, D>(nodes, &pull, &mut rates.row[view.offsets.momenta..]);
        }
        Ok(())
    }
}

/// The arms of an element, or their rates, from coordinates stored node after node.
#[inline]
pub(super) fn arms_of<K: Kinematics<S, D>, S: Real, const D: usize>(
    nodes: &K::PerNode<u32>,
    coordinates: &[S],
) -> Arms<K, S, D> {
    let points = coordinates.as_chunks::<D>().0;
    let first = &points[nodes[0] as usize];
    let mut arms = Arms::<K, S, D>::filled([S::zero(); D]);
    for (index, arm) in arms.as_mut().iter_mut().enumerate() {
        let other = &points[nodes[index + 1] as usize];
        for axis in 0..D {
            arm[axis] = other[axis] - first[axis];
        }
    }
    arms
}

/// Subtracts a pull along the arms from the forces on the nodes.
#[inline]
pub(super) fn pull_nodes<K: Kinematics<S, D>, S: Real, const D: usize>(
    nodes: &K::PerNode<u32>,
    pull: &Arms<K, S, D>,
    forces: &mut [S],
) {
    let points = forces.as_chunks_mut::<D>().0;
    for (index, arm) in pull.as_ref().iter().enumerate() {
        let force = &mut points[nodes[index + 1] as usize];
        for axis in 0..D {
            force[axis] -= arm[axis];
        }
        let force = &mut points[nodes[0] as usize];
        for axis in 0..D {
            force[axis] += arm[axis];
        }
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> Point<S, M, K, PointRule, D> {
    /// The variables at a stage with these measures.
    #[inline]
    pub(super) fn variables_at(
        &self,
        measures: &Measures<K, S, D>,
        viscous: &[S],
        theta: S,
    ) -> M::Variables {
        let mut x = M::Variables::filled(S::zero());
        for (a, &measure) in measures.as_ref().iter().enumerate() {
            x[a] = measure;
        }
        let first = self.slots().viscous;
        for k in 0..M::DASHPOTS {
            x[M::MEASURES + k] = viscous[first + k];
        }
        if M::THERMAL {
            x[Self::TEMPERATURE] = theta;
        }
        x
    }

    /// Its temperature at a stage; zero without.
    #[inline]
    pub(super) fn temperature_in(&self, temperatures: &[S]) -> S {
        match self.slots().thermal {
            Some(slot) => temperatures[slot],
            None => S::zero(),
        }
    }

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "arms and pull stay in registers")]
    fn add_rates(
        &self,
        view: &StageView<'_, S>,
        [r, motion]: [&Arms<K, S, D>; 2],
        rates: &mut StageRates<'_, S>,
        pull: &mut Arms<K, S, D>,
    ) -> Result<(), StateError> {
        let measures = self.kinematics.measure(r);
        let gradient = self.kinematics.gradient(r, &measures);
        let theta = self.temperature_in(&view.y[view.offsets.temperatures..]);
        let x = self.variables_at(&measures, &view.y[view.offsets.viscous..], theta);
        let found = self.model.rates(&x);
        let viscosities = if M::DASHPOTS > 0 {
            self.model.viscosity(theta).0
        } else {
            M::Viscosities::filled(S::zero())
        };
        let found = Found {
            theta,
            rates: &found,
            viscosities: &viscosities,
            gradient: &gradient,
        };
        let is_sound = self.write_rates(view, motion, &found, rates, pull);
        if is_sound && self.kinematics.is_admissible(r, &measures) {
            return Ok(());
        }
        Err(self.refuse(&found, r, &measures))
    }

    /// Adds its pull, and writes its rates; whether all of them are numbers.
    #[inline(always)]
    #[expect(
        clippy::inline_always,
        reason = "what was found stays in registers, and there are two callers"
    )]
    pub(super) fn write_rates(
        &self,
        view: &StageView<'_, S>,
        motion: &Arms<K, S, D>,
        found: &Found<'_, S, M, K, D>,
        rates: &mut StageRates<'_, S>,
        pull: &mut Arms<K, S, D>,
    ) -> bool {
        let Rates { forces, slopes } = found.rates;
        let (mut drift, mut power) = (S::zero(), S::zero());
        for a in 0..M::MEASURES {
            add_scaled::<K, S, D>(pull, forces[a], &found.gradient[a]);
            let speed = along::<K, S, D>(&found.gradient[a], motion);
            power += forces[a] * speed;
            drift += slopes[a] * speed;
        }
        let first = self.slots().viscous;
        let creeping = view.offsets.viscous + first;
        let (mut heat, mut is_sound) = (S::zero(), true);
        for k in 0..M::DASHPOTS {
            let g = forces[M::MEASURES + k];
            let creep = g / found.viscosities[k];
            rates.row[creeping + k] = creep;
            rates.powers[first + k] = g * creep;
            heat += g * creep;
            drift += slopes[M::MEASURES + k] * creep;
            is_sound &= S::zero().less(found.viscosities[k]).all() && creep.is_finite();
        }
        let Some(slot) = self.slots().thermal else {
            return is_sound && power.is_finite();
        };
        let capacity = forces[Self::TEMPERATURE];
        let heated = view.offsets.temperatures + slot;
        let flow = rates.row[heated];
        let heating = (flow + heat - found.theta * drift) / capacity;
        if let Some(supply) = rates.supply.get_mut(slot) {
            *supply = power + flow;
        }
        let is_held = view.held.get(slot).copied().unwrap_or(false);
        rates.row[heated] = if is_held { S::zero() } else { heating };
        let is_stable = S::zero().less(capacity) & S::zero().less(found.theta);
        is_sound && is_stable.all() && heating.is_finite()
    }

    /// Why there are no rates.
    #[cold]
    pub(super) fn refuse(
        &self,
        found: &Found<'_, S, M, K, D>,
        r: &Arms<K, S, D>,
        measures: &Measures<K, S, D>,
    ) -> StateError {
        let element = self.element;
        if !self.kinematics.is_admissible(r, measures) {
            return self.kinematics.refusal(element, r);
        }
        let theta = found.theta;
        if M::THERMAL && !is_positive(theta) {
            let value = theta.to_f64();
            return StateError::Temperature { element, value };
        }
        if M::THERMAL
            && let Err(infeasible) =
                Infeasible::unless_stable(found.rates.forces[Self::TEMPERATURE], theta)
        {
            return infeasible.of(element);
        }
        let viscosities = found.viscosities.as_ref().iter().enumerate();
        for (dashpot, &eta) in viscosities {
            if !is_positive(eta) {
                return StateError::Viscosity {
                    element,
                    dashpot,
                    value: eta.to_f64(),
                    unit: K::VISCOSITY_UNIT,
                    temperature: M::THERMAL.then(|| theta.to_f64()),
                };
            }
        }
        StateError::NotFinite {
            element,
            quantity: "rate of change",
            value: found.rates.forces[0].to_f64(),
        }
    }
}

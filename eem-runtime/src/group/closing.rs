//! The end of a step: increments of all variables from the found forces, temperatures and rates.
//!
//! Newton's method leaves an error in the trial state. Taking `f*`, `g*` and `θ*` as given and
//! evaluating the remaining relations explicitly from them makes the balances of momentum and
//! entropy hold to rounding whatever that error is, and leaves the energy with its square.

use super::arms::{arms, measures_in, resultant, spread};
use super::member::Member;
use super::pose::Pose;
use super::site::{Contact, SecantSite, Site};
use super::{Along, ElementGroup, StepView, Trial};
use crate::conduction::Partner;
use crate::free_energy::{Array, FreeEnergy};
use crate::impulse::Impulses;
use crate::kinematics::{Arms, Kinematics, Weights};
use crate::scalar::Real;
use crate::scheme::{ElementScheme, Placement};
use crate::state::State;
use crate::system::Parts;

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// See [`Group::add_secant`](super::Group::add_secant).
    pub(super) fn add_secant_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        (values, right): Parts<'_, S, D>,
    ) {
        let share = S::from_f64(0.5);
        for (at, member) in self.members.iter().enumerate() {
            let weights = member.secant(self.kinematics);
            let mut known = member.r0;
            let site = &member.site;
            site.add_anchors(&mut known, &trial.displacements, share);
            let secant = match self.secants.get(at) {
                Some(secant) => *secant,
                None => SecantSite::in_tangent(site),
            };
            secant.add_matrix(&site.is_mass, &weights, share * view.step, &mut *values);
            site.subtract_known(&weights, (&known, view.step), &mut *right);
        }
    }

    /// See [`Group::add_impulse`](super::Group::add_impulse).
    pub(super) fn add_impulse_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        along: Along,
        impulses: &mut Impulses<'_, S, D>,
    ) {
        let at = match along {
            Along::Secant => None,
            Along::Scheme => Some(C::PLACEMENT),
            Along::Gradient => Some(Placement::End),
        };
        for member in &self.members {
            let (nodes, r0) = (&member.site.nodes, &member.r0);
            let (h, force) = if let Some(at) = at {
                let r1 = member.new_arms(trial);
                let share = view.step * S::from_f64(C::IMPLICIT);
                (share, member.force(self.kinematics, at, [r0, &r1]))
            } else {
                let mut mean = arms::<K, S, D>(nodes, &trial.displacements);
                for (mean, old) in mean.as_mut().iter_mut().zip(r0.as_ref()) {
                    for (mean, &old) in mean.iter_mut().zip(old) {
                        *mean = old + S::from_f64(0.5) * *mean;
                    }
                }
                let weights = member.secant(self.kinematics);
                (view.step, pull::<K, S, D>(&weights, &mean))
            };
            for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                for (impulse, &force) in impulses.of(node as usize).iter_mut().zip(force) {
                    *impulse -= h * force;
                }
            }
        }
    }
}

/// The nodal forces `A r`, which sum to zero exactly and do not depend on where the origin is.
#[inline]
pub(super) fn pull<K: Kinematics<S, D>, S: Real, const D: usize>(
    weights: &Weights<K, S, D>,
    r: &Arms<K, S, D>,
) -> K::PerNode<[S; D]> {
    spread::<K, S, D>(&pull_of_arms::<K, S, D>(weights, r))
}

/// The same per arm: those of the nodes but the first.
#[inline]
fn pull_of_arms<K: Kinematics<S, D>, S: Real, const D: usize>(
    weights: &Weights<K, S, D>,
    r: &Arms<K, S, D>,
) -> Arms<K, S, D> {
    let mut force = Arms::<K, S, D>::filled([S::zero(); D]);
    for (force, row) in force.as_mut().iter_mut().zip(weights.as_ref()) {
        for (&weight, arm) in row.as_ref().iter().zip(r.as_ref()) {
            for axis in 0..D {
                force[axis] += weight * arm[axis];
            }
        }
    }
    force
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Site<K, S, D> {
    /// Adds the fraction `share` of the motion of anchors, which is known, to arms.
    #[inline]
    pub(super) fn add_anchors(&self, arms: &mut Arms<K, S, D>, moved: &[[S; D]], share: S) {
        for (i, arm) in arms.as_mut().iter_mut().enumerate() {
            for (node, share) in [(i + 1, share), (0, -share)] {
                if !self.is_mass[node] {
                    let moved = &moved[self.nodes[node] as usize];
                    for (arm, &moved) in arm.iter_mut().zip(moved) {
                        *arm += share * moved;
                    }
                }
            }
        }
    }

    /// Subtracts the impulse `h A r` of known arms from the nodes that move.
    #[inline]
    pub(super) fn subtract_known(
        &self,
        weights: &Weights<K, S, D>,
        (known, h): (&Arms<K, S, D>, S),
        right: &mut [[S; D]],
    ) {
        let force = pull_of_arms::<K, S, D>(weights, known);
        for (i, force) in force.as_ref().iter().enumerate() {
            for (node, h) in [(i + 1, -h), (0, h)] {
                if self.is_mass[node] {
                    let right = &mut right[self.rows[node] as usize / D];
                    for (right, &force) in right.iter_mut().zip(force) {
                        *right += h * force;
                    }
                }
            }
        }
    }
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> SecantSite<K, S, D> {
    /// Adds the matrix `factor A` of nodal forces `A r` for the nodes that move.
    #[inline]
    pub(super) fn add_matrix(
        &self,
        is_mass: &K::PerNode<bool>,
        weights: &Weights<K, S, D>,
        factor: S,
        values: &mut [S],
    ) {
        let mut add = |[i, j]: [usize; 2], entry: S| {
            if is_mass[i] && is_mass[j] {
                values[self.entries[i][j] as usize] += entry;
            }
        };
        for (i, row) in weights.as_ref().iter().enumerate() {
            for (j, &weight) in row.as_ref().iter().enumerate() {
                let entry = factor * weight;
                add([i + 1, j + 1], entry);
                add([i + 1, 0], -entry);
                add([0, j + 1], -entry);
                add([0, 0], entry);
            }
        }
    }
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// A of the force `A r_m` at the found response.
    #[inline]
    fn secant(&self, kinematics: K) -> Weights<K, S, D> {
        let measures = measures_in::<K, S, D>(&self.x);
        let old = match C::PLACEMENT {
            Placement::Middle => measures,
            Placement::Ends | Placement::End | Placement::Start => {
                measures_in::<K, S, D>(&self.start.x0)
            }
        };
        kinematics.secant(&old, &measures, &measures_in::<K, S, D>(&self.response))
    }

    /// The nodal forces of the found response along the gradient between two configurations, N.
    pub(super) fn force(
        &self,
        kinematics: K,
        at: Placement,
        ends: [&Arms<K, S, D>; 2],
    ) -> K::PerNode<[S; D]> {
        let measures0 = measures_in::<K, S, D>(&self.start.x0);
        let pose = Pose::between(kinematics, at, ends, measures0);
        resultant::<K, S, D>(&pose.direction, &measures_in::<K, S, D>(&self.response))
    }

    /// The increments of the internal variables and of the reservoirs' entropies; returns the
    /// entropy that dashpots and conduction gave the element, J/K.
    #[inline]
    pub(super) fn close(
        &self,
        view: &StepView<'_, S>,
        contact: Option<&Contact<K, S, D>>,
        seen_temperatures: &[S],
        next: &mut State<S>,
    ) -> S {
        let (h, share) = (view.thermal_step(), S::from_f64(C::IMPLICIT));
        let slots = self.slots();
        let mut heat = S::zero();
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            let rate = self.response[index] / self.viscosities.0[k];
            heat += self.response[index] * rate;
            let change = self.increment(index, rate, h);
            next.viscous
                .advance(slots.viscous + k, &view.state.viscous, change);
        }
        let Some(slot) = slots.thermal else {
            if M::DASHPOTS > 0 {
                let lost = h * (share * heat + self.old_dissipation());
                next.dissipated.add(lost);
            }
            return S::zero();
        };
        let theta = self.temperature();
        heat += self.heat_flow(view, contact, seen_temperatures, theta).heat;
        if self.meets_reservoirs {
            self.warm_reservoirs(view, slot, next);
        }
        let received = self.increment(Self::TEMPERATURE, heat / theta, h);
        let entropies = &view.state.entropies;
        next.entropies.advance(slot, entropies, received);
        received
    }

    /// What flows to the reservoirs.
    fn warm_reservoirs(&self, view: &StepView<'_, S>, slot: usize, next: &mut State<S>) {
        let (h, share) = (view.thermal_step(), S::from_f64(C::IMPLICIT));
        for link in view.conduction.links(slot) {
            if let Partner::Reservoir(index) = link.partner {
                let theta_r = view.conduction.reservoirs[index];
                let old = view.state.temperatures[slot];
                let seen = share * self.temperature() + (S::one() - share) * old;
                let flow = link.conductance * (seen - theta_r);
                next.reservoir_entropies.add(index, h * flow / theta_r);
            }
        }
    }
}

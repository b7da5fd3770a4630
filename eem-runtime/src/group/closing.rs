//! The end of a step: increments of all variables from the found forces, temperatures and rates.
//!
//! Newton's method leaves an error in the trial state. Taking `f*`, `g*` and `θ*` as given and
//! evaluating the remaining relations explicitly from them makes the balances of momentum and
//! entropy hold to rounding whatever that error is, and leaves the energy with its square.

use super::member::Member;
use super::pose::{Pose, arms, measures_in, points, resultant, spread};
use super::site::Site;
use super::{Along, ElementGroup, StepView, Trial};
use crate::conduction::Partner;
use crate::free_energy::{Array, FreeEnergy};
use crate::kinematics::{Arms, Kinematics, Weights};
use crate::scalar::Real;
use crate::scheme::{ElementScheme, Placement};
use crate::state::State;
use crate::system::LinearSystem;

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
        system: &mut LinearSystem<S, D>,
    ) {
        let share = S::from_f64(0.5);
        let old = points(view.state.positions.values());
        let (values, right) = system.parts();
        for member in &self.members {
            let weights = member.secant(self.kinematics);
            let known = member.site.known(old, &trial.displacements, share);
            let matrix = share * view.step;
            member.site.add_secant(&weights, matrix, &mut *values);
            member
                .site
                .subtract_known(&weights, &known, view.step, &mut *right);
        }
    }

    /// See [`Group::add_impulse`](super::Group::add_impulse).
    pub(super) fn add_impulse_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S, D>,
        along: Along,
        impulse: &mut [[S; D]],
    ) {
        let old = points(view.state.positions.values());
        for member in &self.members {
            let nodes = &member.site.nodes;
            let r0 = arms::<K, S, D>(nodes, old);
            let (h, force) = if along == Along::Secant {
                let mut mean = arms::<K, S, D>(nodes, &trial.displacements);
                for (mean, old) in mean.as_mut().iter_mut().zip(r0.as_ref()) {
                    for (mean, &old) in mean.iter_mut().zip(old) {
                        *mean = old + S::from_f64(0.5) * *mean;
                    }
                }
                let weights = member.secant(self.kinematics);
                (view.step, pull::<K, S, D>(&weights, &mean))
            } else {
                let r1 = arms::<K, S, D>(nodes, &trial.positions);
                let at = match along {
                    Along::Gradient => Placement::End,
                    Along::Secant | Along::Scheme => C::PLACEMENT,
                };
                let share = view.step * S::from_f64(C::IMPLICIT);
                (share, member.force(self.kinematics, at, [&r0, &r1]))
            };
            for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                for (impulse, &force) in impulse[node].iter_mut().zip(force) {
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
    let mut force = Arms::<K, S, D>::filled([S::zero(); D]);
    for (force, row) in force.as_mut().iter_mut().zip(weights.as_ref()) {
        for (&weight, arm) in row.as_ref().iter().zip(r.as_ref()) {
            for axis in 0..D {
                force[axis] += weight * arm[axis];
            }
        }
    }
    spread::<K, S, D>(&force)
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Site<K, S, D> {
    /// The old arms, with the fraction `share` of the motion of anchors, which is known.
    #[inline]
    pub(super) fn known(&self, old: &[[S; D]], moved: &[[S; D]], share: S) -> Arms<K, S, D> {
        let mut known = arms::<K, S, D>(&self.nodes, old);
        for (i, known) in known.as_mut().iter_mut().enumerate() {
            for (axis, known) in known.iter_mut().enumerate() {
                let shift = |i: usize| {
                    let moved = moved[self.nodes[i]][axis];
                    if self.is_mass[i] { S::zero() } else { moved }
                };
                *known += share * (shift(i + 1) - shift(0));
            }
        }
        known
    }

    /// Adds the matrix `factor A` of nodal forces `A r`.
    #[inline]
    pub(super) fn add_secant(&self, weights: &Weights<K, S, D>, factor: S, values: &mut [S]) {
        for (i, row) in weights.as_ref().iter().enumerate() {
            for (j, &weight) in row.as_ref().iter().enumerate() {
                let entry = factor * weight;
                values[self.secant[i + 1][j + 1]] += entry;
                values[self.secant[i + 1][0]] -= entry;
                values[self.secant[0][j + 1]] -= entry;
                values[self.secant[0][0]] += entry;
            }
        }
    }

    /// Subtracts the impulse `h A r` of known arms.
    #[inline]
    pub(super) fn subtract_known(
        &self,
        weights: &Weights<K, S, D>,
        known: &Arms<K, S, D>,
        h: S,
        right: &mut [[S; D]],
    ) {
        let force = pull::<K, S, D>(weights, known);
        for (&row, force) in self.secant_rows.as_ref().iter().zip(force.as_ref()) {
            for (right, &force) in right[row].iter_mut().zip(force) {
                *right -= h * force;
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
        kinematics.secant(
            &old,
            &measures,
            &measures_in::<K, S, D>(&self.answer.response),
        )
    }

    /// The nodal forces of the found response along the gradient between two configurations, N.
    pub(super) fn force(
        &self,
        kinematics: K,
        at: Placement,
        ends: [&Arms<K, S, D>; 2],
    ) -> K::PerNode<[S; D]> {
        let measures0 = measures_in::<K, S, D>(&self.start.x0);
        let pose = Pose::new(kinematics, at, ends, measures0);
        resultant::<K, S, D>(
            &pose.direction,
            &measures_in::<K, S, D>(&self.answer.response),
        )
    }

    /// The increments of the internal variables and of the reservoirs' entropies.
    #[inline]
    pub(super) fn close(
        &mut self,
        view: &StepView<'_, S>,
        seen_temperatures: &[S],
        next: &mut State<S>,
    ) {
        let (h, share) = (view.thermal_step(), S::from_f64(C::IMPLICIT));
        let mut heat = S::zero();
        for k in 0..M::DASHPOTS {
            let g = self.answer.response[M::MEASURES + k];
            let rate = g / self.viscosities.0[k];
            heat += g * rate;
            let old_rate = self.old_rates[M::MEASURES + k];
            let (at, change) = (self.slots.viscous + k, h * (share * rate + old_rate));
            next.viscous.advance(at, &view.state.viscous, change);
        }
        let Some(slot) = self.slots.thermal else {
            if M::DASHPOTS > 0 {
                let lost = h * (share * heat + self.old_dissipation());
                next.dissipated.add(lost);
            }
            return;
        };
        let theta = self.temperature();
        let flow = view.conduction.heat_flow(slot, theta, seen_temperatures);
        heat += flow.heat;
        let old_rate = self.old_rates[Self::TEMPERATURE];
        self.entropy_received = h * (share * heat / theta + old_rate);
        let entropies = &view.state.entropies;
        next.entropies
            .advance(slot, entropies, self.entropy_received);
        for link in view.conduction.links(slot) {
            if let Partner::Reservoir(index) = link.partner {
                let theta_r = view.conduction.reservoirs[index];
                let seen = share * theta + (S::one() - share) * view.state.temperatures[slot];
                let flow = link.conductance * (seen - theta_r);
                next.reservoir_entropies.add(index, h * flow / theta_r);
            }
        }
    }
}

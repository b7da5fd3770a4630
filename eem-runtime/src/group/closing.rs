//! The end of a step: increments of all variables from the found forces, temperatures and rates.
//!
//! Newton's method leaves an error in the trial state. Taking `f*`, `g*` and `θ*` as given and
//! evaluating the remaining relations explicitly from them makes the balances of momentum and
//! entropy hold to rounding whatever that error is, and leaves the energy with its square.

use super::member::Member;
use super::pose::{Pose, gather, points};
use super::{Along, ElementGroup, StepView, Trial};
use crate::conduction::Partner;
use crate::free_energy::{Array, FreeEnergy};
use crate::kinematics::{Kinematics, Measures, Points, Weights};
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
        let h = view.step;
        let half = S::from_f64(0.5);
        let old = points(view.state.positions.values());
        let (values, right) = system.parts();
        for member in &mut self.members {
            let site = &member.site;
            // q⁰ of masses, q_m of anchors.
            let mut known = gather::<K, S, D>(&site.nodes, old);
            for (i, known) in known.as_mut().iter_mut().enumerate() {
                if !site.is_mass[i] {
                    let displacement = &trial.displacements[site.nodes[i]];
                    for (known, &change) in known.iter_mut().zip(displacement) {
                        *known += half * change;
                    }
                }
            }
            let weights = member.secant(self.kinematics);
            let force = pull::<K, S, D>(&weights, &known);
            for (i, force) in force.as_ref().iter().enumerate() {
                for (right, &force) in right[site.secant_rows[i]].iter_mut().zip(force) {
                    *right -= h * force;
                }
                for (j, &weight) in weights[i].as_ref().iter().enumerate() {
                    values[site.secant[i][j]] += half * h * weight;
                }
            }
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
            let q0 = gather::<K, S, D>(nodes, old);
            let (h, force) = if along == Along::Secant {
                let mut mean = gather::<K, S, D>(nodes, &trial.displacements);
                for (mean, old) in mean.as_mut().iter_mut().zip(q0.as_ref()) {
                    for (mean, &old) in mean.iter_mut().zip(old) {
                        *mean = old + S::from_f64(0.5) * *mean;
                    }
                }
                let weights = member.secant(self.kinematics);
                (view.step, pull::<K, S, D>(&weights, &mean))
            } else {
                let q1 = gather::<K, S, D>(nodes, &trial.positions);
                let at = match along {
                    Along::Gradient => Placement::End,
                    Along::Secant | Along::Scheme => C::PLACEMENT,
                };
                let share = view.step * S::from_f64(C::IMPLICIT);
                (share, member.force(self.kinematics, at, [&q0, &q1]))
            };
            for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                for (impulse, &force) in impulse[node].iter_mut().zip(force) {
                    *impulse -= h * force;
                }
            }
        }
    }
}

/// `A q` with `Σ_j A_ij = 0`: `Σ_j A_ij (q_j − q_i)`, which sums to zero over the nodes exactly as
/// far as A is symmetric, and does not depend on where the origin is.
#[inline]
fn pull<K: Kinematics<S, D>, S: Real, const D: usize>(
    weights: &Weights<K, S, D>,
    q: &Points<K, S, D>,
) -> Points<K, S, D> {
    let mut force = Points::<K, S, D>::filled([S::zero(); D]);
    for (i, force) in force.as_mut().iter_mut().enumerate() {
        for (j, other) in q.as_ref().iter().enumerate() {
            if j == i {
                continue;
            }
            let weight = weights[i][j];
            for (axis, force) in force.iter_mut().enumerate() {
                *force += weight * (other[axis] - q[i][axis]);
            }
        }
    }
    force
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// Numbers per measure, from the first of an array.
    #[inline]
    pub(super) fn measures_in<A: Array<S>>(values: &A) -> Measures<K, S, D> {
        let mut measures = Measures::<K, S, D>::filled(S::zero());
        for (a, measure) in measures.as_mut().iter_mut().enumerate() {
            *measure = values[a];
        }
        measures
    }

    /// A of the nodal force `A q_m` at the found response.
    #[inline]
    fn secant(&self, kinematics: K) -> Weights<K, S, D> {
        let measures = Self::measures_in(&self.x);
        let old = match C::PLACEMENT {
            Placement::Middle => measures,
            Placement::Ends | Placement::End | Placement::Start => {
                Self::measures_in(&self.start.x0)
            }
        };
        kinematics.secant(&old, &measures, &Self::measures_in(&self.response))
    }

    /// The nodal forces of the found response along the gradient between two configurations, N.
    pub(super) fn force(
        &self,
        kinematics: K,
        at: Placement,
        ends: [&Points<K, S, D>; 2],
    ) -> Points<K, S, D> {
        let measures0 = Self::measures_in(&self.start.x0);
        let pose = Pose::new(kinematics, at, ends, measures0);
        let mut force = Points::<K, S, D>::filled([S::zero(); D]);
        for (a, row) in pose.direction.as_ref().iter().enumerate() {
            for (force, entry) in force.as_mut().iter_mut().zip(row.as_ref()) {
                for (force, &entry) in force.iter_mut().zip(entry) {
                    *force += self.response[a] * entry;
                }
            }
        }
        force
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
            let g = self.response[M::MEASURES + k];
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
        next.entropies.advance(slot, entropies, self.entropy_received);
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

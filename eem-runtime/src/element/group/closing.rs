//! The end of a step: impulses of the forces, and increments of the internal variables.
//!
//! ```text
//! γ¹ = γ⁰ + Δγ
//! s¹ = s⁰ + Σ η Δγ²/(hθ*) + Σ u + Σ P
//! ```
//!
//! with the exchange `u` and the production `P ≥ 0` of every path of heat, see
//! [`conduction`](crate::element::conduction). Both ends of a path use the same numbers.

use super::arms::{mean, measures_in, spread};
use super::member::Member;
use super::placed::PlacedPoint;
use super::point::Point;
use super::pose::Pose;
use super::site::{Contact, HeatPath, paths_of};
use super::ways::way_of_nodes;
use crate::element::balances::{Balances, Received, reservoir_correction};
use crate::element::conduction::{InterfaceTemperatures, Partner};
use crate::element::conjugates::{Any, Family, Placement};
use crate::element::error::StateError;
use crate::element::group::view::{StepView, Trial};
use crate::element::kinematics::{Arms, Ends, Kinematics, MeasureSet, Weights};
use crate::element::state::State;
use crate::element::tally::{Care, Tally};
use eem_material::arrays::Arrays;
use eem_material::free_energy::{Array, Caloric};

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// The nodal forces of the last responses along the gradient between two configurations, N.
    pub(super) fn force(&self, at: Placement, ends: [&Arms<K, D>; 2]) -> K::PerNode<[f64; D]> {
        let mut sum = None;
        for point in self.points.as_ref() {
            sum_nodes::<K, D>(&mut sum, point.force(at, ends));
        }
        sum.unwrap_or_else(|| K::PerNode::filled([0.0; D]))
    }

    /// The nodal forces of the last responses in the form `A r_m`, N.
    #[inline]
    pub(super) fn pull<C: Family>(
        &self,
        ends: [&Arms<K, D>; 2],
        mean: &Arms<K, D>,
    ) -> K::PerNode<[f64; D]> {
        let mut sum: Option<Weights<K, D>> = None;
        for point in self.points.as_ref() {
            let own = point.secant::<C>(ends);
            let Some(sum) = &mut sum else {
                sum = Some(own);
                continue;
            };
            for (sum, own) in sum.as_mut().iter_mut().zip(own.as_ref()) {
                for (sum, &own) in sum.as_mut().iter_mut().zip(own.as_ref()) {
                    *sum += own;
                }
            }
        }
        match sum {
            Some(weights) => pull::<K, D>(&weights, mean),
            None => K::PerNode::filled([0.0; D]),
        }
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// Books the step, recovers the new temperature and judges the step. The caloric quantities at the temperature of the
    /// trial may be known.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 0.8 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn close<C: Family>(
        &mut self,
        contacts: &[Contact<K, D>],
        (view, trial): (&StepView<'_>, &Trial<D>),
        next: &mut State,
        tally: &mut Tally,
        known: Option<&(Caloric<f64>, f64)>,
    ) -> Result<(), StateError> {
        let r1 = self.arms_in(next);
        for point in self.points.as_mut() {
            let paths = paths_of(point.contact_in(contacts));
            let received = point.book::<C>(view, (paths, &trial.interface), next, tally);
            let near = (point.x[A::Variables::LEN - 1], known);
            let measures = point.admissible_measures(&r1)?;
            if let Some(entropy) = point.recover_temperature::<C>(&measures, view, near, next)? {
                point.book_thermostat(view, [entropy, received.entropy], next);
            }
            if C::is_exact(point.scheme) {
                let sizes = [
                    point.sizes(&self.r0, &point.start.x0),
                    point.sizes(&r1, &point.x),
                ];
                let largest = point.largest_pull::<C>(&r1);
                let nodes = self.site.nodes.as_ref();
                let is_thorough = matches!(tally.care, Care::Thorough);
                let of_sums = is_thorough.then(|| largest * way_of_nodes(nodes, trial));
                let [forces, at_end] = point.amplitude::<C>(&sizes, of_sums);
                tally.force(forces);
                tally.exchange(view.step * largest);
                let energy = &mut next.energies[point.element.index()];
                energy.add_secants(at_end, point.is_thermal());
                let terms = [energy.magnitude + forces, energy.heat_capacity];
                let outside = (paths, &trial.interface);
                point.judge::<C>(view, outside, &sizes[1], (received, terms), tally);
            }
        }
        Ok(())
    }
}

/// Adds the nodal forces of a point to those of the points before it.
#[inline]
fn sum_nodes<K: Kinematics<D>, const D: usize>(
    sum: &mut Option<K::PerNode<[f64; D]>>,
    own: K::PerNode<[f64; D]>,
) {
    let Some(sum) = sum else {
        *sum = Some(own);
        return;
    };
    let own = own.as_ref().as_flattened();
    for (sum, &own) in sum.as_mut().as_flattened_mut().iter_mut().zip(own) {
        *sum += own;
    }
}

/// The nodal forces `A r`, which sum to zero exactly and do not depend on the origin.
#[inline]
pub(super) fn pull<K: Kinematics<D>, const D: usize>(
    weights: &Weights<K, D>,
    r: &Arms<K, D>,
) -> K::PerNode<[f64; D]> {
    spread::<K, D>(&pull_of_arms::<K, D>(weights, r))
}

/// The same per arm: the forces on all nodes except the first.
#[inline]
pub(super) fn pull_of_arms<K: Kinematics<D>, const D: usize>(
    weights: &Weights<K, D>,
    r: &Arms<K, D>,
) -> Arms<K, D> {
    let mut force = Arms::<K, D>::filled([0.0; D]);
    for (force, row) in force.as_mut().iter_mut().zip(weights.as_ref()) {
        for (&weight, arm) in row.as_ref().iter().zip(r.as_ref()) {
            for axis in 0..D {
                force[axis] += weight * arm[axis];
            }
        }
    }
    force
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> PlacedPoint<A, K, D> {
    /// The matrix A of the force `A r_m` at the last response.
    #[inline]
    fn secant<C: Family>(&self, [r0, r1]: [&Arms<K, D>; 2]) -> Weights<K, D> {
        let measures1 = measures_in::<K::Measures>(&self.x);
        let (arms, measures0) = match C::placement(self.scheme) {
            Placement::Middle => ([mean::<K, D>(r0, r1); 2], measures1),
            Placement::Ends | Placement::End | Placement::Start => {
                ([*r0, *r1], self.old_measures())
            }
        };
        let ends = Ends::new(&self.kinematics, arms, [measures0, measures1]);
        self.kinematics.secant(&ends, &self.pulls::<C>())
    }

    /// The nodal forces of the last response along the gradient between two configurations, N.
    pub(super) fn force(&self, at: Placement, ends: [&Arms<K, D>; 2]) -> K::PerNode<[f64; D]> {
        let measures0 = self.old_measures();
        let pose = Pose::between(&self.kinematics, at, ends, measures0);
        spread::<K, D>(&pose.pull(&self.kinematics, at, &self.pulls::<Any>()))
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Adds the increments of the internal variables and of the reservoirs' entropies; returns heat and entropy
    /// received from dashpots and conduction.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1 % of a step of two springs"
    )]
    #[inline(always)]
    pub(super) fn book<C: Family>(
        &self,
        view: &StepView<'_>,
        outside: (Option<&[HeatPath]>, &InterfaceTemperatures),
        next: &mut State,
        tally: &mut Tally,
    ) -> Received {
        let slots = self.slots();
        let h = view.thermal_step();
        let share = C::implicit(self.scheme) * h;
        let theta = self.conducting_temperature::<C>(&self.response);
        let per_theta = if self.is_thermal() {
            theta.recip()
        } else {
            1.0
        };
        let mut dissipated = self.book_drag(per_theta, tally);
        if self.drags() > 0 {
            let drag = view.state.viscous.values().len() + self.element.index();
            next.meters.dissipate(drag, dissipated);
        }
        for k in 0..self.dashpots() {
            let old = &view.state.viscous;
            next.viscous.advance(slots.viscous + k, old, self.creep[k]);
            if view.phase.heats() {
                let heat = share * self.power_of::<C>(k, view) + self.damping_heat::<C>(k);
                dissipated += heat;
                tally.produce(heat * per_theta);
                next.meters.dissipate(slots.viscous + k, heat);
            }
        }
        tally.turn_over(dissipated);
        let mut received = Received::none();
        let Some(slot) = slots.thermal else {
            if self.dashpots() + self.drags() > 0 {
                let old = self.single::<C>();
                let with_old = old.map_or(dissipated, |old| dissipated + h * old.old_power);
                next.dissipated.add(with_old);
            }
            return received;
        };
        received.add(dissipated * per_theta);
        received.heat = dissipated;
        if let Some(produced) = self.damping_production::<C>(view, per_theta) {
            received.add(produced);
            tally.produce(produced);
            next.meters.produce(slot, produced);
        }
        if self.dashpots() + self.drags() > 0 {
            next.meters.produce(slot, dissipated * per_theta);
        }
        self.book_heat::<C>(view, slot, outside, &mut Balances { next, tally }, received)
    }

    /// Books entropy and heat flows, given what the dashpots contribute; returns all heat and entropy received.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 0.5 % of a step of a spring"
    )]
    #[inline(always)]
    fn book_heat<C: Family>(
        &self,
        view: &StepView<'_>,
        slot: usize,
        (paths, interface): (Option<&[HeatPath]>, &InterfaceTemperatures),
        balances: &mut Balances<'_>,
        mut received: Received,
    ) -> Received {
        let h = view.thermal_step();
        let share = C::implicit(self.scheme) * h;
        if let Some(at_point) = self.single::<C>() {
            received.add(h * at_point.old_rates[Self::TEMPERATURE]);
        }
        let old = &view.state.entropies;
        (balances.next.entropies).advance(slot, old, received.entropy);
        for path in paths.unwrap_or_default() {
            let other = path.slot as usize;
            let exchange = interface.exchange(share * path.conductance, slot, other);
            balances.conduct([slot, other], (path.link, &exchange), &mut received);
        }
        if self.meets_reservoirs {
            let theta = self.conducting_temperature::<C>(&self.response);
            let correction = self.reservoir_correction::<C>(view, slot, received.heat);
            let share = (share, [theta, correction]);
            balances.exchange_with_reservoirs(view.conduction, slot, share, &mut received);
            if C::implicit(self.scheme) < 1.0 {
                self.book_old_flow(view, slot, balances.next);
            }
        }
        received
    }

    /// Books the heat flow from reservoirs in the old state, which is part of the old rates.
    fn book_old_flow(&self, view: &StepView<'_>, slot: usize, next: &mut State) {
        let h = (1.0 - self.scheme.implicit()) * view.thermal_step();
        for link in view.conduction.links(slot) {
            if let Partner::Reservoir(index) = link.partner {
                let theta_r = view.conduction.reservoirs[index];
                let drop = theta_r - view.state.temperatures[slot];
                let flow = h * link.conductance * drop;
                next.reservoir_entropies.add(index, -flow / theta_r);
            }
        }
    }

    /// See [`reservoir_correction`]; zero unless the scheme is exact and the temperature free.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 0.3 % of a step of a spring"
    )]
    #[inline(always)]
    fn reservoir_correction<C: Family>(&self, view: &StepView<'_>, slot: usize, heat: f64) -> f64 {
        if !C::is_exact(self.scheme) || self.is_prescribed {
            return 0.0;
        }
        let theta = self.conducting_temperature::<C>(&self.response);
        let flow = view.conduction.reservoir_flow(slot, theta);
        let taken = self.temperature() * self.response[Self::ENTROPY];
        let stored = theta * view.state.energies[self.element.index()].heat_capacity;
        reservoir_correction(&flow, [view.thermal_step(), theta], [taken, stored, heat])
    }
}

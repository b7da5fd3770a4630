//! The end of a step: impulses of the forces, and increments of the internal variables.
//!
//! ```text
//! γ¹ = γ⁰ + Δγ
//! s¹ = s⁰ + Σ η Δγ²/(hθ*) + Σ u + Σ P
//! ```
//!
//! with the exchange `u` and the production `P ≥ 0` of every path of heat, see
//! [`conduction`](crate::element::conduction). Both ends of a path use the same numbers.

use super::arms::{add_scaled, change_in, mean, spread};
use super::certify::sizes_of;
use super::member::{Block, Member};
use super::placed::{OfGroup, PlacedPoint};
use super::point::Point;
use super::points::{PointEnd, PointSet, TrialView};
use super::pose::Pose;
use super::share::Contacts;
use super::site::{HeatPath, paths_of};
use super::ways::way_of_nodes;
use crate::element::balances::{Balances, Received, reservoir_correction};
use crate::element::conduction::{InterfaceTemperatures, Partner};
use crate::element::conjugates::{Family, Placement};
use crate::element::error::StateError;
use crate::element::group::view::{Along, At, StepView};
use crate::element::impulse::Impulses;
use crate::element::kinematics::{Arms, Ends, Kinematics, MeasureSet, Measures, Weights};
use crate::element::state::State;
use crate::element::tally::{Care, Tally};
use eem_material::arrays::Arrays;
use eem_material::free_energy::{Array, Caloric, MOST_TOGETHER};

impl<K: Kinematics<D>, P: ?Sized + PointSet<K::Measures>, const D: usize> Block<K, P, D> {
    /// Adds the impulses of the last responses, and the magnitudes of their terms if they are asked for.
    #[inline]
    pub(super) fn add_impulse<C: Family>(
        &self,
        of: OfGroup,
        (view, trial): At<'_, D>,
        along: Along,
        (impulses, magnitudes): (&mut Impulses<'_, D>, &mut [f64]),
    ) {
        let at = match along {
            Along::Secant => None,
            Along::Scheme => Some(C::placement(of.scheme)),
            Along::Gradient => Some(Placement::End),
            Along::Stage(_) => return,
        };
        for (first, member) in self.elements() {
            let nodes = &member.site.nodes;
            let change = change_in::<K, D>(nodes, trial);
            let mut r1 = change;
            add_scaled::<K, D>(&mut r1, 1.0, &member.r0);
            let ends = [&member.r0, &r1];
            let force_of = |index: usize| self.points.pull(first + index);
            if !magnitudes.is_empty() {
                let magnitude_of =
                    |index: usize, of: [&_; 3]| self.points.magnitude_of_pull(first + index, of);
                member.add_magnitude(view.step, [&r1, &change], &magnitude_of, magnitudes);
            }
            let (h, force) = if let Some(at) = at {
                let share = view.step * C::implicit(of.scheme);
                (share, member.force(at, ends, &force_of))
            } else {
                let mut mean = change;
                let old = member.r0.as_ref().as_flattened();
                for (mean, &old) in mean.as_mut().as_flattened_mut().iter_mut().zip(old) {
                    *mean = old + 0.5 * *mean;
                }
                let at = C::placement(of.scheme);
                (view.step, member.pull(at, ends, &mean, force_of))
            };
            for (&node, force) in nodes.as_ref().iter().zip(force.as_ref()) {
                for (impulse, &force) in impulses.of(node as usize).iter_mut().zip(force) {
                    *impulse -= h * force;
                }
            }
        }
    }

    /// Books the step, finds the new temperatures and energies, and judges the step.
    #[inline]
    pub(super) fn close<C: Family>(
        &mut self,
        of: OfGroup,
        at: At<'_, D>,
        contacts: &Contacts<K, D>,
        (next, tally): (&mut State, &mut Tally),
    ) -> Result<(), StateError> {
        let for_points = contacts.for_points(at);
        if !C::IS_EXACT && self.points.is_together() {
            self.close_together(&for_points, next);
        }
        let is_exact = C::is_exact(of.scheme);
        let is_thorough = is_exact && matches!(tally.care, Care::Thorough);
        let mut index = 0;
        for member in &self.members {
            let r1 = member.arms_in(next);
            for point in member.points.as_ref() {
                let kinematics = &point.kinematics;
                let mut end = PointEnd {
                    measures: kinematics.measure(&r1),
                    sizes: [point.measures; 2],
                    slopes: point.measures,
                    way: 0.0,
                };
                if !kinematics.is_admissible(&r1, &end.measures) {
                    let (element, _) = self.points.place(index);
                    return Err(kinematics.refusal(element, &r1));
                }
                if is_exact {
                    end.sizes = [
                        kinematics.sizes(&member.r0, &point.measures0),
                        kinematics.sizes(&r1, &point.measures),
                    ];
                    end.slopes = kinematics.slopes(&r1, &point.measures);
                }
                if is_thorough {
                    end.way = way_of_nodes(member.site.nodes.as_ref(), at.1);
                }
                let books = (&mut *next, &mut *tally);
                self.points.close(index, &for_points, &end, books)?;
                index += 1;
            }
        }
        Ok(())
    }

    #[inline(never)]
    fn close_together(&mut self, at: &TrialView<'_>, next: &mut State) {
        let mut measures = [Measures::<K, D>::filled(0.0); MOST_TOGETHER];
        let mut count = 0;
        for member in &self.members {
            let r1 = member.arms_in(next);
            for point in member.points.as_ref() {
                measures[count] = point.kinematics.measure(&r1);
                count += 1;
            }
        }
        (self.points).close_together(at, &measures[..count], next);
    }
}

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// The nodal forces along the gradient between two configurations, N, given those of its points.
    fn force(
        &self,
        at: Placement,
        ends: [&Arms<K, D>; 2],
        force_of: &dyn Fn(usize) -> Measures<K, D>,
    ) -> K::PerNode<[f64; D]> {
        let mut sum = None;
        for (index, point) in self.points.as_ref().iter().enumerate() {
            sum_nodes::<K, D>(&mut sum, point.force(at, ends, &force_of(index)));
        }
        sum.unwrap_or_else(|| K::PerNode::filled([0.0; D]))
    }

    /// The nodal forces in the form `A r_m`, N.
    #[inline]
    fn pull(
        &self,
        at: Placement,
        ends: [&Arms<K, D>; 2],
        mean: &Arms<K, D>,
        force_of: impl Fn(usize) -> Measures<K, D>,
    ) -> K::PerNode<[f64; D]> {
        let mut sum: Option<Weights<K, D>> = None;
        for (index, point) in self.points.as_ref().iter().enumerate() {
            let own = point.secant(at, ends, &force_of(index));
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

impl<K: Kinematics<D>, const D: usize> PlacedPoint<K, D> {
    /// The matrix A of the force `A r_m` at the last response.
    #[inline]
    fn secant(
        &self,
        at: Placement,
        [r0, r1]: [&Arms<K, D>; 2],
        forces: &Measures<K, D>,
    ) -> Weights<K, D> {
        let (arms, measures0) = match at {
            Placement::Middle => ([mean::<K, D>(r0, r1); 2], self.measures),
            Placement::Ends | Placement::End | Placement::Start => ([*r0, *r1], self.measures0),
        };
        let ends = Ends::new(&self.kinematics, arms, [measures0, self.measures]);
        self.kinematics.secant(&ends, forces)
    }

    /// The nodal forces of the last response along the gradient between two configurations, N.
    fn force(
        &self,
        at: Placement,
        ends: [&Arms<K, D>; 2],
        forces: &Measures<K, D>,
    ) -> K::PerNode<[f64; D]> {
        let pose = Pose::between(&self.kinematics, at, ends, self.measures0);
        spread::<K, D>(&pose.pull(&self.kinematics, at, forces))
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Books the step, recovers the new temperature and judges the step. The caloric quantities at the temperature of the
    /// trial may be known.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 0.8 % of a step of a spring"
    )]
    #[inline(always)]
    pub(super) fn close<C: Family>(
        &mut self,
        at: &TrialView<'_>,
        end: &PointEnd<Q>,
        (next, tally): (&mut State, &mut Tally),
        known: Option<&(Caloric<f64>, f64)>,
    ) -> Result<(), StateError> {
        let view = at.view;
        let outside = (paths_of(self.contact_in(at.contacts)), at.interface);
        let received = self.book::<C>(view, outside, next, tally);
        let near = (self.x[A::Variables::LEN - 1], known);
        if let Some(entropy) = self.recover_temperature::<C>(&end.measures, view, near, next)? {
            self.book_thermostat(view, [entropy, received.entropy], next);
        }
        if !C::is_exact(self.scheme) {
            return Ok(());
        }
        let sizes = [
            sizes_of(end.sizes[0].as_ref(), &self.start.x0),
            sizes_of(end.sizes[1].as_ref(), &self.x),
        ];
        let largest = self.largest_pull::<C>(&end.slopes);
        let is_thorough = matches!(tally.care, Care::Thorough);
        let of_sums = is_thorough.then_some(largest * end.way);
        let [forces, at_end] = self.amplitude::<C>(&sizes, of_sums);
        tally.force(forces);
        tally.exchange(view.step * largest);
        let energy = &mut next.energies[self.element.index()];
        energy.add_secants(at_end, self.is_thermal());
        let terms = [energy.magnitude + forces, energy.heat_capacity];
        self.judge::<C>(view, outside, &sizes[1], (received, terms), tally);
        Ok(())
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

//! Corrections of the energy by motion, by shape and, as a last resort, by entropy.

use super::super::components::{Component, Support};
use super::super::vector::{add, dot};
use super::super::{Explicit, ExplicitView};
use super::momenta::Rigid;
use super::{MOST_ITERATIONS, Status};
use crate::element::state::State;
use eem_material::number::scalar::{Discord, Mask, Real, unless};

/// Motion corrects the energy only if it is at least this fraction of all that can give energy.
const LEAST_MOTION: f64 = 0.05;

/// The largest relative change of motion and shape.
const LARGEST_PART: f64 = 0.1;

/// After heat, motion corrects the remainder if that is at most this fraction of the motion.
const REST_OF_HEAT: f64 = 1e-9;

/// Corrections by shape.
const SHAPE_ITERATIONS: usize = 5;

/// The part of the production of an element, in ε, that is never taken back, because of its rounding: each of up to
/// [`MOST_ITERATIONS`] changes, and the share of each path of heat, is rounded once.
const ROUNDED: f64 = 16.0;

/// The energies available to correct a component, J.
#[derive(Clone, Copy, Debug)]
struct Means<S, const D: usize> {
    rigid: Rigid<S, D>,
    /// The kinetic energy of the motion relative to the rigid one, T.
    motion: S,
    /// `2 T + h² Σ |F|²/m + h Σ g²/η + Σ 2hκ(Δθ)²/(θ_a + θ_b)`.
    all: S,
    /// The acceleration of the centre of mass of a free component, which does not change its shape, m/s².
    drift: [S; D],
}

impl<S: Real, const D: usize> Explicit<S, D> {
    /// Corrects the energy of a component by other means than heat, in the lanes that need it.
    pub(super) fn reshape(
        &mut self,
        index: usize,
        view: &ExplicitView<'_, S, D>,
        next: &mut State<S>,
    ) -> Result<Status, Discord> {
        self.scratch.progress[index].present = None;
        let progress = self.scratch.progress[index];
        let (defect, iterations) = (progress.defect, progress.iterations);
        if !defect.is_finite() {
            return Ok(Status::Failed);
        }
        let means = self.means(index, view);
        let share = defect / means.all;
        let is_small = share.abs().less(S::from_f64(LARGEST_PART));
        let moves = (S::from_f64(LEAST_MOTION) * means.all).at_most(means.motion + means.motion)
            & (-means.motion).less(defect);
        let rest = S::from_f64(REST_OF_HEAT) * means.motion;
        let is_rest = progress.has_heated & defect.abs().at_most(rest);
        let has_motion = S::zero().less(means.motion);
        let moves = progress.needs_forces & has_motion & (is_rest | (is_small & moves));
        if moves.any() {
            let x = defect / means.motion;
            let part = x / (S::one() + (S::one() + x).sqrt());
            self.scale_motion(index, &means.rigid, unless(!moves, S::zero(), part));
        }
        let is_closed = progress.is_closed | moves;
        self.scratch.progress[index].is_closed = is_closed;
        let is_left = progress.needs_forces & !moves;
        let mut shifts = is_left & is_small;
        if iterations >= MOST_ITERATIONS || iterations > SHAPE_ITERATIONS {
            shifts = S::Mask::none();
        }
        if shifts.any() {
            let share = unless(!shifts, S::zero(), share);
            self.shift(index, (view, &means), share, next);
            self.scratch.inactive[index] = self.scratch.inactive[index] & !shifts;
            self.restore_momenta(index);
        }
        let is_left = is_left & !shifts;
        if is_left.any() && !self.try_sink(index, is_left, next)? {
            return Ok(self.unless_rounding(index, is_left, view));
        }
        Ok(if is_closed.all() {
            Status::Closed
        } else {
            Status::Changed
        })
    }

    /// Last resort: converts the defect to entropy or back. False if no element can take it or the limit of corrections
    /// is reached.
    fn try_sink(
        &mut self,
        index: usize,
        is_left: S::Mask,
        next: &mut State<S>,
    ) -> Result<bool, Discord> {
        let progress = &self.scratch.progress[index];
        let defect = progress.defect;
        if !is_left.decide()?
            || progress.iterations >= MOST_ITERATIONS
            || !self.sink(index, defect, next)?
        {
            return Ok(false);
        }
        self.scratch.inactive[index] = S::Mask::none();
        Ok(true)
    }

    fn means(&self, index: usize, view: &ExplicitView<'_, S, D>) -> Means<S, D> {
        let (component, h) = (&self.components.all[index], view.step);
        let rigid = self.rigid(index);
        let forces = &self.scratch.forces;
        let mut drift = [S::zero(); D];
        if component.support == Support::Free {
            for place in component.masses.clone() {
                add(&mut drift, component.mass.recip(), &forces[place]);
            }
        }
        let mut means = Means {
            rigid,
            motion: S::zero(),
            all: S::zero(),
            drift,
        };
        let (half, mut shape) = (S::from_f64(0.5), S::zero());
        for place in component.masses.clone() {
            let own = self.inner_momentum(place, &rigid);
            let force = self.inner_force(place, &means);
            let per_mass = self.stage.places[place].per_mass;
            means.motion += half * dot(&own, &own) * per_mass;
            shape += dot(&force, &force) * per_mass;
        }
        means.all = means.motion + means.motion + h * h * shape;
        means.all += h * self.creeping_power(index) + self.exchange(component, h);
        means
    }

    /// `Σ g²/η`, W.
    fn creeping_power(&self, index: usize) -> S {
        let owned = self.scratch.creep.iter().zip(&self.components.dashpots);
        let own = owned.filter(|&(_, dashpot)| dashpot.component as usize == index);
        own.fold(S::zero(), |sum, (&[_, power], _)| sum + power)
    }

    /// `Σ 2hκ(Δθ)²/(θ_a + θ_b)` of the paths without a thermostat at an end, J.
    fn exchange(&self, component: &Component<S>, h: S) -> S {
        let mut sum = S::zero();
        for path in &self.components.paths[component.paths.clone()] {
            let [a, b] = path.ends.map(|end| self.stage.theta(end as usize));
            if !self.meets_thermostat(path.ends) {
                let drop = a - b;
                let heat = (h + h) * path.conductance * drop;
                sum += heat * drop / (a + b);
            }
        }
        sum
    }

    fn meets_thermostat(&self, ends: [u32; 2]) -> bool {
        ends.into_iter().any(|end| self.stage.is_held(end as usize))
    }

    /// The momentum of a mass relative to the rigid motion.
    fn inner_momentum(&self, place: usize, rigid: &Rigid<S, D>) -> [S; D] {
        let place = &self.stage.places[place];
        let mut own = *place.p();
        let arm = rigid.origin.arm(place.q());
        add(&mut own, -place.mass, &rigid.velocity);
        add(&mut own, -place.mass, &rigid.omega.turn(&arm));
        own
    }

    /// The negative gradient of the energy at fixed momenta: the force less the centripetal force of the rotation and the
    /// drift.
    fn inner_force(&self, at: usize, means: &Means<S, D>) -> [S; D] {
        let (place, rigid) = (&self.stage.places[at], &means.rigid);
        let arm = rigid.origin.arm(place.q());
        let toward = rigid.omega.turn(&rigid.omega.turn(&arm));
        let mut force = self.scratch.forces[at];
        add(&mut force, -place.mass, &toward);
        add(&mut force, -place.mass, &means.drift);
        force
    }

    /// `p += a p_int`.
    fn scale_motion(&mut self, index: usize, rigid: &Rigid<S, D>, part: S) {
        for place in self.components.all[index].masses.clone() {
            let own = self.inner_momentum(place, rigid);
            add(&mut self.stage.places[place].now[1], part, &own);
        }
        self.look_at_motion(index);
    }

    /// Moves positions, viscous stretches and heat along the gradient of the energy.
    fn shift(
        &mut self,
        index: usize,
        (view, means): (&ExplicitView<'_, S, D>, &Means<S, D>),
        share: S,
        next: &mut State<S>,
    ) {
        let h = view.step;
        let masses = self.components.all[index].masses.clone();
        for at in masses.clone() {
            let own = self.inner_momentum(at, &means.rigid);
            let force = self.inner_force(at, means);
            let place = &mut self.stage.places[at];
            let change = place.per_mass * share * h * h;
            add(&mut place.now[1], share, &own);
            add(&mut place.now[0], -change, &force);
        }
        for (dashpot, own) in self.components.dashpots.iter().enumerate() {
            if own.component as usize == index {
                self.stage.inner[dashpot] -= share * h * self.scratch.creep[dashpot][0];
            }
        }
        self.exchange_heat(index, share * h, next);
    }

    /// Moves entropy from the warmer to the cooler end of each path, without production.
    fn exchange_heat(&mut self, index: usize, duration: S, next: &mut State<S>) {
        let slots = self.scratch.produced.len();
        for path in &self.components.paths[self.components.all[index].paths.clone()] {
            if self.meets_thermostat(path.ends) {
                continue;
            }
            let ends = path.ends.map(|end| end as usize);
            let [a, b] = ends.map(|end| self.stage.theta(end));
            let entropy = (duration + duration) * path.conductance * (a - b) / (a + b);
            next.entropies.add(ends[0], entropy);
            let heat = duration * path.conductance * (a - b);
            next.meters.conduct(path.link as usize, heat);
            match path.share {
                None => next.entropies.add(ends[1], -entropy),
                Some(share) => {
                    self.books.shares[share as usize].add(-entropy);
                    next.reservoir_entropies.add(ends[1] - slots, -entropy);
                }
            }
        }
    }

    /// Converts energy to entropy, or back as far as it was produced in this step; returns false if no element can take
    /// it.
    fn sink(&mut self, index: usize, defect: S, next: &mut State<S>) -> Result<bool, Discord> {
        if defect.less(S::zero()).decide()? {
            let produced = self.produced_heat(index);
            // Of what was produced at first, however often a part of it has been taken back.
            let kept = S::from_f64(ROUNDED) * S::EPSILON;
            let most = S::one() - kept / self.scratch.progress[index].factor;
            if !(S::zero().less(produced) & S::zero().less(most)).decide()? {
                return Ok(false);
            }
            let part = defect / produced;
            self.heat(index, part.maximum(-most), next);
            if part.at_most(-most).decide()? {
                // The rest is rounding, for which no factor is known.
                self.scratch.progress[index].factor = S::zero();
            }
            return Ok(true);
        }
        let slots = self
            .slots_of(index)
            .map(|at| self.components.slots[at] as usize);
        let takes = |slot: &usize| self.produces[*slot] && !self.stage.is_held(*slot);
        let all = slots.filter(takes).fold(S::zero(), |all, slot| {
            all + self.scratch.capacities[slot][0] * self.stage.theta(slot)
        });
        if S::zero().less(all).decide()? {
            for at in self.slots_of(index) {
                let slot = self.components.slots[at] as usize;
                if self.produces[slot] && !self.stage.is_held(slot) {
                    let entropy = self.scratch.capacities[slot][0] * (defect / all);
                    self.warm(index, slot, entropy, next);
                    next.meters.produce(slot, entropy);
                }
            }
            return Ok(true);
        }
        // What leaves the scene, or is taken by thermostats, is known to its own size.
        let produced = self.produced_heat(index);
        let takes = (S::zero().less(produced) & defect.at_most(produced)).decide()?;
        if takes {
            self.heat(index, defect / produced, next);
        }
        Ok(takes)
    }
}

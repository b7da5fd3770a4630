//! Corrections of the energy by motion, by shape and, as a last resort, by entropy.

use super::super::accounts::Accounts;
use super::super::components::Support;
use super::super::demand::Demand;
use super::super::{Explicit, View};
use super::momenta::Rigid;
use super::{MOST_ITERATIONS, Status};
use crate::algebra::{add, dot};
use crate::element::group::points;
use crate::element::state::State;
use eem_material::number::scalar::Scalar;

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
struct Means<const D: usize> {
    rigid: Rigid<D>,
    /// The kinetic energy of the motion relative to the rigid one, T.
    motion: f64,
    /// `2 T + h² Σ |F|²/m + h Σ g²/η + Σ 2hκ(Δθ)²/(θ_a + θ_b)`.
    all: f64,
    /// The acceleration of the centre of mass of a free component, which does not change its shape, m/s².
    drift: [f64; D],
}

impl Accounts {
    /// `h Σ g²/η + Σ 2hκ(Δθ)²/(θ_a + θ_b)` of dashpots, and of paths without a thermostat at an end, J.
    fn flow(&self, index: usize, h: f64) -> f64 {
        let mut creep = 0.0;
        for dashpot in self.components.dashpots_of(index) {
            creep += self.scratch.creep[dashpot][1];
        }
        let mut sum = 0.0;
        for path in &self.components.paths[self.components.all[index].paths.clone()] {
            let ends = path.ends;
            let [a, b] = [self.stage.theta(ends[0]), self.stage.theta(ends[1])];
            if !self.meets_thermostat(ends) {
                let drop = a - b;
                let heat = (h + h) * path.conductance * drop;
                sum += heat * drop / (a + b);
            }
        }
        h * creep + sum
    }

    fn meets_thermostat(&self, ends: [usize; 2]) -> bool {
        ends.into_iter().any(|end| self.stage.is_held(end))
    }

    /// Lets dashpots creep for this time, and moves entropy from the warmer to the cooler end of each path, without production.
    fn flow_for(&mut self, index: usize, duration: f64, next: &mut State) {
        for dashpot in self.components.dashpots_of(index) {
            self.stage.inner[dashpot] -= duration * self.scratch.creep[dashpot][0];
        }
        let first = self.components.first_reservoir;
        for path in &self.components.paths[self.components.all[index].paths.clone()] {
            let ends = path.ends;
            if self.meets_thermostat(ends) {
                continue;
            }
            let [a, b] = [self.stage.theta(ends[0]), self.stage.theta(ends[1])];
            let entropy = (duration + duration) * path.conductance * (a - b) / (a + b);
            next.entropies.add(ends[0], entropy);
            let heat = duration * path.conductance * (a - b);
            next.meters.conduct(path.link, heat);
            match path.share {
                None => next.entropies.add(ends[1], -entropy),
                Some(share) => {
                    self.books.shares[share].add(-entropy);
                    next.reservoir_entropies.add(ends[1] - first, -entropy);
                }
            }
        }
    }

    /// Whether an element produces entropy and keeps it.
    fn takes(&self, slot: usize) -> bool {
        self.produces[slot] && !self.stage.is_held(slot)
    }

    /// Last resort: converts energy to entropy, or back as far as it was produced in this step; returns false if no element
    /// can take it.
    fn sink(&mut self, index: usize, defect: f64, next: &mut State) -> bool {
        if defect < 0.0 {
            let produced = self.produced_heat(index);
            // Of what was produced at first, however often a part of it has been taken back.
            let kept = ROUNDED * f64::EPSILON;
            let most = 1.0 - kept / self.scratch.progress[index].factor;
            if !(produced > 0.0 && most > 0.0) {
                return false;
            }
            let part = defect / produced;
            self.heat(index, Scalar::maximum(part, -most), next);
            if part <= -most {
                // The rest is rounding, for which no factor is known.
                self.scratch.progress[index].factor = 0.0;
            }
            return true;
        }
        let mut all = 0.0;
        for at in self.slots_of(index) {
            let slot = self.components.slots[at];
            if self.takes(slot) {
                all += self.scratch.slots[slot].capacity * self.stage.theta(slot);
            }
        }
        if all > 0.0 {
            let mut sums = self.warmth(index);
            for at in self.slots_of(index) {
                let slot = self.components.slots[at];
                if self.takes(slot) {
                    let entropy = self.scratch.slots[slot].capacity * (defect / all);
                    self.warm((slot, entropy), &mut sums, next);
                    next.meters.produce(slot, entropy);
                }
            }
            self.keep_warmth(index, sums);
            return true;
        }
        // What leaves the scene, or is taken by thermostats, is known to its own size.
        let produced = self.produced_heat(index);
        let takes = produced > 0.0 && defect <= produced;
        if takes {
            self.heat(index, defect / produced, next);
        }
        takes
    }
}

impl<const D: usize> Explicit<D> {
    /// Corrects the energy of a component by other means than heat.
    pub(super) fn reshape(
        &mut self,
        index: usize,
        (view, demand): (&View<'_>, Demand),
        next: &mut State,
    ) -> Status {
        self.scratch.progress[index].present = None;
        let progress = self.scratch.progress[index];
        let (defect, iterations) = (progress.defect, progress.iterations);
        if !defect.is_finite() {
            return Status::Failed;
        }
        let means = self.means(index, view);
        let share = defect / means.all;
        if share.abs() > demand.largest_change()
            && self.prescribed.moved.is_empty()
            && self.leave_rounding(index)
        {
            return Status::Closed;
        }
        let is_small = share.abs() < LARGEST_PART;
        let moves =
            LEAST_MOTION * means.all <= means.motion + means.motion && -means.motion < defect;
        let rest = REST_OF_HEAT * means.motion;
        let is_rest = progress.has_heated && defect.abs() <= rest;
        if means.motion > 0.0 && (is_rest || (is_small && moves)) {
            let x = defect / means.motion;
            let part = x / (1.0 + (1.0 + x).sqrt());
            // p += a p_int
            for place in self.components.all[index].masses.clone() {
                let own = self.inner_momentum(place, &means.rigid);
                add(&mut self.places[place].now[1], part, &own);
            }
            self.look_at_motion(index);
            let progress = &mut self.scratch.progress[index];
            progress.moved += part.abs();
            progress.is_closed = true;
            return Status::Closed;
        }
        if is_small && iterations < MOST_ITERATIONS && iterations <= SHAPE_ITERATIONS {
            self.shift(index, (view, &means), share, next);
            self.restore_momenta(index);
            return Status::Changed;
        }
        if iterations < MOST_ITERATIONS && self.sink(index, defect, next) {
            return Status::Changed;
        }
        let (accounts, bodies) = self.parts(view);
        accounts.unless_rounding(&bodies, index)
    }

    fn means(&self, index: usize, view: &View<'_>) -> Means<D> {
        let (component, h) = (&self.components.all[index], view.step);
        let rigid = self.rigid(index);
        let forces = points::<D>(&self.scratch.forces);
        let mut drift = [0.0; D];
        if component.support == Support::Free {
            for place in component.masses.clone() {
                add(&mut drift, component.mass.recip(), &forces[place]);
            }
        }
        let mut means = Means {
            rigid,
            motion: 0.0,
            all: 0.0,
            drift,
        };
        let mut shape = 0.0;
        for place in component.masses.clone() {
            let own = self.inner_momentum(place, &rigid);
            let force = self.inner_force(place, &means);
            let per_mass = self.places[place].per_mass();
            means.motion += 0.5 * dot(&own, &own) * per_mass;
            shape += dot(&force, &force) * per_mass;
        }
        means.all = means.motion + means.motion + h * h * shape;
        means.all += self.flow(index, h);
        means
    }

    /// The momentum of a mass relative to the rigid motion.
    fn inner_momentum(&self, place: usize, rigid: &Rigid<D>) -> [f64; D] {
        let place = &self.places[place];
        let mut own = *place.p();
        let arm = rigid.origin.arm(place.q());
        add(&mut own, -place.mass, &rigid.velocity);
        add(&mut own, -place.mass, &rigid.omega.turn(&arm));
        own
    }

    /// The negative gradient of the energy at fixed momenta: the force less the centripetal force of the rotation and the
    /// drift.
    fn inner_force(&self, at: usize, means: &Means<D>) -> [f64; D] {
        let (place, rigid) = (&self.places[at], &means.rigid);
        let arm = rigid.origin.arm(place.q());
        let toward = rigid.omega.turn(&rigid.omega.turn(&arm));
        let mut force = points::<D>(&self.scratch.forces)[at];
        add(&mut force, -place.mass, &toward);
        add(&mut force, -place.mass, &means.drift);
        force
    }

    /// Moves positions, viscous stretches and heat along the gradient of the energy.
    fn shift(
        &mut self,
        index: usize,
        (view, means): (&View<'_>, &Means<D>),
        share: f64,
        next: &mut State,
    ) {
        let h = view.step;
        let progress = &mut self.scratch.progress[index];
        progress.moved += share.abs();
        progress.has_shifted = true;
        for at in self.components.all[index].masses.clone() {
            let own = self.inner_momentum(at, &means.rigid);
            let force = self.inner_force(at, means);
            let place = &mut self.places[at];
            let change = place.per_mass() * share * h * h;
            add(&mut place.now[1], share, &own);
            add(&mut place.now[0], -change, &force);
        }
        self.flow_for(index, share * h, next);
    }
}

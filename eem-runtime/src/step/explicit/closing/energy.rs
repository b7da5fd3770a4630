//! The energy of a component, and its correction by heat.

use super::super::Explicit;
use super::super::accounts::Accounts;
use super::super::demand::Demand;
use super::super::memory::{Momenta, Motion};
use super::super::origin::Origin;
use super::{FROZEN, Status};
use crate::element::group::{Caloric, Place, is_met};
use crate::element::state::State;
use core::ops::Range;
use eem_material::number::compensated::Total;
use eem_material::number::scalar::Scalar;

/// The fraction of the entropy production of a step by which a correction by heat may change it.
const HEAT_SHARE: f64 = 0.003;

/// Corrections by heat.
const HEAT_ITERATIONS: usize = 3;

/// The tolerance of the defect, in u = ε/2, relative to the magnitude of the energy.
const ENOUGH: f64 = 2.0;

/// The sums over a component that change when its elements are warmed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Warmth {
    /// Those of its internal energy, J, and of its entropy production, J/K.
    energy: Total,
    production: Total,
    /// See [`Progress`](super::super::memory::Progress).
    warmed: f64,
}

impl Accounts {
    /// The energy of a component, and the magnitude of its terms, J.
    #[inline]
    pub(in super::super) fn energy_of(&self, index: usize) -> [f64; 2] {
        let (motion, inner) = (&self.motions[index], &self.scratch.energies[index]);
        let (mut energy, mut magnitude) = (motion.value, motion.magnitude + inner.magnitude);
        energy.add(inner.value.value());
        if self.is_driven {
            let lost = self.books.targets[index].lost;
            energy.add_sum(lost);
            magnitude += lost.value.abs();
        }
        for share in self.components.all[index].shares.clone() {
            let reservoir = self.components.shares[share].reservoir;
            let theta = self
                .stage
                .theta(self.components.first_reservoir + reservoir);
            let sum = self.books.shares[share];
            energy.add(theta * sum.value);
            energy.add(theta * sum.carry);
            magnitude += (theta * sum.value).abs();
        }
        [energy.value(), magnitude]
    }

    /// The defect of the energy of a component, and the magnitude of its terms, J.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "two values are returned in registers")]
    pub(in super::super) fn defect_of(&self, index: usize) -> [f64; 2] {
        let [energy, magnitude] = self.energy_of(index);
        let target = self.books.targets[index].energy;
        // Below the smallest normal number, rounding is that of this number.
        let least = self.scratch.subnormal * self.components.all[index].products;
        [
            target.beyond(energy),
            magnitude + target.value.abs() + least,
        ]
    }

    /// Corrects the energy by heat as long as no element has to be evaluated for it.
    #[inline(never)]
    pub(super) fn balance(&mut self, index: usize, demand: Demand, next: &mut State) -> Status {
        loop {
            let is_finite = self.look(index);
            let progress = &mut self.scratch.progress[index];
            if progress.is_rigid || progress.is_closed {
                return Status::Closed;
            }
            let iterations = progress.iterations;
            progress.iterations += 1;
            let allowed = demand.largest_correction() * progress.carried;
            let rounding = FROZEN * f64::EPSILON * progress.scale;
            let is_carried = progress.carried > 0.0 && progress.defect.abs() <= allowed + rounding;
            let carried = if is_carried { progress.carried } else { 0.0 };
            let most = if is_carried { 1 } else { HEAT_ITERATIONS };
            let tries_heat = iterations < most && is_finite && !self.is_motion_first;
            let heated = if tries_heat {
                self.heat_within_share(index, carried, next)
            } else {
                None
            };
            match heated {
                None if is_carried => return self.carry(index, next),
                None => return Status::NeedsForces,
                Some(false) => return Status::Changed,
                Some(true) => {}
            }
        }
    }

    /// Finds the defect of a component; returns whether it is finite.
    #[inline]
    fn look(&mut self, index: usize) -> bool {
        let present = self.defect_of(index);
        let progress = &mut self.scratch.progress[index];
        progress.present = Some(present);
        let [defect, magnitude] = present;
        progress.defect = defect;
        if progress.scale == 0.0 {
            let terms = magnitude + progress.carried;
            progress.correction = defect / terms;
            progress.scale = terms;
        }
        let enough = 0.5 * ENOUGH * f64::EPSILON * progress.scale;
        progress.is_closed = progress.is_closed || defect.abs() <= enough;
        defect.is_finite()
    }

    /// Closes a component by heat if the heat is small compared with what is produced, and with what moved anchors have carried;
    /// then returns whether the result is known without another evaluation.
    #[inline]
    fn heat_within_share(&mut self, index: usize, carried: f64, next: &mut State) -> Option<bool> {
        let defect = self.scratch.progress[index].defect;
        let all = self.produced_heat(index) + carried;
        if !(defect.abs() <= HEAT_SHARE * all) {
            return None;
        }
        self.scratch.progress[index].has_heated = true;
        Some(self.heat(index, defect / all, next))
    }

    /// Closes a component without masses by the work of its moved anchors, of which the defect is a part that is within the
    /// demand: positions are given, and the quadrature of the power of a stiff spring may be off by far more than a weak dashpot beside
    /// it dissipates.
    fn carry(&mut self, index: usize, next: &mut State) -> Status {
        let progress = &mut self.scratch.progress[index];
        let missing = -progress.defect;
        progress.present = None;
        self.books.targets[index].energy.add(missing);
        next.work.add(missing);
        Status::Closed
    }

    /// The heat that the elements of a component have produced themselves, `Σ Π θ`, J.
    #[inline]
    pub(super) fn produced_heat(&self, index: usize) -> f64 {
        let mut sum = self.scratch.progress[index].lost;
        for at in self.slots_of(index) {
            let slot = self.components.slots[at];
            sum += self.scratch.slots[slot].produced * self.stage.theta(slot);
        }
        sum
    }

    /// Scales each element's entropy production by 1 + ε. Returns whether the second-order update is accurate to
    /// rounding.
    #[inline]
    pub(super) fn heat(&mut self, index: usize, part: f64, next: &mut State) -> bool {
        let scratch = &mut self.scratch;
        let lost = &mut scratch.progress[index].lost;
        let change = *lost * part;
        if change != 0.0 {
            *lost += change;
            next.dissipated.add(change);
            self.books.targets[index].lost.add(change);
        }
        scratch.progress[index].factor *= 1.0 + part;
        scratch.progress[index].present = None;
        let mut is_small = true;
        let mut sums = self.warmth(index);
        for at in self.slots_of(index) {
            let slot = self.components.slots[at];
            let entropy = self.scratch.slots[slot].produced * part;
            if entropy != 0.0 {
                is_small &= self.warm((slot, entropy), &mut sums, next);
            }
        }
        self.keep_warmth(index, sums);
        is_small
    }

    /// The sums of a component that [`warm`](Self::warm) changes.
    #[inline]
    pub(super) fn warmth(&self, index: usize) -> Warmth {
        let progress = &self.scratch.progress[index];
        Warmth {
            energy: self.scratch.energies[index].value,
            production: progress.production,
            warmed: progress.warmed,
        }
    }

    #[inline]
    pub(super) fn keep_warmth(&mut self, index: usize, sums: Warmth) {
        let progress = &mut self.scratch.progress[index];
        (progress.production, progress.warmed) = (sums.production, sums.warmed);
        self.scratch.energies[index].value = sums.energy;
    }

    pub(in super::super) fn slots_of(&self, index: usize) -> Range<usize> {
        self.components.all[index].slots.clone()
    }

    /// Gives the entropy x to an element as if it had produced it: θ becomes `θ (1 + r + r²/2)` with `r = x/c`, and e becomes
    /// `e + θ x (1 + r/2)`. The thermostat of a held element takes it, with the heat θ x.
    /// Returns whether that is exact to rounding, and θ matches the stored entropy.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "the sums stay in registers")]
    pub(super) fn warm(
        &mut self,
        (slot, entropy): (usize, f64),
        sums: &mut Warmth,
        next: &mut State,
    ) -> bool {
        let caloric = &mut self.scratch.slots[slot];
        caloric.produced += entropy;
        sums.production.add(entropy);
        let Caloric { capacity, bend, .. } = *caloric;
        if self.stage.is_held(slot) {
            self.warm_held(slot, entropy);
            return true;
        }
        let theta = self.stage.theta_mut(slot);
        let ratio = entropy / capacity;
        sums.warmed = Scalar::maximum(sums.warmed, ratio.abs());
        let energy = *theta * entropy * (1.0 + 0.5 * ratio);
        next.entropies.add(slot, entropy);
        sums.energy.add(energy);
        let element = self.components.elements[slot];
        next.energies[element].value += energy;
        *theta += *theta * ratio * (1.0 + 0.5 * ratio);
        // 2 √u: neglected are the cube of r, and the second-order change of forces.
        let small = (f64::EPSILON + f64::EPSILON).sqrt();
        ratio.abs() < small && is_met(ratio, [capacity, bend])
    }
}

impl<const D: usize> Explicit<D> {
    /// Finds the sums over the masses of a component for their present positions and momenta.
    #[inline]
    pub(in super::super) fn look_at_motion(&mut self, index: usize) {
        let component = &self.accounts.components.all[index];
        let origin = Origin::of(&self.places, component);
        let (mut momenta, mut motion) = (Momenta::none(), Motion::default());
        for place in &self.places[component.masses.clone()] {
            add_motion(place, &origin.arm(place.q()), (&mut momenta, &mut motion));
        }
        (self.momenta[index], self.accounts.motions[index]) = (momenta, motion);
    }
}

/// Adds momenta and energy of a mass at the end of an arm.
#[inline]
pub(super) fn add_motion<const D: usize>(
    place: &Place<D>,
    arm: &[f64; D],
    (momenta, motion): (&mut Momenta<D>, &mut Motion),
) {
    let (q, p) = (place.q(), place.p());
    momenta.add(p, arm);
    motion.add_terms([q, p], arm);
    motion.add_energy([q, p], &place.force, place.per_mass());
}

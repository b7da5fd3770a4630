//! What a step proves of itself, whatever found it.
//!
//! With the increments that were used and the energies `e = ψ + θ s` of the states that are stored,
//!
//! ```text
//! R = Σ v̄·Δp + Σ Δe + Σ θ_r Δσ_r + heat lost − work − heat,     v̄ = (p⁰ + p¹)/2m
//! ```
//!
//! is what the step has gained of energy. No force and no divided difference enters it: with the force
//! that moved the momenta in the place of Δe, any force would pass. Rounding explains
//!
//! ```text
//! B = 64 ε (A + A⁺)
//! A  = Σ over both ends (T + |ψ| + θ|s| + cθ) + Σ |f*|(λ⁰ + λ¹) + Σ |g*|(|γ⁰| + |γ¹|)
//!      + ε Σ (|T_λλ| λ² + |T_γγ| γ²) + Σ η Δγ²/h + Σ |Q| + |work| + |heat|
//! A⁺ = Σ |T_ij| |x_j| |Δx_i|          T: tangent of (f*, −g*, θ*),  x = (λ, γ, θ),  Δx = (Δλ, Δγ, Δs)
//! ```
//!
//! A has the terms of the balance, A⁺ the work of the rounding of the arguments of the forces; it is found
//! only where A is not enough. Where the terms of an entropy cancel, the temperature that is found from it,
//! and with it the stored energy, is known to 8 ε of them: an eighth of `θ Σ |terms of s|` replaces smaller
//! values of `|ψ| + θ|s| + cθ`.
//!
//! Of what forces contribute, 0.4 of the digits count at most: ε^−0.4 times the other terms and
//! `√ε Σ m (ℓ/h)²`, with the shortest element ℓ of each node; of their impulses ε^−0.4 times
//! `Σ |p| + m ℓ/h`. Every term carries some roundings; 64 is eight times the largest `|R|/(ε (A + A⁺))` that
//! a right step has shown, near an anchor. Momenta and productions are judged beside the energy.

mod motion;

use crate::element::handle::Element;
use crate::element::recount::Recount;
use crate::element::tally::{ROUNDINGS, Tally};
use crate::number::scalar::{Mask, Real};
use crate::step::error::StepFailure;
use crate::step::law::Law;

pub(crate) use motion::{Kept, Motion, NodeStep, Speeds};

/// Roundings that the certificate itself may be off by: those of the values of ψ and θs at both ends. What
/// it says has to stay below the bound by as much.
const OWN_ROUNDINGS: f64 = 8.0;

/// The part of them up to which a step is taken without another iteration.
const ENOUGH: f64 = 1.0 / 64.0;

/// Roundings of `Σ |q||p|` and of `Σ |p|` up to which a step is taken without another iteration.
const ENOUGH_MOMENTUM: f64 = 4.0;

/// The share of the digits that a bound may cost: a Maxwell element of which one spring is 10⁷ times as
/// stiff as the other loses 0.36 of them.
const MOST_DIGITS: f64 = 0.4;

/// Roundings of the largest terms of a free energy, in the evaluation of which several add up.
const VALUE_ROUNDINGS: f64 = 4.0;

/// What moves if every node covers its shortest element in a step: where nothing else does, forces are
/// measured by it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach<S> {
    /// `Σ m (ℓ/h)²`, J.
    pub(crate) energy: S,
    /// `Σ m ℓ/h`, kg m/s.
    pub(crate) momentum: S,
}

/// What a step has proved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Certificate<S: Real> {
    /// R, J.
    pub(crate) defect: S,
    /// B, J.
    pub(crate) bound: S,
    /// Σ over dashpots and paths of heat, J/K.
    pub(crate) production: S,
    /// The smallest of them; zero without any, J/K.
    pub(crate) least_production: S,
    /// The largest component of what the momenta are off by, and the magnitude of their terms.
    linear: [S; 2],
    angular: [S; 2],
    is_balanced: S::Mask,
}

impl<S: Real> Reach<S> {
    /// Of nothing.
    pub(crate) fn none() -> Self {
        let [energy, momentum] = [S::zero(); 2];
        Self { energy, momentum }
    }

    /// A node with this mass, kg, which covers its length in a step: h/ℓ is the slowness, s/m.
    pub(crate) fn add(&mut self, mass: S, slowness: S) {
        let momentum = mass / slowness;
        self.momentum += momentum;
        self.energy += momentum / slowness;
    }
}

impl<S: Real> Certificate<S> {
    /// From the motion of the nodes, what the elements say, and the energy `Σ Δe + Σ θ_r Δσ_r + heat lost −
    /// heat` with the magnitude of its terms; and how far nodes reach, if it is asked for.
    pub(crate) fn new<const D: usize>(
        motion: &Motion<S, D>,
        tally: &Tally<S>,
        [internal, magnitude]: [S; 2],
        reach: impl Fn() -> Reach<S>,
    ) -> Self {
        let mut energy = motion.energy;
        energy.add(internal);
        let terms = motion.amplitude + tally.heat + magnitude;
        let most = S::EPSILON.recip().powf(S::from_f64(MOST_DIGITS));
        let mut forces = tally.forces;
        if !forces.at_most(most * terms).all() {
            let slow = S::EPSILON.sqrt() * reach().energy;
            forces = forces.minimum(most * (terms + slow));
        }
        let mut impulse = tally.impulse;
        if !impulse.at_most(most * motion.momenta).all() {
            impulse = impulse.minimum(most * (motion.momenta + reach().momentum));
        }
        let amplitude = terms + forces;
        let has_produced = tally.least.less(S::MAX);
        let largest = |of: &[S]| of.iter().fold(S::zero(), |most, x| most.maximum(x.abs()));
        Self {
            defect: energy.value(),
            bound: S::from_f64(ROUNDINGS) * S::EPSILON * amplitude,
            production: tally.production,
            least_production: S::select(has_produced, tally.least, S::zero()),
            linear: match motion.kept {
                Kept::Both => [largest(&motion.linear), motion.momenta + impulse],
                Kept::None | Kept::Angular(_) => [S::zero(); 2],
            },
            angular: [
                motion.angular.largest(),
                motion.moments + motion.farthest * impulse,
            ],
            is_balanced: tally.is_balanced,
        }
    }

    /// The same where the energies have been counted anew, if their values are less sharp than the bound
    /// and their roundings explain the difference.
    pub(crate) fn recounted(mut self, recount: &Recount<S>) -> Self {
        let rounding = S::from_f64(VALUE_ROUNDINGS) * S::EPSILON * recount.magnitude;
        let is_explained =
            self.bound.less(rounding) & self.defect.abs().at_most(self.bound + rounding);
        let recounted = self.defect + recount.correction;
        self.defect = S::select(is_explained, recounted, self.defect);
        self
    }

    /// Two parts of a step, one after the other.
    pub(crate) fn and(self, later: Self) -> Self {
        Self {
            defect: self.defect + later.defect,
            bound: self.bound + later.bound,
            production: self.production + later.production,
            least_production: self.least_production.minimum(later.least_production),
            ..later
        }
    }

    /// An error unless the energy is a number after a step to `time`.
    pub(crate) fn unless_infinite(&self, time: S) -> Result<(), StepFailure> {
        if self.defect.is_finite() {
            return Ok(());
        }
        Err(StepFailure::Energy {
            value: self.defect.to_f64(),
            time: time.to_f64(),
        })
    }

    /// Whether the balances of all nodes, dashpots and temperatures hold to rounding.
    #[inline]
    pub(crate) fn is_balanced(&self) -> bool {
        self.is_balanced.all()
    }

    /// Whether the balances and all laws hold to what rounding explains.
    #[inline]
    pub(crate) fn is_lawful(&self) -> bool {
        self.is_balanced() && self.broken_law().is_none()
    }

    /// Where all equations hold as sharply as another iteration would make them.
    #[inline]
    pub(crate) fn is_enough(&self) -> S::Mask {
        let rounding = S::from_f64(ENOUGH_MOMENTUM) * S::EPSILON;
        let [linear, momenta] = self.linear;
        let [angular, moments] = self.angular;
        self.is_balanced
            & self.has_enough_energy()
            & linear.at_most(rounding * momenta)
            & angular.at_most(rounding * moments)
            & S::zero().at_most(self.least_production)
    }

    /// Where the energy is as sharp as another iteration would make it.
    #[inline]
    pub(crate) fn has_enough_energy(&self) -> S::Mask {
        let enough = S::from_f64(ENOUGH) * self.bound;
        self.defect.abs().at_most(enough)
    }

    /// This one where a mask holds and another elsewhere; both of the same step.
    pub(crate) fn or(mut self, is_own: S::Mask, other: &Self) -> Self {
        self.defect = S::select(is_own, self.defect, other.defect);
        self.bound = S::select(is_own, self.bound, other.bound);
        self.is_balanced = (self.is_balanced & is_own) | (other.is_balanced & !is_own);
        self
    }

    /// The first law that is broken, with what it is off by and what rounding explains.
    pub(crate) fn broken_law(&self) -> Option<(Law, [S; 2])> {
        let rounding = S::from_f64(ROUNDINGS) * S::EPSILON;
        let [linear, momenta] = self.linear;
        let [angular, moments] = self.angular;
        let laws = [
            (
                Law::Energy,
                self.defect,
                S::from_f64(1.0 - OWN_ROUNDINGS / ROUNDINGS) * self.bound,
            ),
            (Law::LinearMomentum, linear, rounding * momenta),
            (Law::AngularMomentum, angular, rounding * moments),
            (
                Law::Production,
                self.least_production.minimum(S::zero()),
                S::zero(),
            ),
        ];
        // Not a number is not kept.
        let broken = laws
            .into_iter()
            .find(|(_, defect, bound)| !defect.abs().at_most(*bound).all());
        broken.map(|(law, defect, bound)| (law, [defect, bound]))
    }
}

impl Law {
    /// The error of a step to `time` that breaks it, most of all in one element.
    pub(crate) fn not_kept<S: Real>(
        self,
        [defect, bound]: [S; 2],
        element: Option<Element>,
        time: S,
    ) -> StepFailure {
        StepFailure::LawNotKept {
            law: self,
            defect: defect.to_f64(),
            bound: bound.to_f64(),
            element,
            time: time.to_f64(),
        }
    }
}

//! The certificate of a step: the proof of its laws, independent of how the step was computed.
//!
//! With the increments that were used and the energies `e = ψ + θ s` of the stored states,
//!
//! ```text
//! R = Σ v̄·Δp + Σ Δe + Σ θ_r Δσ_r + heat lost − work − heat,     v̄ = (p⁰ + p¹)/2m
//! ```
//!
//! is the energy that the step has gained. Δe is a difference of values of ψ: if it were computed from the force that moved
//! the momenta, any force would pass.
//!
//! **Decision.** Rounding explains
//!
//! ```text
//! B* = 64 ε (A* + A⁺)
//! A* = Σ over both ends (T + |ψ| + θ|s| + cθ) + Σ |f*|(λ⁰ + λ¹) + Σ |g*|(|γ⁰| + |γ¹|)
//!      + ε Σ (|T_λλ| λ² + |T_γγ| γ²) + Σ η Δγ²/h + Σ |Q| + |work| + |heat|
//! A⁺ = Σ |T_ij| |x_j| |Δx_i|          T: tangent of (f*, −g*, θ*),  x = (λ, γ, θ),  Δx = (Δλ, Δγ, Δs)
//! ```
//!
//! A* has the terms of the balance, A⁺ the work of the rounding of the arguments of the forces; A⁺ is computed only if A* is
//! not enough. Where the terms of an entropy cancel, the temperature found from it, and so the stored energy, has an error of
//! 8 ε of them: an eighth of `θ Σ |terms of s|` replaces smaller values of `|ψ| + θ|s| + cθ`.
//!
//! Forces cost a bound at most 0.4 of the digits: their terms in B* are limited to ε^−0.4 times the sum of the other
//! terms and `√ε Σ m (ℓ/h)²`, with the shortest element ℓ of each node, and their impulses in the bounds of momenta to
//! ε^−0.4 times `Σ |p| + m ℓ/h`. Every term carries some roundings; 64 is eight times the largest `|R|/(ε (A* + A⁺))`
//! seen in a correct step, near an anchor. Momenta and productions are checked as well.
//!
//! Where values of ψ have more rounding than B*, because its terms cancel, and R is within `B* + 4 ε M`, with
//! `M = Σ |terms of ψ|` at both ends, R cannot decide. Then discrete derivatives between the stored states, evaluated again,
//! give Δe instead of values.
//!
//! **Report.** Reported are R from values, and the bound B with the forces at both ends:
//!
//! ```text
//! B = B* + 64 ε Σ over both ends (|f|λ + Σ |g||γ|)  + 16 ε M
//! ```
//!
//! The second term is the effect of the rounding of λ and γ on ψ, which near a singular force is far above `|f*|λ`; the
//! evaluation of ψ has an error of 8 ε M. M is computed only where values cannot decide. The terms of forces in B are not
//! limited, so that the true ΔE of the stored states is within B. If B exceeds 100 times 64 ε of
//! `T + |ψ| + θ|s| + cθ + |f|λ + Σ|g||γ|` at both ends, the report says that its bound is wide. The forces at both ends
//! are evaluated for this only if the known terms alone would make the bound wide.

mod motion;

use crate::element::group::Group;
use crate::element::handle::Element;
use crate::element::state::State;
use crate::element::tally::{ROUNDINGS, Reevaluation, Tally};
use crate::step::error::StepFailure;
use crate::step::law::Law;
use eem_material::number::scalar::Scalar;

pub(crate) use motion::{Kept, Motion, NodeStep, Speeds};

/// Rounding errors of the certificate itself: of the values of ψ and θs at both ends. The defect must be smaller than the
/// bound by this margin.
const OWN_ROUNDINGS: f64 = 8.0;

/// The fraction of the bound up to which a step is accepted without another iteration.
const ENOUGH: f64 = 1.0 / 64.0;

/// Roundings of `Σ |q||p|` and of `Σ |p|` up to which a step is accepted without another iteration.
const ENOUGH_MOMENTUM: f64 = 4.0;

/// The fraction of digits that a bound may lose to forces: a Maxwell element with a stiffness ratio of 10⁷ loses 0.36.
const MOST_DIGITS: f64 = 0.4;

/// Rounding errors, in ε M, by which values of ψ and its discrete derivatives may disagree.
const VALUE_ROUNDINGS: f64 = 4.0;

/// Roundings of the terms of ψ in the reported bound: 4 by which values and differences may disagree, 8 of the
/// values, and 4 for what values and differences round together.
const REPORTED_VALUE_ROUNDINGS: f64 = 16.0;

/// A bound above this multiple of 64 ε of the terms of the energies is wide.
const WIDE: f64 = 100.0;

/// Energy and momentum if each node moved by its shortest element in a step: the scale for forces where nothing moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// `Σ m (ℓ/h)²`, J.
    pub(crate) energy: f64,
    /// `Σ m ℓ/h`, kg m/s.
    pub(crate) momentum: f64,
}

/// The proof of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Certificate {
    /// R, J.
    pub(crate) defect: f64,
    /// B, J.
    pub(crate) bound: f64,
    /// The magnitude of the terms of the motion, and of the energies at each end or their known part, J.
    motion: f64,
    terms: [f64; 2],
    /// The defect that decides, R or its replacement by discrete derivatives, and B*, J.
    judged: [f64; 2],
    /// The entropy production of all dashpots and paths of heat, J/K.
    pub(crate) production: f64,
    /// The smallest production of one of them; zero without any, J/K.
    pub(crate) least_production: f64,
    /// The largest component of the defect of each momentum, and the magnitude of its terms, kg m/s and kg m²/s.
    linear: [f64; 2],
    angular: [f64; 2],
    is_balanced: bool,
}

/// The change of the internal energy in a step, from values at both ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Internal {
    /// `Σ Δe + Σ θ_r Δσ_r + heat lost − heat`, J.
    change: f64,
    /// The magnitude of its terms at both ends, J.
    magnitude: f64,
    /// `Σ (|ψ| + θ|s| + cθ + Σ|f||π| + Σ|g||γ|)` of each end, or the known part of it, J.
    terms: [f64; 2],
    /// The part of `terms` that is neither in `magnitude` nor in the amplitude of forces, J.
    excess: f64,
}

impl Internal {
    pub(crate) fn new(reservoirs: &[f64], [old, next]: [&State; 2]) -> Self {
        let [mut change, mut magnitude, mut excess] = [0.0; 3];
        let mut terms = [0.0; 2];
        for (old, new) in old.energies.iter().zip(&next.energies) {
            change += new.value - old.value;
            magnitude += old.magnitude + new.magnitude;
            terms[0] += old.terms;
            terms[1] += new.terms;
            excess += old.excess + new.excess;
        }
        for (index, &theta) in reservoirs.iter().enumerate() {
            let sums = &next.reservoir_entropies;
            change += theta * sums.change(index, &old.reservoir_entropies);
        }
        let heat = next.heat.change(old.heat);
        change += next.dissipated.change(old.dissipated) - heat;
        Self {
            change,
            magnitude: magnitude + heat.abs(),
            terms,
            excess,
        }
    }
}

impl Reach {
    pub(crate) fn none() -> Self {
        let [energy, momentum] = [0.0; 2];
        Self { energy, momentum }
    }

    /// Adds a node with this mass, kg, and the slowness h/ℓ, s/m.
    pub(crate) fn add(&mut self, mass: f64, slowness: f64) {
        let momentum = mass / slowness;
        self.momentum += momentum;
        self.energy += momentum / slowness;
    }
}

impl Certificate {
    /// The certificate from the motion of the nodes, the balances of the elements and the energies of the stored states;
    /// `reach` is called if needed.
    pub(crate) fn new<const D: usize>(
        motion: &Motion<D>,
        tally: &Tally,
        internal: &Internal,
        reach: impl Fn() -> Reach,
    ) -> Self {
        let mut energy = motion.energy;
        energy.add(internal.change);
        let terms = motion.amplitude + tally.heat + internal.magnitude;
        let most = Scalar::powf(f64::EPSILON.recip(), MOST_DIGITS);
        let mut forces = tally.forces;
        if !(forces <= most * terms) {
            let slow = f64::EPSILON.sqrt() * reach().energy;
            forces = Scalar::minimum(forces, most * (terms + slow));
        }
        let mut impulse = tally.impulse;
        if !(impulse <= most * motion.momenta) {
            impulse = Scalar::minimum(impulse, most * (motion.momenta + reach().momentum));
        }
        let rounding = ROUNDINGS * f64::EPSILON;
        let defect = energy.value();
        let has_produced = tally.least < f64::MAX;
        let largest = |of: &[f64]| {
            of.iter()
                .fold(0.0, |most, x| Scalar::maximum(most, x.abs()))
        };
        Self {
            defect,
            bound: rounding * (terms + tally.forces + internal.excess),
            motion: motion.amplitude,
            terms: internal.terms,
            judged: [defect, rounding * (terms + forces)],
            production: tally.production,
            least_production: if has_produced { tally.least } else { 0.0 },
            linear: match motion.kept {
                Kept::Both => [largest(&motion.linear), motion.momenta + impulse],
                Kept::None | Kept::Angular(_) => [0.0; 2],
            },
            angular: [
                motion.angular.largest(),
                motion.moments + motion.farthest * impulse,
            ],
            is_balanced: tally.is_balanced,
        }
    }

    /// Takes energy changes that were evaluated again. They decide where the rounding of values exceeds the bound and
    /// explains the defect.
    pub(crate) fn reevaluated(mut self, reevaluation: &Reevaluation) -> Self {
        let [defect, bound] = self.judged;
        let rounding = VALUE_ROUNDINGS * f64::EPSILON * reevaluation.magnitude;
        let is_explained = bound < rounding && defect.abs() <= bound + rounding;
        let reevaluated = defect + reevaluation.correction;
        self.judged[0] = if is_explained { reevaluated } else { defect };
        self.bound += REPORTED_VALUE_ROUNDINGS * f64::EPSILON * reevaluation.magnitude;
        self
    }

    /// Whether the bound is far above the rounding of the energies, or not a number.
    pub(crate) fn is_bound_wide(&self) -> bool {
        let [old, new] = self.terms;
        is_wide(self.bound, self.motion + old + new)
    }

    /// With the terms of the energies in both states, which are evaluated if the known part of them makes the bound wide.
    pub(crate) fn with_terms_of<const D: usize>(
        mut self,
        groups: &[Box<dyn Group<D>>],
        ends: [&State; 2],
    ) -> Self {
        if self.is_bound_wide() {
            self.terms = ends.map(|state| {
                let groups = groups.iter().map(|group| group.elements());
                groups.fold(0.0, |sum, group| sum + group.energy_terms(state))
            });
        }
        self
    }

    /// The certificate of two parts of a step, one after the other.
    pub(crate) fn and(self, later: Self) -> Self {
        Self {
            defect: self.defect + later.defect,
            bound: self.bound + later.bound,
            motion: self.motion + later.motion,
            terms: [self.terms[0], later.terms[1]],
            production: self.production + later.production,
            least_production: Scalar::minimum(self.least_production, later.least_production),
            ..later
        }
    }

    /// An error unless the energy is a number after a step to `time`.
    pub(crate) fn unless_infinite(&self, time: f64) -> Result<(), StepFailure> {
        if self.defect.is_finite() {
            return Ok(());
        }
        Err(StepFailure::Energy {
            value: self.defect,
            time,
        })
    }

    /// Whether the balances of all nodes, dashpots and temperatures hold to rounding.
    #[inline]
    pub(crate) fn is_balanced(&self) -> bool {
        self.is_balanced
    }

    /// Whether the balances and all laws hold to what rounding explains.
    #[inline]
    pub(crate) fn is_lawful(&self) -> bool {
        self.is_balanced() && self.broken_law().is_none()
    }

    /// Whether all equations hold as accurately as after another iteration.
    #[inline]
    pub(crate) fn is_enough(&self) -> bool {
        let rounding = ENOUGH_MOMENTUM * f64::EPSILON;
        let [linear, momenta] = self.linear;
        let [angular, moments] = self.angular;
        self.is_balanced
            && self.has_enough_energy()
            && linear <= rounding * momenta
            && angular <= rounding * moments
            && self.least_production >= 0.0
    }

    /// Whether the energy is as accurate as after another iteration.
    #[inline]
    pub(crate) fn has_enough_energy(&self) -> bool {
        let [defect, bound] = self.judged;
        defect.abs() <= ENOUGH * bound
    }

    /// The certificate of a more thorough closing of the same step, with the momenta of this one.
    pub(crate) fn sharpened_by(self, thorough: Self) -> Self {
        Self {
            production: self.production,
            least_production: self.least_production,
            linear: self.linear,
            angular: self.angular,
            ..thorough
        }
    }

    /// The first violated law, with its defect and the bound for rounding.
    pub(crate) fn broken_law(&self) -> Option<(Law, [f64; 2])> {
        let rounding = ROUNDINGS * f64::EPSILON;
        let [energy, bound] = self.judged;
        let [linear, momenta] = self.linear;
        let [angular, moments] = self.angular;
        let laws = [
            (
                Law::Energy,
                energy,
                (1.0 - OWN_ROUNDINGS / ROUNDINGS) * bound,
            ),
            (Law::LinearMomentum, linear, rounding * momenta),
            (Law::AngularMomentum, angular, rounding * moments),
            (
                Law::Production,
                Scalar::minimum(self.least_production, 0.0),
                0.0,
            ),
        ];
        // A NaN violates a law.
        let broken = laws
            .into_iter()
            .find(|(_, defect, bound)| !(defect.abs() <= *bound));
        broken.map(|(law, defect, bound)| (law, [defect, bound]))
    }
}

/// Whether a bound is far above the rounding of these terms of energies, J, or not a number.
pub(crate) fn is_wide(bound: f64, terms: f64) -> bool {
    let most = WIDE * ROUNDINGS * f64::EPSILON * terms;
    !(bound <= most)
}

impl Law {
    /// The error of a step to `time` that violates the law, most of all in one element.
    pub(crate) fn not_kept(
        self,
        [defect, bound]: [f64; 2],
        element: Option<Element>,
        time: f64,
    ) -> StepFailure {
        StepFailure::LawNotKept {
            law: self,
            defect,
            bound,
            element,
            time,
        }
    }
}

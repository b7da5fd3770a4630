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
//!      + Σ η Δγ²/h + Σ |Q| + |work| + |heat|
//! A⁺ = Σ |T_ij| |x_j| |Δx_i|          T: tangent of (f*, −g*, θ*),  x = (λ, γ, θ),  Δx = (Δλ, Δγ, Δs)
//! ```
//!
//! A has the terms of the balance, A⁺ the work of the rounding of the arguments of the forces. Of what
//! forces contribute to both, half of the digits count at most: the 1/√ε of the other terms and of
//! `Σ m (ℓ/h)²`, with the shortest element ℓ of each node. A⁺ is found only where A is not enough. Every
//! term carries some roundings; 64 is eight times the largest `|R|/(ε (A + A⁺))` that a right step has
//! shown, near an anchor. Momenta and productions are judged beside the energy.

use crate::error::{Law, StepFailure};
use crate::handle::Element;
use crate::kernel::two_sum;
use crate::scalar::{Mask, Real};

/// Roundings of the amplitude that a law may be off by.
const ROUNDINGS: f64 = 64.0;

/// The part of them up to which a step is taken without another iteration.
const ENOUGH: f64 = 0.03125;

/// Roundings of `Σ |q||p|` and of `Σ |p|` up to which a step is taken without another iteration.
const ENOUGH_MOMENTUM: f64 = 4.0;

/// Roundings of the terms of the balance of a node, a dashpot or a temperature that it may be off by, when
/// the arguments of the forces are left out: what is left of a small update is of this size, where false
/// convergence is off by the terms themselves. Energy and momenta are judged apart.
const BALANCE_ROUNDINGS: f64 = 4096.0;

/// Roundings of the largest terms of a free energy, in the evaluation of which several add up.
const VALUE_ROUNDINGS: f64 = 4.0;

/// How much of what rounding explains is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Care {
    /// The terms of the balances alone, which is enough for most steps.
    Quick,
    /// Also the rounding of the arguments of the forces.
    Thorough,
}

/// What elements and paths of heat contribute to a certificate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tally<S: Real> {
    pub(crate) care: Care,
    /// Heat that flows, J.
    heat: S,
    /// What forces contribute to A, and A⁺, J.
    forces: S,
    /// What they have produced, J/K.
    production: S,
    /// The smallest of all productions; the largest number without any, J/K.
    least: S,
    /// Every balance of an internal variable holds to rounding.
    is_balanced: S::Mask,
}

impl<S: Real> Tally<S> {
    /// Of nothing.
    pub(crate) fn new(care: Care) -> Self {
        Self {
            care,
            heat: S::zero(),
            forces: S::zero(),
            production: S::zero(),
            least: S::MAX,
            is_balanced: !S::Mask::none(),
        }
    }

    /// Heat that takes part in the balance, J.
    #[inline]
    pub(crate) fn turn_over(&mut self, heat: S) {
        self.heat += heat.abs();
    }

    /// What the forces of an element and the rounding of their arguments contribute, J.
    #[inline]
    pub(crate) fn force(&mut self, energy: S) {
        self.forces += energy;
    }

    /// Entropy that a dashpot or a path of heat has produced, J/K.
    #[inline]
    pub(crate) fn produce(&mut self, entropy: S) {
        self.production += entropy;
        self.least = self.least.minimum(entropy);
    }

    /// What a balance is off by, and the magnitude of its terms.
    #[inline]
    pub(crate) fn balance(&mut self, residual: S, magnitude: S) {
        let roundings = match self.care {
            Care::Quick => BALANCE_ROUNDINGS,
            Care::Thorough => ROUNDINGS,
        };
        let bound = S::from_f64(roundings) * S::EPSILON * magnitude;
        self.is_balanced = self.is_balanced & residual.abs().at_most(bound);
    }
}

/// What the motion of the nodes contributes to a certificate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<S, const D: usize> {
    /// What momenta are kept, and about which point, m.
    pub(crate) kept: Kept<S, D>,
    /// `Σ v̄·Δp − work`, J.
    energy: Sum<S>,
    amplitude: S,
    /// `Σ (Δp − hF)` of the loads F, and `Σ |p|`, kg m/s.
    linear: [S; D],
    momenta: S,
    /// `Σ (q_m − o) × (Δp − hF) + Δq × p_m`, and `Σ |q_m − o||p|`, kg m²/s.
    angular: [S; 3],
    moments: S,
}

/// Which momenta a scene keeps but for its loads.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kept<S, const D: usize> {
    /// With two anchors or more, or moved ones: none.
    None,
    /// With one anchor at this place: the angular momentum about it.
    Angular([S; D]),
    /// Without anchors: both, about the origin.
    Both,
}

/// What a node did in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeStep<'a, S, const D: usize> {
    /// `1/m`, 1/kg.
    pub(crate) per_mass: S,
    /// q⁰, m.
    pub(crate) position: &'a [S; D],
    /// p⁰, kg m/s.
    pub(crate) momentum: &'a [S; D],
    /// Δq, m.
    pub(crate) displacement: &'a [S; D],
    /// Δp, kg m/s.
    pub(crate) impulse: &'a [S; D],
}

impl<S: Real, const D: usize> Motion<S, D> {
    /// Of nothing.
    pub(crate) fn new(kept: Kept<S, D>) -> Self {
        let zero = S::zero();
        Self {
            kept,
            energy: Sum::new(),
            amplitude: zero,
            linear: [zero; D],
            momenta: zero,
            angular: [zero; 3],
            moments: zero,
        }
    }

    /// A node that moves, with the force of its loads if there are any, N.
    #[inline]
    pub(crate) fn see(&mut self, node: &NodeStep<'_, S, D>, force: Option<&[S; D]>, step: S) {
        let half = S::from_f64(0.5);
        let (mut gain, mut square) = (S::zero(), S::zero());
        for (&p, &change) in node.momentum.iter().zip(node.impulse) {
            let end = p + change;
            gain += (p + half * change) * change;
            square += p * p + end * end;
        }
        self.energy.add(gain * node.per_mass);
        self.amplitude += half * square * node.per_mass;
        if D > 0 && !matches!(self.kept, Kept::None) {
            let load = force.map(|force| force.map(|force| step * force));
            self.see_momenta(node, &load.unwrap_or([S::zero(); D]));
        }
        if let Some(force) = force {
            for (&force, &displacement) in force.iter().zip(node.displacement) {
                self.work(force * displacement);
            }
        }
    }

    /// Work that a load or a support has done, J.
    #[inline]
    pub(crate) fn work(&mut self, work: S) {
        self.energy.add(-work);
        self.amplitude += work.abs();
    }

    fn see_momenta(&mut self, node: &NodeStep<'_, S, D>, load: &[S; D]) {
        let half = S::from_f64(0.5);
        let origin = match self.kept {
            Kept::Angular(origin) => origin,
            Kept::None | Kept::Both => [S::zero(); D],
        };
        let (mut arm, mut mean, mut net) = ([S::zero(); D], [S::zero(); D], [S::zero(); D]);
        let (mut length, mut size) = (S::zero(), S::zero());
        for axis in 0..D {
            let (p, change) = (node.momentum[axis], node.impulse[axis]);
            arm[axis] = (node.position[axis] - origin[axis]) + half * node.displacement[axis];
            mean[axis] = p + half * change;
            net[axis] = change - load[axis];
            self.linear[axis] += net[axis];
            length += arm[axis].abs() + node.displacement[axis].abs();
            size += p.abs() + (p + change).abs() + load[axis].abs();
        }
        self.momenta += size;
        self.moments += length * size;
        for (angular, [i, j]) in self.angular.iter_mut().zip([[0, 1], [0, 2], [1, 2]]) {
            if j < D {
                let turned = |a: &[S; D], b: &[S; D]| a[i] * b[j] - a[j] * b[i];
                *angular += turned(&arm, &net) + turned(node.displacement, &mean);
            }
        }
    }
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

impl<S: Real> Certificate<S> {
    /// From the motion of the nodes, what the elements say, and the energy `Σ Δe + Σ θ_r Δσ_r + heat lost −
    /// heat` with the magnitude of its terms; and `Σ m (ℓ/h)²`, J, if it is asked for.
    pub(crate) fn new<const D: usize>(
        motion: &Motion<S, D>,
        tally: &Tally<S>,
        [internal, magnitude]: [S; 2],
        reach: impl FnOnce() -> S,
    ) -> Self {
        let mut energy = motion.energy;
        energy.add(internal);
        let terms = motion.amplitude + tally.heat + magnitude;
        let half_of_digits = S::EPSILON.sqrt().recip();
        let mut forces = tally.forces;
        if !forces.at_most(half_of_digits * terms).all() {
            forces = forces.minimum(half_of_digits * (terms + reach()));
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
                Kept::Both => [largest(&motion.linear), motion.momenta],
                Kept::None | Kept::Angular(_) => [S::zero(); 2],
            },
            angular: [largest(&motion.angular), motion.moments],
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
        self.is_balanced.decide()
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
            (Law::Energy, self.defect, self.bound),
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
            .find(|(_, defect, bound)| !defect.abs().at_most(*bound).decide());
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

/// A sum to twice the precision, so that adding up a large scene costs no digits.
#[derive(Clone, Copy, Debug)]
struct Sum<S> {
    value: S,
    rest: S,
}

impl<S: Real> Sum<S> {
    fn new() -> Self {
        let (value, rest) = (S::zero(), S::zero());
        Self { value, rest }
    }

    #[inline]
    fn add(&mut self, term: S) {
        let (value, rest) = two_sum(self.value, term);
        self.value = value;
        self.rest += rest;
    }

    fn value(self) -> S {
        self.value + self.rest
    }
}

/// The energies of the elements counted anew, when the balance of a scene does not close.
///
/// Where a free energy is coded with terms that cancel, its values have more rounding than its
/// differences: then `Δe` by discrete derivatives, formed anew between the stored states, decides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recount<S> {
    /// `Σ (Δe by differences − Δe by values)`, J.
    pub(crate) correction: S,
    /// The magnitude of the terms of all free energies at both ends, J.
    pub(crate) magnitude: S,
    /// The element whose own balance is off by most, and by how much, J.
    worst: Option<(Element, S)>,
}

impl<S: Real> Recount<S> {
    /// Of no elements.
    pub(crate) fn new() -> Self {
        Self {
            correction: S::zero(),
            magnitude: S::zero(),
            worst: None,
        }
    }

    /// An element with its `Δe` by values, the magnitude of the terms of its free energy at both ends, its `Δe`
    /// by differences, and `f*Δλ − Σ g*Δγ + θ*Δs` with what the step has found, J.
    pub(crate) fn element(
        &mut self,
        element: Element,
        [by_values, magnitude]: [S; 2],
        by_differences: S,
        found: S,
    ) {
        self.correction += by_differences - by_values;
        self.magnitude += magnitude;
        let defect = (by_differences - found).abs();
        let is_worse = self
            .worst
            .is_none_or(|(_, worst)| !defect.at_most(worst).decide());
        if is_worse {
            self.worst = Some((element, defect));
        }
    }

    /// The element whose own balance is off by most.
    pub(crate) fn worst(&self) -> Option<Element> {
        self.worst.map(|(element, _)| element)
    }
}

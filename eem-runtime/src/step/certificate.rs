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
//! |R − W_r| ≤ B* = 64 ε (A* + A⁺)
//! A* = Σ over both ends (T + |ψ| + θ|s| + cθ) + Σ |f*|(λ⁰ + λ¹) + Σ |g*|(|γ⁰| + |γ¹|)
//!      + ε Σ (|T_λλ| λ² + |T_γγ| γ²) + Σ η Δγ²/h + Σ |Q| + |work| + |heat|
//! A⁺ = Σ |T_ij| |x_j| |Δx_i| + Σ |F| |Δq|     T: tangent of (f*, −g*, θ*),  x = (λ, γ, θ),  Δx = (Δλ, Δγ, Δs)
//! W_r = Σ r·Δq/h                              r = Δp + h Σ F − h F_loads
//! ```
//!
//! A* has the terms of the balance, A⁺ the work of the rounding of the arguments of the forces, and of the sums of the
//! forces F of elements at their nodes, masses and anchors. A⁺ and `W_r` are computed only if A* is not enough. Where the
//! terms of an entropy cancel, the temperature found from it, and so the stored energy, has an error of
//! 8 ε of them: an eighth of `θ Σ |terms of s|` replaces smaller values of `|ψ| + θ|s| + cθ`.
//!
//! `W_r` is what the residuals r of the momentum balances do. A force answers to the rounding of its length with `k ε λ`,
//! so that no iteration makes r smaller. Nor does r act on both nodes of an element alike, as its force does: over a
//! displacement Δq far above Δλ, as of a mass that travels with its moved anchor, its work `k ε λ |Δq|` is far above
//! `k ε λ |Δλ|` of A⁺. The momenta p¹ are those of the increments, so that the states have gained `W_r`. It is known, and not
//! bounded: subtracted from R it leaves what the forces of the elements have done, against which a wrong force is seen
//! as before. Each r must be rounding, see [`Tally::balance_node`]; then `W_r` is.
//!
//! A step through stages has residuals ρ at them, and further roundings: `W_r` is `Σ_j b_j q̇_j·r_j` with the residuals `r_j` of
//! the rates, which follow from ρ, and A⁺ has
//!
//! ```text
//! Σ_j b_j (|F_j| |h q̇_j| + |∇ê¹ ∂C/∂d_j| |h ḋ_j|) + |F¹| (h|v⁰| + Σ_j |displacements_j w_j|) + |p¹| Σ_j |impulses_j w_j|/h
//! ```
//!
//! with the terms of the sums of forces, of the path of C, which ends at the strain of the new arms but for its
//! rounding, and of the new positions and velocities, which are sums of increments w. These are far above the motion of a
//! step where it is many periods long.
//!
//! The residuals r change momenta, too. Iterations go on until momenta hold to the rounding of Σ |p| and of the impulses
//! h|f*|; where none helps any more, what is left may be as large as the r that the balances of the nodes allow: the rounding of
//! their terms, among them `h k λ`, which is far above h|f*| where stiff springs are nearly relaxed. In the angular momentum
//! each has the arm of the farthest node.
//!
//! Nothing limits A*, A⁺ and the impulses in the bounds of momenta: where energies vanish, as when a Maxwell element
//! is relaxed (`g → 0`), the rounding `|g| ε |γ|` of what is left vanishes more slowly than the energies `g²/2k`. Every term
//! carries some roundings; 64 is eight times the largest `|R|/(ε (A* + A⁺))` seen in a correct step, near an anchor.
//! Momenta and productions are checked as well.
//!
//! Where values of ψ have more rounding than B*, because its terms cancel, and `R − W_r` is within `B* + 4 ε M`, with
//! `M = Σ |terms of ψ|` at both ends, it cannot decide. Then discrete derivatives between the stored states, evaluated
//! again, give Δe instead of values.
//!
//! **Report.** Reported are R from values, and the bound B with the forces at both ends:
//!
//! ```text
//! B = B* + |W_r| + 64 ε Σ over both ends (|f|λ + Σ |g||γ|)  + 16 ε M
//! ```
//!
//! The third term is the effect of the rounding of λ and γ on ψ, which near a singular force is far above `|f*|λ`; the
//! evaluation of ψ has an error of 8 ε M. M is computed only where values cannot decide. The true ΔE of the stored
//! states is within B. If B exceeds 100 times 64 ε of
//! `T + |ψ| + θ|s| + cθ + |f|λ + Σ|g||γ|` at both ends, the report says that its bound is wide. The forces at both ends
//! are evaluated for this only if the known terms alone would make the bound wide.

mod motion;

use crate::algebra::largest;
use crate::element::group::Group;
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

/// Rounding errors, in ε M, by which values of ψ and its discrete derivatives may disagree.
const VALUE_ROUNDINGS: f64 = 4.0;

/// Roundings of the terms of ψ in the reported bound: 4 by which values and differences may disagree, 8 of the
/// values, and 4 for what values and differences round together.
const REPORTED_VALUE_ROUNDINGS: f64 = 16.0;

/// A bound above this multiple of 64 ε of the terms of the energies is wide.
const WIDE: f64 = 100.0;

/// The proof of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Certificate {
    /// R, J.
    pub(crate) defect: f64,
    /// B, J.
    pub(crate) bound: f64,
    /// T of both ends, and the magnitude of the energies at each end or their known part, J.
    motion: f64,
    terms: [f64; 2],
    /// The defect that decides, R or its replacement by discrete derivatives, and B*, J.
    judged: [f64; 2],
    /// `W_r`, J.
    residual_work: f64,
    /// The entropy production of all dashpots and paths of heat, J/K.
    pub(crate) production: f64,
    /// The smallest production of one of them; zero without any, J/K.
    pub(crate) least_production: f64,
    /// Conductions and dashpots that relax faster than the step resolves.
    pub(crate) unresolved: usize,
    /// The largest component of the defect of each momentum, and the magnitude of its terms, kg m/s and kg m²/s.
    linear: [f64; 2],
    angular: [f64; 2],
    /// The terms of the balances of nodes in the linear and the angular momentum, if bounds are thorough.
    residues: [f64; 2],
    /// Whether the balances of all nodes, dashpots and temperatures hold to rounding.
    pub(crate) is_balanced: bool,
}

impl Certificate {
    /// The certificate from the motion of the nodes, the balances of the elements and the energies of the stored states.
    #[inline]
    pub(crate) fn new<const D: usize>(
        motion: &Motion<D>,
        tally: &Tally,
        reservoirs: &[f64],
        [old, next]: [&State; 2],
    ) -> Self {
        // `Σ Δe + Σ θ_r Δσ_r + heat lost − heat`, the magnitude of its terms at both ends, and what of the terms of the energies at
        // each end is neither in that nor in the amplitude of forces.
        let [mut change, mut magnitude, mut excess] = [0.0; 3];
        let mut ends = [0.0; 2];
        for (old, new) in old.energies.iter().zip(&next.energies) {
            change += new.value - old.value;
            magnitude += old.magnitude + new.magnitude;
            ends[0] += old.terms;
            ends[1] += new.terms;
            excess += old.excess + new.excess;
        }
        for (index, &theta) in reservoirs.iter().enumerate() {
            let sums = &next.reservoir_entropies;
            change += theta * sums.change(index, &old.reservoir_entropies);
        }
        let heat = next.heat.change(old.heat);
        change += next.dissipated.change(old.dissipated) - heat;
        let mut energy = motion.energy;
        energy.add(change);
        // Below the smallest normal number, rounding is that of this number.
        let least = f64::MIN_POSITIVE;
        let internal = magnitude + heat.abs();
        let terms = motion.kinetic + motion.works + tally.heat + internal + least;
        let rounding = ROUNDINGS * f64::EPSILON;
        let defect = energy.value();
        let has_produced = tally.least < f64::MAX;
        let momenta = motion.momenta + tally.impulse + least;
        let moments = motion.moments + motion.farthest * tally.impulse + least;
        Self {
            defect,
            bound: rounding * (terms + tally.forces + excess) + motion.residual_work.abs(),
            motion: motion.kinetic,
            terms: ends,
            judged: [defect, rounding * (terms + tally.forces)],
            residual_work: motion.residual_work,
            production: tally.production,
            least_production: if has_produced { tally.least } else { 0.0 },
            unresolved: tally.unresolved,
            linear: match motion.kept {
                Kept::Both => [largest(&motion.linear), momenta],
                Kept::None | Kept::Angular(_) => [0.0; 2],
            },
            angular: [motion.angular.largest(), moments],
            residues: [tally.residues, motion.farthest * tally.residues],
            is_balanced: tally.is_balanced,
        }
    }

    /// Takes energy changes that were evaluated again. They decide where the rounding of values exceeds the bound and
    /// explains the defect.
    pub(crate) fn reevaluated(mut self, reevaluation: &Reevaluation) -> Self {
        let [defect, bound] = self.judged;
        let rounding = VALUE_ROUNDINGS * f64::EPSILON * reevaluation.magnitude;
        let own = (defect - self.residual_work).abs();
        let is_explained = bound < rounding && own <= bound + rounding;
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

    /// Evaluates the terms of the energies in both states, of which a part is known: where that makes the bound wide.
    #[cold]
    #[inline]
    pub(crate) fn find_terms<const D: usize>(
        &mut self,
        groups: &[Box<dyn Group<D>>],
        ends: [&State; 2],
    ) {
        self.terms = ends.map(|state| {
            let groups = groups.iter().map(|group| group.elements());
            groups.fold(0.0, |sum, group| sum + group.energy_terms(state))
        });
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
            unresolved: self.unresolved.max(later.unresolved),
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

    /// Whether the balances and all laws hold to what rounding explains.
    #[inline]
    pub(crate) fn is_lawful(&self) -> bool {
        self.is_balanced && self.broken_beyond([0.0; 2]).is_none()
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

    /// The first law that stays violated where no iteration helps any more, with its defect and the bound for rounding.
    #[cold]
    pub(crate) fn unexplained_law(&self) -> Option<(Law, [f64; 2])> {
        self.broken_beyond(self.residues)
    }

    /// The first violated law, with these terms of the momenta beside their own.
    fn broken_beyond(&self, residues: [f64; 2]) -> Option<(Law, [f64; 2])> {
        let [energy, bound] = self.judged;
        let bound = (1.0 - OWN_ROUNDINGS / ROUNDINGS) * bound;
        let momentum = |[defect, terms]: [f64; 2], residue: f64| {
            [defect, ROUNDINGS * f64::EPSILON * (terms + residue)]
        };
        let lost = Scalar::minimum(self.least_production, 0.0);
        let mut laws = [
            (Law::Energy, [energy - self.residual_work, bound]),
            (Law::LinearMomentum, momentum(self.linear, residues[0])),
            (Law::AngularMomentum, momentum(self.angular, residues[1])),
            (Law::Production, [lost, 0.0]),
        ]
        .into_iter();
        // A NaN violates a law.
        laws.find(|(_, [defect, bound])| !(defect.abs() <= *bound))
    }
}

/// Whether a bound is far above the rounding of these terms of energies, J, or not a number.
pub(crate) fn is_wide(bound: f64, terms: f64) -> bool {
    let most = WIDE * ROUNDINGS * f64::EPSILON * terms;
    !(bound <= most)
}

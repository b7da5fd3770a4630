//! What an explicit scheme keeps: rates, quadratures, targets.

use crate::algebra::bivector::{Bivector, planes};
use crate::element::group::Offsets;
use crate::step::explicit::components::Components;
use crate::step::explicit::guard::PerWeight;
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::scalar::Real;

/// The rows of the rates at the start of the step, and at its end.
pub(super) const START: usize = 0;
pub(super) const END: usize = 10;

/// Vectors of rates that are kept at the same time, per variable of a stage vector.
pub(super) type Rows<S> = [Vec<S>; END + 1];

/// What belongs to the rates of a state, and is integrated over a step.
#[derive(Clone, Debug)]
pub(super) struct Sample<S, const D: usize> {
    /// `g γ̇` of each dashpot, W.
    pub(super) powers: Vec<S>,
    /// `f λ̇` and the heat that flows in, per thermal slot, W; empty without thermostats.
    pub(super) supply: Vec<S>,
    /// The force of the elements on each place of an anchor, N.
    pub(super) reactions: Vec<[S; D]>,
    /// The loads on the nodes of the scene, with their weights, N; empty without.
    pub(super) loads: Vec<S>,
    /// The same without weights.
    pub(super) forces: Vec<S>,
}

/// What loads have done to a component in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoadSums<S, const D: usize> {
    /// J.
    pub(super) work: S,
    /// N s.
    pub(super) impulse: [S; D],
    /// N m s.
    pub(super) torque: Bivector<S, D>,
}

/// Integrals over a step, and what some of them consist of.
#[derive(Clone, Debug)]
pub(super) struct Quadrature<S, const D: usize> {
    /// θ of slots and of reservoirs at the stages with weights, and 1 for dashpots without temperature, K.
    pub(super) temperatures: Vec<PerWeight<S>>,
    /// `g γ̇` of each dashpot at these stages, W.
    pub(super) powers: Vec<PerWeight<S>>,
    /// `∫ supply`, per thermal slot, J; empty without thermostats.
    pub(super) supply: Vec<S>,
    /// Per component; empty without loads and moved anchors.
    pub(super) loads: Vec<LoadSums<S, D>>,
}

/// What energy and momenta of a component have to be, to twice the precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Target<S, const D: usize> {
    /// E, with the heat that reservoirs have received and that dashpots have lost, J.
    pub(super) energy: Sum<S>,
    /// L, kg m/s.
    pub(super) linear: [Sum<S>; D],
    /// J about the anchor, or about the centre of mass where there is none, kg m²/s.
    pub(super) angular: Bivector<Sum<S>, D>,
    /// Heat of dashpots in elements without temperature, J.
    pub(super) lost: Sum<S>,
}

/// What steps have booked.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Books<S, const D: usize> {
    /// Per component.
    pub(super) targets: Vec<Target<S, D>>,
    /// What each reservoir has received from each component, J/K.
    pub(super) shares: Compensated<S>,
    /// The energies of elements with thermostats, per thermal slot, J; empty without.
    pub(super) held_energies: Vec<S>,
    /// The largest |p|₂ of all states so far, kg m/s.
    pub(super) largest_momentum: S,
    /// E less its targets, of all components, J.
    pub(super) residue: S,
    /// What the bound of a step counts of this state, and the terms of its energies, J; `None` where no step has led
    /// to it.
    pub(super) terms: Option<[S; 2]>,
}

impl<S: Real, const D: usize> Target<S, D> {
    /// Zero.
    pub(super) fn none() -> Self {
        let zero = Sum::new(S::zero());
        Self {
            energy: zero,
            linear: [zero; D],
            angular: Bivector::filled(zero),
            lost: zero,
        }
    }

    /// All its sums, as they are saved.
    pub(super) fn each_mut(&mut self, mut visit: impl FnMut(&mut Sum<S>)) {
        visit(&mut self.energy);
        visit(&mut self.lost);
        self.linear.iter_mut().for_each(&mut visit);
        for plane in planes::<D>() {
            visit(self.angular.at_mut(plane));
        }
    }
}

impl<S: Real, const D: usize> Books<S, D> {
    pub(super) fn new(components: &Components<S>, held: usize) -> Self {
        Self {
            targets: vec![Target::none(); components.all.len()],
            shares: Compensated::new(vec![S::zero(); components.shares.len()]),
            held_energies: vec![S::zero(); held],
            largest_momentum: S::zero(),
            residue: S::zero(),
            terms: None,
        }
    }

    /// Takes over those of the same scene.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.targets.copy_from_slice(&other.targets);
        self.shares.copy_from(&other.shares);
        self.held_energies.copy_from_slice(&other.held_energies);
        self.largest_momentum = other.largest_momentum;
        self.residue = other.residue;
        self.terms = other.terms;
    }
}

impl<S: Real, const D: usize> Sample<S, D> {
    pub(super) fn new(offsets: Offsets, anchors: usize, [supply, loads]: [usize; 2]) -> Self {
        Self {
            powers: vec![S::zero(); offsets.temperatures - offsets.viscous],
            supply: vec![S::zero(); supply],
            reactions: vec![[S::zero(); D]; anchors],
            loads: vec![S::zero(); loads],
            forces: vec![S::zero(); loads],
        }
    }
}

impl<S: Real, const D: usize> LoadSums<S, D> {
    pub(super) fn none() -> Self {
        Self {
            work: S::zero(),
            impulse: [S::zero(); D],
            torque: Bivector::zero(),
        }
    }
}

impl<S: Real, const D: usize> Quadrature<S, D> {
    /// Of a scene with so many thermal slots, dashpots, slots where there are thermostats, and components with
    /// loads.
    pub(super) fn new(
        [slots, dashpots]: [usize; 2],
        reservoirs: &[S],
        [supply, loads]: [usize; 2],
    ) -> Self {
        let mut temperatures = vec![[S::one(); _]; slots];
        temperatures.extend(reservoirs.iter().map(|&theta| [theta; _]));
        temperatures.push([S::one(); _]);
        Self {
            temperatures,
            powers: vec![[S::zero(); _]; dashpots],
            supply: vec![S::zero(); supply],
            loads: vec![LoadSums::none(); loads],
        }
    }

    /// Whether nothing comes from outside, besides the heat of reservoirs.
    #[inline]
    pub(super) fn is_closed(&self) -> bool {
        self.supply.is_empty() && self.loads.is_empty()
    }

    /// Begins a step.
    pub(super) fn clear(&mut self) {
        self.supply.fill(S::zero());
        self.loads.fill(LoadSums::none());
    }

    /// `∫ g γ̇/θ` of a dashpot, J/K; `∫ g γ̇` of one without temperature, J.
    #[inline]
    pub(super) fn of_dashpot(&self, dashpot: usize, slot: usize, weights: &PerWeight<S>) -> S {
        let mut sum = S::zero();
        let (powers, temperatures) = (&self.powers[dashpot], &self.temperatures[slot]);
        for (at, &weight) in weights.iter().enumerate() {
            sum += weight * powers[at] * temperatures[at].recip();
        }
        sum
    }
}

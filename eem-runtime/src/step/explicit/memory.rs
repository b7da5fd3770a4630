//! Values that an explicit scheme keeps from step to step: targets and accumulated sums.

use crate::algebra::bivector::{Bivector, planes};
use crate::step::explicit::components::Components;
use eem_material::number::compensated::Sum;
use eem_material::number::scalar::Real;

/// Work and impulses of the loads on a component in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoadSums<S, const D: usize> {
    /// J.
    pub(super) work: S,
    /// N s.
    pub(super) impulse: [S; D],
    /// N m s.
    pub(super) torque: Bivector<S, D>,
}

/// The targets of energy and momenta of a component, to twice the precision.
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

/// Values accumulated over the steps.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Books<S, const D: usize> {
    /// Per component.
    pub(super) targets: Vec<Target<S, D>>,
    /// The entropy that each reservoir has received from each component, J/K.
    pub(super) shares: Vec<Sum<S>>,
    /// The largest |p|₂ of all states so far, kg m/s.
    pub(super) largest_momentum: S,
    /// E less its targets, of all components, J.
    pub(super) residue: S,
    /// The contribution of this state to the bound of a step, and the terms of its energies, J; `None` unless a step
    /// has led to it.
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

    /// Calls a function for each of its sums, in the order in which they are saved.
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
    pub(super) fn new(components: &Components<S>) -> Self {
        Self {
            targets: vec![Target::none(); components.all.len()],
            shares: vec![Sum::new(S::zero()); components.shares.len()],
            largest_momentum: S::zero(),
            residue: S::zero(),
            terms: None,
        }
    }

    /// Sets all sums to zero.
    pub(super) fn clear(&mut self) {
        self.targets.fill(Target::none());
        self.shares.fill(Sum::new(S::zero()));
        (self.largest_momentum, self.residue) = (S::zero(), S::zero());
        self.terms = None;
    }

    /// Copies the values of `other`, of the same scene; targets only where steps change them.
    #[inline]
    pub(super) fn copy_from(&mut self, other: &Self, change_targets: bool) {
        if change_targets {
            self.targets.copy_from_slice(&other.targets);
        }
        self.shares.copy_from_slice(&other.shares);
        self.largest_momentum = other.largest_momentum;
        self.residue = other.residue;
        self.terms = other.terms;
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

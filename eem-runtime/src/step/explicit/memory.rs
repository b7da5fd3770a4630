//! Values that an explicit scheme keeps from step to step: targets and accumulated sums.

use crate::algebra::bivector::{Bivector, planes};
use crate::step::explicit::components::Components;
use eem_material::number::compensated::Sum;

/// Work and impulses of the loads on a component in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoadSums<const D: usize> {
    /// J.
    pub(super) work: f64,
    /// N s.
    pub(super) impulse: [f64; D],
    /// N m s.
    pub(super) torque: Bivector<f64, D>,
    /// `Σ |b| |f·ẋ|` of moved anchors, W, and `Σ |b| Σ_m |ℓ'_m| |f − f⁰||x|`, J: times ε/2, what the rounding of their positions x
    /// does to their work.
    pub(super) effort: f64,
    pub(super) noise: f64,
    /// `Σ |b| Σ |r||F|` in space, N m: times ε, the rounding of the torque.
    pub(super) moment: f64,
}

/// The targets of energy and momenta of a component, to twice the precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Target<const D: usize> {
    /// E, with the heat that reservoirs have received and that dashpots have lost, J.
    pub(super) energy: Sum,
    /// L, kg m/s.
    pub(super) linear: [Sum; D],
    /// J about the anchor, or about the centre of mass where there is none, kg m²/s.
    pub(super) angular: Bivector<Sum, D>,
    /// Heat of dashpots in elements without temperature, J.
    pub(super) lost: Sum,
}

/// Values accumulated over the steps.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Books<const D: usize> {
    /// Per component.
    pub(super) targets: Vec<Target<D>>,
    /// The entropy that each reservoir has received from each component, J/K.
    pub(super) shares: Vec<Sum>,
    /// The largest |p|₂ of all states so far, kg m/s.
    pub(super) largest_momentum: f64,
    /// E less its targets, of all components, J.
    pub(super) residue: f64,
    /// The contribution of this state to the bound of a step, and the terms of its energies, J; `None` unless a step
    /// has led to it.
    pub(super) terms: Option<[f64; 2]>,
}

impl<const D: usize> Target<D> {
    /// Zero.
    pub(super) fn none() -> Self {
        let zero = Sum::new(0.0);
        Self {
            energy: zero,
            linear: [zero; D],
            angular: Bivector::filled(zero),
            lost: zero,
        }
    }

    /// Calls a function for each of its sums, in the order in which they are saved.
    pub(super) fn each_mut(&mut self, visit: &mut dyn FnMut(&mut Sum)) {
        visit(&mut self.energy);
        visit(&mut self.lost);
        for linear in &mut self.linear {
            visit(linear);
        }
        for plane in planes::<D>() {
            visit(self.angular.at_mut(plane));
        }
    }
}

impl<const D: usize> Books<D> {
    pub(super) fn new(components: &Components) -> Self {
        Self {
            targets: vec![Target::none(); components.all.len()],
            shares: vec![Sum::new(0.0); components.shares.len()],
            largest_momentum: 0.0,
            residue: 0.0,
            terms: None,
        }
    }

    /// Sets all sums to zero.
    pub(super) fn clear(&mut self) {
        self.targets.fill(Target::none());
        self.shares.fill(Sum::new(0.0));
        (self.largest_momentum, self.residue) = (0.0, 0.0);
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

impl<const D: usize> LoadSums<D> {
    pub(super) fn none() -> Self {
        Self {
            work: 0.0,
            impulse: [0.0; D],
            torque: Bivector::zero(),
            effort: 0.0,
            noise: 0.0,
            moment: 0.0,
        }
    }
}

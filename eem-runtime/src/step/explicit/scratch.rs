//! Working memory of the closing of a step.

use crate::element::group::ComponentEnergy;
use crate::element::layout::Layout;
use crate::number::scalar::{Discord, Mask, Real};
use crate::step::explicit::components::Components;

/// How far the closing of a component is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Progress<S: Real> {
    /// Changes so far that were followed by another look at the energy.
    pub(super) turns: usize,
    /// Whether heat has been among them.
    pub(super) has_heated: bool,
    /// What is missing of the energy, J.
    pub(super) defect: S,
    /// The magnitude of the terms of the energy where the closing began; zero before, J.
    pub(super) scale: S,
    /// The first defect over the scale.
    pub(super) correction: S,
    /// Heat that dashpots without temperature have lost in this step, J.
    pub(super) lost: S,
    /// Of several numbers, those whose energy is what it has to be: they wait for the others.
    pub(super) is_closed: S::Mask,
    /// The component has turned like a rigid body, since it was closed in no other way.
    pub(super) is_rigid: bool,
}

/// Working memory of the closing of a step.
#[derive(Clone, Debug)]
pub(super) struct Scratch<S: Real> {
    /// Per component.
    pub(super) progress: Vec<Progress<S>>,
    pub(super) energies: Vec<ComponentEnergy<S>>,
    /// Whether it has to be evaluated; whether its forces are asked for.
    pub(super) open: Vec<bool>,
    pub(super) asked: Vec<bool>,
    /// c per thermal slot, and what it has produced itself in this step, J/K.
    pub(super) capacities: Vec<S>,
    pub(super) produced: Vec<S>,
    /// Entropy that an element with a thermostat has received otherwise, J/K.
    pub(super) received: Vec<S>,
    /// The forces of the elements, `γ̇` and `g γ̇`, where they are asked for, N, m/s and W.
    pub(super) forces: Vec<S>,
    pub(super) creep: Vec<S>,
    pub(super) powers: Vec<S>,
    /// Π of the paths of heat, J/K.
    pub(super) paths: Vec<S>,
    /// All production of the step and the smallest of them; the largest number without any, J/K.
    pub(super) production: S,
    pub(super) least: S,
}

impl<S: Real> Progress<S> {
    pub(super) fn none() -> Self {
        Self {
            turns: 0,
            has_heated: false,
            defect: S::zero(),
            scale: S::zero(),
            correction: S::zero(),
            lost: S::zero(),
            is_closed: S::Mask::none(),
            is_rigid: false,
        }
    }
}

impl<S: Real> Progress<S> {
    /// The one decision of all numbers that are not closed.
    #[inline]
    pub(super) fn decide(&self, mask: S::Mask) -> Result<bool, Discord> {
        if (mask | self.is_closed).all() {
            return Ok(true);
        }
        if (mask & !self.is_closed).any() {
            return Err(Discord);
        }
        Ok(false)
    }

    /// An error unless nothing is closed: what follows changes all numbers.
    #[inline]
    pub(super) fn change_all(&self) -> Result<(), Discord> {
        if self.is_closed.any() {
            return Err(Discord);
        }
        Ok(())
    }
}

impl<S: Real> Scratch<S> {
    pub(super) fn new(components: &Components<S>, layout: &Layout, coordinates: usize) -> Self {
        let (count, thermal) = (components.all.len(), layout.thermal);
        Self {
            progress: vec![Progress::none(); count],
            energies: vec![ComponentEnergy::none(); count],
            open: vec![false; count],
            asked: vec![false; count],
            capacities: vec![S::zero(); thermal],
            produced: vec![S::zero(); thermal],
            received: vec![S::zero(); thermal],
            forces: vec![S::zero(); coordinates],
            creep: vec![S::zero(); layout.viscous],
            powers: vec![S::zero(); layout.viscous],
            paths: vec![S::zero(); components.paths.len()],
            production: S::zero(),
            least: S::MAX,
        }
    }
}

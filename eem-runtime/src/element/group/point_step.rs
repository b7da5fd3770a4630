//! A completed step, for its adjoint and its tangents: its states, derivatives with respect to them or of them, and the
//! weights of its equations.

use super::terms::Terms;
use super::view::StepView;
use crate::element::handle::Element;
use crate::element::layout::Layout;
use crate::element::state::State;
use eem_material::number::scalar::{Mask, Real};

/// A number per variable of a state: derivatives with respect to the state, or of the state with respect to an input.
#[derive(Clone, Debug)]
pub(crate) struct PerVariable<S> {
    /// Positions and velocities of all nodes, anchors too; anchors have velocities only where masses couple them.
    pub(crate) positions: Vec<S>,
    pub(crate) velocities: Vec<S>,
    pub(crate) viscous: Vec<S>,
    pub(crate) temperatures: Vec<S>,
    /// The entropies that reservoirs have received.
    pub(crate) reservoirs: Vec<S>,
}

impl<S: Real> PerVariable<S> {
    /// Zeros, for a scene with this number of coordinates.
    pub(crate) fn zero(coordinates: usize, layout: &Layout, reservoirs: usize) -> Self {
        let zeros = |count| vec![S::zero(); count];
        Self {
            positions: zeros(coordinates),
            velocities: zeros(coordinates),
            viscous: zeros(layout.viscous),
            temperatures: zeros(layout.thermal),
            reservoirs: zeros(reservoirs),
        }
    }

    /// All its numbers.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = S> + '_ {
        self.parts().into_iter().flatten().copied()
    }

    fn parts(&self) -> [&[S]; 5] {
        [
            &self.positions,
            &self.velocities,
            &self.viscous,
            &self.temperatures,
            &self.reservoirs,
        ]
    }

    /// Whether all its numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        // Zero for finite numbers, NaN for others.
        let zero = S::zero();
        self.parts().into_iter().all(|part| {
            let sum = part.iter().fold(zero, |sum, &number| sum + zero * number);
            sum.equal(zero).all()
        })
    }
}

/// A completed step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PastStep<'a, S> {
    /// Its size, its old state, and the data common to all steps.
    pub(crate) view: StepView<'a, S>,
    pub(crate) new: &'a State<S>,
    /// Whether thermostats prescribe the temperatures, by thermal slot.
    pub(crate) held: &'a [bool],
}

/// A step with the derivatives of a number with respect to its new state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepBack<'a, S> {
    pub(crate) past: PastStep<'a, S>,
    pub(crate) by_new: &'a PerVariable<S>,
}

/// A direction in which inputs change, in a step.
#[derive(Clone, Debug)]
pub(crate) struct Direction<S> {
    /// The changes of the old state and of the new one; in the latter those of anchors and prescribed temperatures are given.
    pub(crate) old: PerVariable<S>,
    pub(crate) new: PerVariable<S>,
    /// The changes of θ*, by thermal slot.
    pub(crate) middle: Vec<S>,
    /// The changes of the parameters of each element; empty for most elements.
    pub(crate) parameters: Vec<Vec<S>>,
    /// `[a, b]` for a change `a − b θ*` of the heat that a thermal slot receives, W, at constant temperatures of elements.
    pub(crate) heat: Vec<[S; 2]>,
    /// The rows of the right-hand side, then of the solution.
    pub(crate) right: Vec<[S; 1]>,
}

/// The weights w of the equations of a step.
#[derive(Clone, Debug)]
pub(crate) struct StepWeights<S> {
    /// Those of the momentum balances of all nodes, zero at anchors.
    pub(crate) motion: Vec<S>,
    /// Those of the entropy balances, those of prescribed temperatures, and θ*, by thermal slot.
    pub(crate) entropies: Vec<S>,
    pub(crate) held: Vec<S>,
    pub(crate) temperatures: Vec<S>,
    /// The derivatives with respect to the positions of anchors in the old state and in the new one, zero at masses.
    pub(crate) anchors: [Vec<S>; 2],
    /// The terms of `−(∂R/∂h)ᵀ w` of the points.
    pub(crate) by_size: Terms<S>,
}

/// A function that receives the derivatives with respect to the parameters of each element.
pub(crate) type SeeParameters<'a, S> = dyn FnMut(Element, &[S]) + 'a;

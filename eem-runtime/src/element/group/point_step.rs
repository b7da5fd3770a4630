//! A completed step, for its adjoint and its tangents: its states, derivatives with respect to them or of them, and the
//! weights of its equations.

use super::eliminate::CondensedRow;
use super::site::HeatPath;
use super::terms::Terms;
use super::view::StepView;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::handle::Element;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::layout::Layout;
use crate::element::state::State;

/// A number per variable of a state: derivatives with respect to the state, or of the state with respect to an input.
#[derive(Clone, Debug)]
pub(crate) struct PerVariable {
    /// Positions and velocities of all nodes, anchors too; anchors have velocities only where masses couple them.
    pub(crate) positions: Vec<f64>,
    pub(crate) velocities: Vec<f64>,
    pub(crate) viscous: Vec<f64>,
    pub(crate) temperatures: Vec<f64>,
    /// The entropies that reservoirs have received.
    pub(crate) reservoirs: Vec<f64>,
}

impl PerVariable {
    /// Zeros, for a scene with this number of coordinates.
    pub(crate) fn zero(coordinates: usize, layout: &Layout, reservoirs: usize) -> Self {
        let zeros = |count| vec![0.0; count];
        Self {
            positions: zeros(coordinates),
            velocities: zeros(coordinates),
            viscous: zeros(layout.viscous),
            temperatures: zeros(layout.thermal),
            reservoirs: zeros(reservoirs),
        }
    }

    /// All its numbers.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        self.parts().into_iter().flatten().copied()
    }

    fn parts(&self) -> [&[f64]; 5] {
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
        self.parts().into_iter().all(|part| {
            let sum = part.iter().fold(0.0, |sum, &number| sum + 0.0 * number);
            sum == 0.0
        })
    }
}

/// A completed step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PastStep<'a> {
    /// Its size, its old state, and the data common to all steps.
    pub(crate) view: StepView<'a>,
    pub(crate) new: &'a State,
    /// Whether thermostats prescribe the temperatures, by thermal slot.
    pub(crate) held: &'a [bool],
}

/// A step with the derivatives of a number with respect to its new state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepBack<'a> {
    pub(crate) past: PastStep<'a>,
    pub(crate) by_new: &'a PerVariable,
}

/// A direction in which inputs change, in a step.
#[derive(Clone, Debug)]
pub(crate) struct Direction {
    /// The changes of the old state and of the new one; in the latter those of anchors and prescribed temperatures are given.
    pub(crate) old: PerVariable,
    pub(crate) new: PerVariable,
    /// The changes of θ*, by thermal slot.
    pub(crate) middle: Vec<f64>,
    /// The changes of the parameters of each element; empty for most elements.
    pub(crate) parameters: Vec<Vec<f64>>,
    /// `[a, b]` for a change `a − b θ*` of the heat that a thermal slot receives, W, at constant temperatures of elements.
    pub(crate) heat: Vec<[f64; 2]>,
    /// The rows of the right-hand side, then of the solution.
    pub(crate) right: Vec<[f64; 1]>,
}

/// The weights w of the equations of a step.
#[derive(Clone, Debug)]
pub(crate) struct StepWeights {
    /// Those of the momentum balances of all nodes, zero at anchors.
    pub(crate) motion: Vec<f64>,
    /// Those of the entropy balances, those of prescribed temperatures, and θ*, by thermal slot.
    pub(crate) entropies: Vec<f64>,
    pub(crate) held: Vec<f64>,
    pub(crate) temperatures: Vec<f64>,
    /// The derivatives with respect to the positions of anchors in the old state and in the new one, zero at masses.
    pub(crate) anchors: [Vec<f64>; 2],
    /// The terms of `−(∂R/∂h)ᵀ w` of the points.
    pub(crate) by_size: Terms,
}

/// A function that receives the derivatives with respect to the parameters of each element.
pub(crate) type SeeParameters<'a> = dyn FnMut(Element, &[f64]) + 'a;

/// The transposed equations of a point after the elimination of its own weights:
/// `Σ_a h (D*π_a·w_v) moduli_a + w_Θ by_heat + constant`, by measure.
pub(crate) struct Reduced<Q: MeasureSet> {
    pub(in crate::element::group) moduli: Q::Per<Numbers<Q>>,
    pub(in crate::element::group) by_heat: Numbers<Q>,
    pub(in crate::element::group) constant: Numbers<Q>,
    /// Its forces.
    pub(in crate::element::group) forces: Numbers<Q>,
    /// The weight of its balance of heat as a function of those numbers, without the sign, and `∂r_s/∂Q`.
    pub(in crate::element::group) own_weight: CondensedRow<Numbers<Q>>,
    pub(in crate::element::group) heat_factor: f64,
}

/// The inputs of the weights of a point besides its own values.
pub(crate) struct Surroundings<'a> {
    pub(in crate::element::group) step: &'a StepBack<'a>,
    pub(in crate::element::group) interface: &'a InterfaceTemperatures,
    pub(in crate::element::group) paths: Option<&'a [HeatPath]>,
    /// `w_Θ`.
    pub(in crate::element::group) theta: f64,
}

/// The forces of a point, and the derivatives of `wᵀR` with respect to its old and its new measures.
pub(crate) struct Weighed<Q: MeasureSet> {
    pub(in crate::element::group) forces: Numbers<Q>,
    pub(in crate::element::group) by_old: Numbers<Q>,
    pub(in crate::element::group) by_new: Numbers<Q>,
}

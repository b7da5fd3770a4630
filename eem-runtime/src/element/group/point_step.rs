//! A point between two states, as the adjoint of a step sees it, and its weights in the derivatives by parameters.

use crate::element::handle::Element;
use crate::element::layout::Slots;

/// A point in a step: its response and the derivatives by both states. Arms are edge vectors from its first node.
#[derive(Debug)]
pub(crate) struct PointStep<S, const D: usize> {
    pub(crate) nodes: Vec<u32>,
    pub(crate) slots: Slots,
    /// θ*, K; zero without temperature.
    pub(crate) temperature: S,
    /// The derivatives of `(f*, g*, θ*, Δs)` by the variables of the old state and of the new one.
    pub(crate) slopes: [Vec<Vec<S>>; 2],
    /// The derivatives of the measures by the arms in both states.
    pub(crate) gradients: [Vec<Vec<[S; D]>>; 2],
    /// The mean-value gradients of the measures, along which the forces act.
    pub(crate) direction: Vec<Vec<[S; D]>>,
    /// The derivatives of the forces on the arms by the arms of both states at constant `f* + f_d`, rows by arm and axis.
    pub(crate) curvature: [Vec<Vec<S>>; 2],
    /// Increments of measures and viscous stretches.
    pub(crate) extension: Vec<S>,
    pub(crate) creep: Vec<S>,
    /// η at θ*, and dη/dθ, of the dashpots in series and in parallel.
    pub(crate) viscosities: [Vec<S>; 2],
    pub(crate) drag: [Vec<S>; 2],
}

impl<S, const D: usize> PointStep<S, D> {
    /// Number of dashpots in series.
    pub(crate) const fn dashpots(&self) -> usize {
        self.creep.len()
    }
}

/// The weights of a point in the derivatives by parameters: of its response, of the viscosities in series and in parallel, with
/// θ*, K, at which these are.
#[derive(Clone, Debug)]
pub(crate) struct PointWeights<S> {
    pub(crate) temperature: S,
    pub(crate) response: Vec<S>,
    pub(crate) viscosities: Vec<S>,
    pub(crate) drag: Vec<S>,
}

/// What receives the derivatives by the parameters of each element.
pub(crate) type SeeParameters<'a, S> = dyn FnMut(Element, &[S]) + 'a;

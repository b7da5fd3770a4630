//! How the positions of an element's nodes measure its deformation.
//!
//! A measure `π(q)` is a function of a measure that is at most quadratic in
//! the positions: the stretch is the root of `λ² = r·r`, a Green–Lagrange strain is
//! quadratic itself. For such measures the mean-value gradient
//!
//! ```text
//! D*π = ∂π(q⁰, q¹):   D*π (q¹ − q⁰) = π¹ − π⁰   exactly
//! ```
//!
//! is linear in the mean position `q_m`, so that a force `Σ f_a D*π_a = A q_m`
//! with a symmetric matrix A that only depends on `f`, `π⁰` and `π¹`. Nothing
//! outside this module knows how many nodes or measures an element has.

mod stretch;

use crate::scalar::Real;

pub use stretch::Stretch;

/// The positions and measures of one element at both ends of a step.
///
/// Positions are the coordinates of all nodes of the element, one node after
/// the other, in m.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a, S> {
    /// Old positions `q⁰`.
    pub q0: &'a [S],
    /// New positions `q¹`.
    pub q1: &'a [S],
    /// Old measures `π⁰`.
    pub measures0: &'a [S],
    /// New measures `π¹`.
    pub measures1: &'a [S],
}

/// The measures of one element as functions of its nodal coordinates.
///
/// Matrices are row-major slices: a gradient has a row per measure and a column
/// per coordinate, a curvature a row and a column per coordinate.
pub trait Kinematics<S: Real>: Copy + Send + Sync + 'static {
    /// Number of nodes.
    const NODES: usize;
    /// Number of measures, M.
    const MEASURES: usize;

    /// Whether an element can have this measure; a stretch must be positive and finite.
    fn is_admissible(&self, measure: S) -> bool;

    /// The measures `π(q)`.
    fn measure(&self, q: &[S], measures: &mut [S]);

    /// `∂π/∂q` at `q`, whose measures are given.
    fn gradient(&self, q: &[S], measures: &[S], gradient: &mut [S]);

    /// Adds `Σ_a f_a ∂²π_a/∂q²`.
    fn add_curvature(&self, q: &[S], measures: &[S], force: &[S], matrix: &mut [S]);

    /// The mean-value gradient `D*π` between two states.
    fn discrete_gradient(&self, ends: Ends<'_, S>, gradient: &mut [S]);

    /// Adds `Σ_a f_a ∂(D*π_a)/∂q¹`.
    fn add_discrete_curvature(&self, ends: Ends<'_, S>, force: &[S], matrix: &mut [S]);

    /// Adds A of `Σ_a f_a D*π_a = A q_m`, with the measures held.
    fn add_secant(&self, measures0: &[S], measures1: &[S], force: &[S], matrix: &mut [S]);
}

//! The differences of a function between two points.

/// All divided differences of a function between two ends, the bits of the single kernels.
///
/// They have most of their work in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences<S> {
    /// `f[a,b]`.
    pub first: S,
    /// `f[b,a,a] = ∂f[a,b]/∂a`.
    pub second_a: S,
    /// `f[a,b,b] = ∂f[a,b]/∂b`.
    pub second_b: S,
}

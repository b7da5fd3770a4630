//! What a shape is, and the two families of shape functions.

use core::fmt::Debug;

use crate::element::kinematics::measures::Points;
use crate::element::kinematics::tensor::Symmetric;
use eem_material::free_energy::{Array, Entry};
use eem_material::number::scalar::Real;

/// The shape of a cell in `D` dimensions: [`Quad4`](super::Quad4), [`Quad8`](super::Quad8),
/// [`Hex8`](super::Hex8) or [`Hex20`](super::Hex20).
///
/// Nodes are in the order of VTK: corners, then mid-side nodes. The integration points are Gauss points; the first
/// coordinate varies fastest.
///
/// ```
/// use eem::kinematics::{Hex20, Shape};
///
/// // In the middle of the cell, the corners count −1/4 and the middles of edges 1/4.
/// let [first, last] = [0, 19].map(|node| Hex20::function(node, [0.0, 0.0, 0.0]).0);
/// assert_eq!([first, last], [-0.25, 0.25]);
/// ```
pub trait Shape<const D: usize>: Copy + Debug + Send + Sync + 'static {
    /// `[T; number of nodes]`.
    type PerNode<T: Entry>: Array<T>;
    /// `[T; number of nodes − 1]`.
    type PerArm<T: Entry>: Array<T>;
    /// `[T; number of points]`.
    type PerPoint<T: Send + Sync>: Points<T>;
    /// A symmetric tensor.
    type Tensor<S: Real>: Symmetric<S, D>;
    /// `[T; number of components of a symmetric tensor]`.
    type PerComponent<T: Entry>: Array<T>;

    /// Its name.
    const NAME: &'static str;
    /// The nodes of the parent cell [−1, 1]ᴰ.
    const NODES: &'static [[i8; D]];
    /// The nodes of each face, corners first, against the clock seen from outside.
    const FACES: &'static [&'static [usize]];
    /// Gauss points per axis.
    const PER_AXIS: usize;

    /// `N_a` and `∂N_a/∂ξ` of a node at a place of the parent cell.
    fn function<S: Real>(node: usize, place: [S; D]) -> (S, [S; D]);
}

/// `Π ½(1 + ξ_k ξ)` with its derivatives.
pub(super) fn multilinear<S: Real, const D: usize>(node: &[i8; D], place: [S; D]) -> (S, [S; D]) {
    let half = S::from_f64(0.5);
    let sides = node.map(|side| S::from_f64(f64::from(side)));
    let mut factors = [S::zero(); D];
    for axis in 0..D {
        factors[axis] = half * (S::one() + sides[axis] * place[axis]);
    }
    product(&factors, &sides.map(|side| half * side))
}

/// Corners `Π ½(1 + ξ_k ξ) (Σ ξ_k ξ − (D − 1))`, middles of edges `(1 − ξ²) Π ½(1 + ξ_k ξ)`, with
/// their derivatives.
pub(super) fn serendipity<S: Real, const D: usize>(node: &[i8; D], place: [S; D]) -> (S, [S; D]) {
    let half = S::from_f64(0.5);
    if let Some(along) = node.iter().position(|&side| side == 0) {
        let mut factors = [S::zero(); D];
        let mut slopes = [S::zero(); D];
        for axis in 0..D {
            let (at, side) = (place[axis], S::from_f64(f64::from(node[axis])));
            if axis == along {
                factors[axis] = (S::one() - at) * (S::one() + at);
                slopes[axis] = -(at + at);
            } else {
                factors[axis] = half * (S::one() + side * at);
                slopes[axis] = half * side;
            }
        }
        return product(&factors, &slopes);
    }
    let (value, slopes) = multilinear(node, place);
    let sides = node.map(|side| S::from_f64(f64::from(side)));
    let mut sum = S::one();
    for axis in 0..D {
        sum += sides[axis] * place[axis] - S::one();
    }
    let mut total = [S::zero(); D];
    for axis in 0..D {
        total[axis] = slopes[axis] * sum + value * sides[axis];
    }
    (value * sum, total)
}

/// A product of functions, one per axis, with its derivatives.
fn product<S: Real, const D: usize>(factors: &[S; D], slopes: &[S; D]) -> (S, [S; D]) {
    let of = |changed: usize| {
        let factor = |axis: usize| {
            if axis == changed {
                slopes[axis]
            } else {
                factors[axis]
            }
        };
        (1..D).fold(factor(0), |product, axis| product * factor(axis))
    };
    (of(D), core::array::from_fn(of))
}

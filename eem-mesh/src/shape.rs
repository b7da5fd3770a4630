//! The shapes of the cells of solids: nodes, faces, shape functions and rule of integration.

use core::{array, fmt::Debug};

use crate::tensor::Symmetric;
use eem_material::free_energy::{Array, Entry};

/// The shape of a cell in `D` dimensions: [`Quad4`], [`Quad8`], [`Hex8`] or [`Hex20`].
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
    type Tensor: Symmetric<D>;
    /// `[T; number of components of a symmetric tensor]`.
    type PerComponent<T: Entry>: Array<T>;

    /// Its name.
    const NAME: &'static str;
    /// The nodes of the parent cell [−1, 1]ᴰ.
    const NODES: &'static [[i8; D]];
    /// The nodes of each face, corners first, counterclockwise seen from outside.
    const FACES: &'static [&'static [usize]];
    /// Gauss points per axis.
    const PER_AXIS: usize;

    /// `N_a` and `∂N_a/∂ξ` of a node at a position in the parent cell.
    #[inline]
    #[must_use]
    fn function(node: usize, place: [f64; D]) -> (f64, [f64; D]) {
        // A cell has mid-side nodes if it has more nodes than corners.
        if Self::NODES.len() > 1 << D {
            serendipity(&Self::NODES[node], place)
        } else {
            multilinear(&Self::NODES[node], place)
        }
    }
}

/// A quadrilateral of four nodes in plane strain, with four points.
#[derive(Clone, Copy, Debug)]
pub enum Quad4 {}

/// A quadrilateral of eight nodes in plane strain, whose edges may bend, with nine points.
#[derive(Clone, Copy, Debug)]
pub enum Quad8 {}

/// A hexahedron of eight nodes, with eight points.
#[derive(Clone, Copy, Debug)]
pub enum Hex8 {}

/// A hexahedron of twenty nodes, whose edges may bend, with 27 points.
#[derive(Clone, Copy, Debug)]
pub enum Hex20 {}

impl Shape<2> for Quad4 {
    type PerNode<T: Entry> = [T; 4];
    type PerArm<T: Entry> = [T; 3];
    type PerPoint<T: Send + Sync> = [T; 4];
    type Tensor = [f64; 3];
    type PerComponent<T: Entry> = [T; 3];

    const NAME: &'static str = "Quad4";
    const NODES: &'static [[i8; 2]] = Quad8::NODES.split_at(4).0;
    const FACES: &'static [&'static [usize]] = &[&[3, 0], &[1, 2], &[0, 1], &[2, 3]];
    const PER_AXIS: usize = 2;
}

impl Shape<2> for Quad8 {
    type PerNode<T: Entry> = [T; 8];
    type PerArm<T: Entry> = [T; 7];
    type PerPoint<T: Send + Sync> = [T; 9];
    type Tensor = [f64; 3];
    type PerComponent<T: Entry> = [T; 3];

    const NAME: &'static str = "Quad8";
    const NODES: &'static [[i8; 2]] = &[
        [-1, -1],
        [1, -1],
        [1, 1],
        [-1, 1],
        [0, -1],
        [1, 0],
        [0, 1],
        [-1, 0],
    ];
    const FACES: &'static [&'static [usize]] = &[&[3, 0, 7], &[1, 2, 5], &[0, 1, 4], &[2, 3, 6]];
    const PER_AXIS: usize = 3;
}

impl Shape<3> for Hex8 {
    type PerNode<T: Entry> = [T; 8];
    type PerArm<T: Entry> = [T; 7];
    type PerPoint<T: Send + Sync> = [T; 8];
    type Tensor = [f64; 6];
    type PerComponent<T: Entry> = [T; 6];

    const NAME: &'static str = "Hex8";
    const NODES: &'static [[i8; 3]] = Hex20::NODES.split_at(8).0;
    const FACES: &'static [&'static [usize]] = &[
        &[0, 4, 7, 3],
        &[1, 2, 6, 5],
        &[0, 1, 5, 4],
        &[3, 7, 6, 2],
        &[0, 3, 2, 1],
        &[4, 5, 6, 7],
    ];
    const PER_AXIS: usize = 2;
}

impl Shape<3> for Hex20 {
    type PerNode<T: Entry> = [T; 20];
    type PerArm<T: Entry> = [T; 19];
    type PerPoint<T: Send + Sync> = [T; 27];
    type Tensor = [f64; 6];
    type PerComponent<T: Entry> = [T; 6];

    const NAME: &'static str = "Hex20";
    const NODES: &'static [[i8; 3]] = &[
        [-1, -1, -1],
        [1, -1, -1],
        [1, 1, -1],
        [-1, 1, -1],
        [-1, -1, 1],
        [1, -1, 1],
        [1, 1, 1],
        [-1, 1, 1],
        [0, -1, -1],
        [1, 0, -1],
        [0, 1, -1],
        [-1, 0, -1],
        [0, -1, 1],
        [1, 0, 1],
        [0, 1, 1],
        [-1, 0, 1],
        [-1, -1, 0],
        [1, -1, 0],
        [1, 1, 0],
        [-1, 1, 0],
    ];
    const FACES: &'static [&'static [usize]] = &[
        &[0, 4, 7, 3, 16, 15, 19, 11],
        &[1, 2, 6, 5, 9, 18, 13, 17],
        &[0, 1, 5, 4, 8, 17, 12, 16],
        &[3, 7, 6, 2, 19, 14, 18, 10],
        &[0, 3, 2, 1, 11, 10, 9, 8],
        &[4, 5, 6, 7, 12, 13, 14, 15],
    ];
    const PER_AXIS: usize = 3;
}

/// An array with an entry per point of an element. Implemented for arrays.
pub trait Points<T>: AsRef<[T]> + AsMut<[T]> + IntoIterator<Item = T> + Send + Sync {
    /// Number of points.
    const LEN: usize;

    /// Creates the entries point by point.
    fn from_fn(make: impl FnMut(usize) -> T) -> Self;
}

impl<T: Send + Sync, const N: usize> Points<T> for [T; N] {
    const LEN: usize = N;

    #[inline]
    fn from_fn(make: impl FnMut(usize) -> T) -> Self {
        array::from_fn(make)
    }
}

/// `Π ½(1 + ξ_k ξ)` with its derivatives.
fn multilinear<const D: usize>(node: &[i8; D], place: [f64; D]) -> (f64, [f64; D]) {
    let sides = node.map(f64::from);
    let factors = array::from_fn(|axis| 0.5 * (1.0 + sides[axis] * place[axis]));
    product(&factors, &sides.map(|side| 0.5 * side))
}

/// Corners `Π ½(1 + ξ_k ξ) (Σ ξ_k ξ − (D − 1))`, middles of edges `(1 − ξ²) Π ½(1 + ξ_k ξ)`, with
/// their derivatives.
fn serendipity<const D: usize>(node: &[i8; D], place: [f64; D]) -> (f64, [f64; D]) {
    let sides = node.map(f64::from);
    if let Some(along) = node.iter().position(|&side| side == 0) {
        let (mut factors, mut slopes) = ([0.0; D], [0.0; D]);
        for axis in 0..D {
            let at = place[axis];
            (factors[axis], slopes[axis]) = if axis == along {
                ((1.0 - at) * (1.0 + at), -(at + at))
            } else {
                (0.5 * (1.0 + sides[axis] * at), 0.5 * sides[axis])
            };
        }
        return product(&factors, &slopes);
    }
    let (value, slopes) = multilinear(node, place);
    let mut sum = 1.0;
    for axis in 0..D {
        sum += sides[axis] * place[axis] - 1.0;
    }
    let total = array::from_fn(|axis| slopes[axis] * sum + value * sides[axis]);
    (value * sum, total)
}

/// A product of functions, one per axis, with its derivatives.
fn product<const D: usize>(factors: &[f64; D], slopes: &[f64; D]) -> (f64, [f64; D]) {
    let of = |changed: usize| {
        let factor = |axis: usize| [factors, slopes][usize::from(axis == changed)][axis];
        (1..D).fold(factor(0), |product, axis| product * factor(axis))
    };
    (of(D), array::from_fn(of))
}

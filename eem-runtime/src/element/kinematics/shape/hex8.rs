//! A hexahedron of eight nodes, with eight points.

use crate::element::kinematics::shape::interpolation::{Shape, multilinear};
use eem_material::free_energy::Entry;
use eem_material::number::scalar::Real;

/// A hexahedron of eight nodes, with eight points.
#[derive(Clone, Copy, Debug)]
pub enum Hex8 {}

impl Shape<3> for Hex8 {
    type PerNode<T: Entry> = [T; 8];
    type PerArm<T: Entry> = [T; 7];
    type PerPoint<T: Send + Sync> = [T; 8];
    type Tensor<S: Real> = [S; 6];
    type PerComponent<T: Entry> = [T; 6];

    const NAME: &'static str = "Hex8";
    const NODES: &'static [[i8; 3]] = &[
        [-1, -1, -1],
        [1, -1, -1],
        [1, 1, -1],
        [-1, 1, -1],
        [-1, -1, 1],
        [1, -1, 1],
        [1, 1, 1],
        [-1, 1, 1],
    ];
    const FACES: &'static [&'static [usize]] = &[
        &[0, 4, 7, 3],
        &[1, 2, 6, 5],
        &[0, 1, 5, 4],
        &[3, 7, 6, 2],
        &[0, 3, 2, 1],
        &[4, 5, 6, 7],
    ];
    const PER_AXIS: usize = 2;

    #[inline]
    fn function<S: Real>(node: usize, place: [S; 3]) -> (S, [S; 3]) {
        multilinear(&Self::NODES[node], place)
    }
}

//! A hexahedron of twenty nodes, whose edges may bend, with 27 points.

use crate::element::kinematics::shape::interpolation::{Shape, serendipity};
use eem_material::free_energy::Entry;
use eem_material::number::scalar::Real;

/// A hexahedron of twenty nodes, whose edges may bend, with 27 points.
#[derive(Clone, Copy, Debug)]
pub enum Hex20 {}

impl Shape<3> for Hex20 {
    type PerNode<T: Entry> = [T; 20];
    type PerArm<T: Entry> = [T; 19];
    type PerPoint<T: Send + Sync> = [T; 27];
    type Tensor<S: Real> = [S; 6];
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

    #[inline]
    fn function<S: Real>(node: usize, place: [S; 3]) -> (S, [S; 3]) {
        serendipity(&Self::NODES[node], place)
    }
}

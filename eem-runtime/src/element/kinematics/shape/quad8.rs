//! A quadrilateral of eight nodes in plane strain, whose edges may bend, with nine points.

use crate::element::kinematics::shape::interpolation::{Shape, serendipity};
use eem_material::free_energy::Entry;
use eem_material::number::scalar::Real;

/// A quadrilateral of eight nodes in plane strain, whose edges may bend, with nine points.
#[derive(Clone, Copy, Debug)]
pub enum Quad8 {}

impl Shape<2> for Quad8 {
    type PerNode<T: Entry> = [T; 8];
    type PerArm<T: Entry> = [T; 7];
    type PerPoint<T: Send + Sync> = [T; 9];
    type Tensor<S: Real> = [S; 3];
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

    #[inline]
    fn function<S: Real>(node: usize, place: [S; 2]) -> (S, [S; 2]) {
        serendipity(&Self::NODES[node], place)
    }
}

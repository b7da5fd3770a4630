//! A quadrilateral of four nodes in plane strain, with four points.

use crate::element::kinematics::shape::interpolation::{Shape, multilinear};
use eem_material::free_energy::Entry;
use eem_material::number::scalar::Real;

/// A quadrilateral of four nodes in plane strain, with four points.
#[derive(Clone, Copy, Debug)]
pub enum Quad4 {}

impl Shape<2> for Quad4 {
    type PerNode<T: Entry> = [T; 4];
    type PerArm<T: Entry> = [T; 3];
    type PerPoint<T: Send + Sync> = [T; 4];
    type Tensor<S: Real> = [S; 3];
    type PerComponent<T: Entry> = [T; 3];

    const NAME: &'static str = "Quad4";
    const NODES: &'static [[i8; 2]] = &[[-1, -1], [1, -1], [1, 1], [-1, 1]];
    const FACES: &'static [&'static [usize]] = &[&[3, 0], &[1, 2], &[0, 1], &[2, 3]];
    const PER_AXIS: usize = 2;

    #[inline]
    fn function<S: Real>(node: usize, place: [S; 2]) -> (S, [S; 2]) {
        multilinear(&Self::NODES[node], place)
    }
}

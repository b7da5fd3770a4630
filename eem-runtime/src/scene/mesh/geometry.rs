//! Places, distances and areas.

use crate::element::kinematics::{Shape, Symmetric};
use crate::number::scalar::Scalar;

/// Of an edge in the plane, of a quadrilateral in space (half the product of its diagonals).
pub(super) fn area_vector<H: Shape<D>, const D: usize>(corners: &[[f64; D]]) -> [f64; D] {
    let difference =
        |a: [f64; D], b: [f64; D]| -> [f64; D] { core::array::from_fn(|axis| b[axis] - a[axis]) };
    let mut rows = [[0.0; D]; D];
    let mut share = 1.0;
    match *corners {
        [a, b, c, d] => {
            (rows[0], rows[1]) = (difference(a, d), difference(b, c));
            share = 0.5;
        }
        [a, b] => rows[0] = difference(a, b),
        _ => {}
    }
    let cofactor = H::Tensor::<f64>::cofactor(&rows);
    cofactor[D - 1].map(|component| share * component)
}

/// The mean of some places, m.
pub(super) fn mean<const D: usize>(places: &[[f64; D]]) -> [f64; D] {
    let (mut sum, mut count) = ([0.0; D], 0.0);
    for place in places {
        sum = core::array::from_fn(|axis| sum[axis] + place[axis]);
        count += 1.0;
    }
    sum.map(|sum| sum / count)
}

/// Of two places, m.
pub(crate) fn distance<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (0..D).fold(0.0, |distance: f64, axis| {
        Scalar::hypot(distance, a[axis] - b[axis])
    })
}

//! Distances, means and areas.

use crate::shape::Shape;
use crate::tensor::Symmetric;
use eem_material::free_energy::{Array, Entry};
use eem_material::number::scalar::Scalar;

/// The area vector (normal, of the length of the area) of an edge in the plane, or of a quadrilateral in space (half the
/// cross product of its diagonals).
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
    let cofactor = H::Tensor::cofactor(&rows);
    cofactor[D - 1].map(|component| share * component)
}

/// An entry per node of a cell.
pub fn per_node<H: Shape<D>, T: Entry, const D: usize>(
    mut entry: impl FnMut(usize) -> T,
) -> H::PerNode<T> {
    let mut all = H::PerNode::filled(entry(0));
    for at in 1..H::NODES.len() {
        all[at] = entry(at);
    }
    all
}

/// The mean of positions, m.
pub(super) fn mean<const D: usize>(places: impl IntoIterator<Item = [f64; D]>) -> [f64; D] {
    let (mut sum, mut count) = ([0.0; D], 0.0);
    for place in places {
        sum = core::array::from_fn(|axis| sum[axis] + place[axis]);
        count += 1.0;
    }
    sum.map(|sum| sum / count)
}

/// The distance of two positions, m.
#[must_use]
pub fn distance<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    (0..D).fold(0.0, |distance: f64, axis| {
        Scalar::hypot(distance, a[axis] - b[axis])
    })
}

/// The power of two by which numbers are scaled, without rounding, to magnitudes of about one.
pub(super) fn power_of_two<'a>(numbers: impl Iterator<Item = &'a f64>) -> f64 {
    const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;
    let largest = numbers.fold(0.0, |largest: f64, number| largest.max(number.abs()));
    // The exponents e of 2^(e − 1023) and of its reciprocal add up to 2046; 0 and 2047 are not used.
    let exponent = largest.to_bits() >> MANTISSA;
    f64::from_bits(2046_u64.saturating_sub(exponent).clamp(1, 2045) << MANTISSA)
}

#[cfg(test)]
mod tests {
    use super::power_of_two;

    #[test]
    fn powers_of_two_bring_numbers_near_one() {
        let extreme = [f64::MAX, 1e-320, f64::MIN_POSITIVE];
        for largest in [1.0, 0.3, 7.0, 1e200, 1e-170].into_iter().chain(extreme) {
            let power = power_of_two([0.5 * largest, -largest].iter());
            let scaled = largest * power;
            assert!((scaled * power.recip()).to_bits() == largest.to_bits() || largest > 1e300);
            assert!(
                (1.0..4.0).contains(&scaled) || largest < 1e-300,
                "{largest} {scaled}"
            );
        }
        assert!(power_of_two([0.0].iter()) > 0.0);
    }
}

//! Points of the unit cube: its corners, and a sequence that fills it evenly.

use crate::number::scalar::Scalar;

/// Corners are taken in the first variables only: there would be too many in all.
const CORNERED: usize = 10;
/// Iterations to the root φ of `φ^(d+1) = φ + 1`: each gains more than a bit.
const ITERATIONS: usize = 64;

/// All corners; in more than ten variables those of the first ten, the others in the middle.
pub(super) fn corners(dimension: usize) -> impl Iterator<Item = Vec<f64>> {
    let cornered = dimension.min(CORNERED);
    (0..1_usize << cornered).map(move |bits| {
        let coordinate = |axis: usize| match axis < cornered {
            true if bits >> axis & 1 == 1 => 1.0,
            true => 0.0,
            false => 0.5,
        };
        (0..dimension).map(coordinate).collect()
    })
}

/// The first points of the additive sequence with the generalised golden ratio (Roberts 2018, *The
/// unreasonable effectiveness of quasirandom sequences*):
///
/// ```text
/// u_i(n) = ½ + n φ^−(i+1)  mod 1,    φ^(d+1) = φ + 1
/// ```
pub(super) fn even(dimension: usize, count: usize) -> impl Iterator<Item = Vec<f64>> {
    #[expect(clippy::cast_precision_loss, reason = "a number of variables")]
    let power = 1.0 / (dimension as f64 + 1.0);
    let golden = (0..ITERATIONS).fold(2.0_f64, |ratio, _| Scalar::powf(1.0 + ratio, power));
    let mut unit = vec![0.5; dimension];
    (0..count).map(move |_| {
        let mut step = 1.0;
        for coordinate in &mut unit {
            step /= golden;
            *coordinate = (*coordinate + step).fract();
        }
        unit.clone()
    })
}

#[cfg(test)]
mod tests {
    use super::{corners, even};

    #[test]
    fn corners_are_all_different() {
        let mut corners: Vec<_> = corners(3).map(|corner| format!("{corner:?}")).collect();
        corners.sort_unstable();
        corners.dedup();
        assert_eq!(corners.len(), 8);
        assert_eq!(super::corners(12).count(), 1024);
    }

    #[test]
    fn the_sequence_fills_the_cube_evenly() {
        // 1000 points: every one of 64 cells has its 15.6 of them, give or take a few.
        let mut cells = [0_u32; 64];
        for unit in even(3, 1000) {
            let quarter = |u: f64| [0.25, 0.5, 0.75].iter().filter(|&&end| u >= end).count();
            let cell = unit.iter().fold(0, |cell, &u| 4 * cell + quarter(u));
            cells[cell] += 1;
        }
        assert!(
            cells.iter().all(|count| (10..=22).contains(count)),
            "{cells:?}"
        );
    }
}

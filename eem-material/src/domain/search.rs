//! The smallest heat capacity and viscosities of a domain, by a sample and a descent.

use super::error::DomainError;
use super::point::{DomainReport, Least, Space};
use crate::number::scalar::Scalar;

/// Number of the worst points from which the search descends.
const STARTS: usize = 4;
/// First and last step of the descent, in the unit cube.
const STEPS: [f64; 2] = [0.125, 1e-6];
/// Limit of the moves from one start, for quantities that fall in tiny steps.
const MOVES: usize = 500;

/// Corners are examined in this many variables only: in all there would be too many.
const CORNERED: usize = 10;
/// Iterations for the root φ of `φ^(d+1) = φ + 1`: each gains more than one bit.
const ITERATIONS: usize = 64;

/// Heat capacity and viscosities of a state, or why it is invalid.
type Examine<'e> = dyn Fn(&[f64]) -> Result<Vec<f64>, DomainError> + 'e;

/// An examined point of the unit cube and its quantities.
#[derive(Clone, Debug)]
struct Examined {
    unit: Vec<f64>,
    found: Vec<f64>,
}

/// Examines states, and counts them.
struct Examiner<'e> {
    space: &'e Space,
    examine: &'e Examine<'e>,
    evaluations: usize,
}

impl Examiner<'_> {
    fn examine_at(&mut self, unit: Vec<f64>) -> Result<Examined, DomainError> {
        self.evaluations += 1;
        let found = (self.examine)(&self.space.state(&unit))?;
        Ok(Examined { unit, found })
    }

    /// Goes to smaller values of one quantity along the axes, with steps that are halved where
    /// none of them finds a smaller value (compass search, Fermi & Metropolis 1952).
    fn descend(&mut self, start: &Examined, quantity: usize) -> Result<Examined, DomainError> {
        let [mut step, last] = STEPS;
        let (mut best, mut moves) = (start.clone(), 0);
        while step >= last && moves < MOVES {
            let before = best.found[quantity];
            for axis in 0..self.space.dimension() {
                for direction in [step, -step] {
                    let mut unit = best.unit.clone();
                    unit[axis] = (unit[axis] + direction).clamp(0.0, 1.0);
                    if (unit[axis] - best.unit[axis]).abs() > 0.0 {
                        let trial = self.examine_at(unit)?;
                        if trial.found[quantity] < best.found[quantity] {
                            best = trial;
                        }
                    }
                }
            }
            moves += 1;
            if best.found[quantity] >= before {
                step *= 0.5;
            }
        }
        Ok(best)
    }
}

/// Examines corners and sample, then descends in each quantity.
pub(super) fn search(
    space: &Space,
    samples: usize,
    examine: &Examine<'_>,
) -> Result<DomainReport, DomainError> {
    let mut examiner = Examiner {
        space,
        examine,
        evaluations: 0,
    };
    let dimension = space.dimension();
    let units = corners(dimension).chain(even(dimension, samples));
    let mut examined = Vec::new();
    for unit in units {
        examined.push(examiner.examine_at(unit)?);
    }
    let mut leasts = Vec::new();
    for quantity in 0..examined[0].found.len() {
        examined.sort_by(|a, b| a.found[quantity].total_cmp(&b.found[quantity]));
        let mut least = examined[0].clone();
        for start in &examined[..STARTS.min(examined.len())] {
            let lower = examiner.descend(start, quantity)?;
            if lower.found[quantity] < least.found[quantity] {
                least = lower;
            }
        }
        leasts.push(Least {
            value: least.found[quantity],
            point: space.point(&space.state(&least.unit)),
        });
    }
    Ok(space.report(examiner.evaluations, leasts))
}

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
        // 1000 points in 64 cells: 15.6 in a cell on average.
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

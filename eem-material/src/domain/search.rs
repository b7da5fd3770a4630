//! The smallest heat capacity and viscosities of a domain, as far as a sample and slopes lead.

use super::error::DomainError;
use super::point::{DomainReport, Least, Space};
use super::sample;

/// Number of the worst points from which the search descends.
const STARTS: usize = 4;
/// First and last step of the search, parts of the box.
const STEPS: [f64; 2] = [0.125, 1e-6];
/// Limit of the moves from one start, for quantities that fall in tiny steps.
const MOVES: usize = 500;

/// Heat capacity and viscosities of a state, or why it is invalid.
type Examine<'e> = dyn Fn(&[f64]) -> Result<Vec<f64>, DomainError> + 'e;

/// An examined point of the unit cube and its quantities.
#[derive(Clone, Debug)]
struct Examined {
    unit: Vec<f64>,
    found: Vec<f64>,
}

/// Counts the examinations.
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
    /// none of them gains (compass search, Fermi & Metropolis 1952).
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
    let units = sample::corners(dimension).chain(sample::even(dimension, samples));
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

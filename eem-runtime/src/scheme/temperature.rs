//! The temperature that belongs to an entropy, from a temperature that is nearly right.
//!
//! Newton's method in ln θ, as long as it contracts; anything else is left to
//! [`invert`], which finds the temperature from any start on the same stable branch.

use super::Infeasible;
use crate::free_energy::{Caloric, FreeEnergy};
use crate::inversion::invert;
use crate::scalar::{Mask, Real, unless};

/// The largest correction of ln θ, in units of √ε, after which the entropy need not be evaluated
/// again. Newton's method in ln θ leaves half the square of the correction, times the slope
/// of ln C over ln θ: ε/32 for C ∝ θ, and as much for eˣ.
const LAST_CORRECTION: f64 = 0.25;

/// A first correction of ln θ for which the start is not nearly right.
const LARGEST_CORRECTION: f64 = 0.25;

/// The least by which a correction must be smaller than the one before.
const CONTRACTION: f64 = 0.25;

/// θ̂ at the configuration of `x`, whose own temperature does not matter; stable.
#[inline]
pub(crate) fn temperature_at<S: Real, M: FreeEnergy<S>>(
    model: &M,
    x: M::Variables,
    entropy: S,
    guess: S,
) -> Result<S, Infeasible> {
    let caloric_at = model.caloric_at(x);
    let found = solve(|theta| (caloric_at(theta).0, S::zero()), entropy, guess)?;
    Ok(found.0)
}

/// The same, and the free energy there: at the last temperature that was tried, which is the same
/// to √ε.
#[inline]
pub(crate) fn temperature_and_energy_at<S: Real, M: FreeEnergy<S>>(
    model: &M,
    x: M::Variables,
    entropy: S,
    guess: S,
) -> Result<(S, S), Infeasible> {
    solve(model.caloric_at(x), entropy, guess)
}

/// θ̂, and what else was evaluated at the last temperature.
#[inline]
fn solve<S: Real>(
    caloric_at: impl Fn(S) -> (Caloric<S>, S),
    entropy: S,
    guess: S,
) -> Result<(S, S), Infeasible> {
    let enough = S::from_f64(LAST_CORRECTION) * S::EPSILON.sqrt();
    let mut limit = S::from_f64(LARGEST_CORRECTION);
    let mut theta = guess;
    let (mut found, mut found_other) = (theta, theta);
    let mut settled = S::Mask::none();
    loop {
        let (caloric, other) = caloric_at(theta);
        let correction = (entropy - caloric.entropy) / caloric.heat_capacity;
        let size = correction.abs();
        let is_near = S::zero().less(caloric.heat_capacity) & size.at_most(limit);
        let is_far = !(settled | is_near);
        if is_far.any() {
            let theta = search(|theta| caloric_at(theta).0, entropy, guess, is_far)?;
            let other = caloric_at(theta).1;
            if is_far.all() {
                return Ok((theta, other));
            }
            found = S::select(is_far, theta, found);
            found_other = S::select(is_far, other, found_other);
            settled = settled | is_far;
        }
        found = unless(settled, found, theta + theta * correction);
        found_other = unless(settled, found_other, other);
        settled = settled | size.at_most(enough);
        if settled.all() {
            return Ok((found, found_other));
        }
        theta *= correction.exp();
        limit = S::from_f64(CONTRACTION) * size;
    }
}

/// The same from any start, for the numbers that are far off; several in one are searched one by one.
#[cold]
fn search<S: Real>(
    caloric_at: impl Fn(S) -> Caloric<S>,
    entropy: S,
    guess: S,
    is_far: S::Mask,
) -> Result<S, Infeasible> {
    if S::LANES == 1 {
        return search_one(caloric_at, entropy, guess);
    }
    let mut failure = None;
    let temperatures = S::pack(|lane| {
        let start = guess.lane(lane);
        let is_needed = S::select(is_far, S::one(), S::zero()).lane(lane) > 0.0;
        if !is_needed {
            return start;
        }
        let caloric_at = |theta: f64| {
            let Caloric {
                entropy,
                heat_capacity,
                magnitude,
            } = caloric_at(S::from_f64(theta));
            Caloric {
                entropy: entropy.lane(lane),
                heat_capacity: heat_capacity.lane(lane),
                magnitude: magnitude.lane(lane),
            }
        };
        let found = search_one(caloric_at, entropy.lane(lane), start);
        found.unwrap_or_else(|infeasible| {
            failure = Some(infeasible);
            start
        })
    });
    failure.map_or(Ok(temperatures), Err)
}

fn search_one<S: Real>(
    caloric_at: impl Fn(S) -> Caloric<S>,
    entropy: S,
    guess: S,
) -> Result<S, Infeasible> {
    match invert(caloric_at, entropy, guess) {
        Ok(found) => Ok(found.temperature),
        Err(source) => Err(Infeasible::Entropy {
            entropy: entropy.to_f64(),
            source,
        }),
    }
}

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
        if !(settled | is_near).decide() {
            let theta = search(|theta| caloric_at(theta).0, entropy, guess)?;
            return Ok((theta, caloric_at(theta).1));
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

/// The same from any start.
#[cold]
fn search<S: Real>(
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

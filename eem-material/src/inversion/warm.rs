//! Newton's method in ln θ from a temperature that is nearly right.
//!
//! ```text
//! θ ← θ e^((s − S)/C)
//! ```
//!
//! [`invert`](super::invert) and the schemes begin with it. Where it does not contract, the [search](search_from) starts
//! again from the first temperature, and finds the solution from anywhere on the same stable branch.

use super::error::InversionError;
use super::search::search_from;
use crate::free_energy::Caloric;
use crate::number::scalar::{Mask, Real, unless};

/// A first correction of ln θ for which the start is not nearly right.
const LARGEST_CORRECTION: f64 = 0.25;

/// Roundings of the largest terms of an entropy, in the evaluation of which several add up.
const ENTROPY_ROUNDINGS: f64 = 4.0;

/// The least by which a correction must be smaller than the one before.
const CONTRACTION: f64 = 0.25;

/// The temperature of the entropy, and what else was evaluated at the last temperature that was tried.
///
/// The first correction of ln θ that is at most `enough` is the last one.
///
/// # Errors
///
/// As [`invert`](super::invert).
#[inline]
pub fn temperature_near<S: Real, const W: usize>(
    mut caloric_at: impl FnMut(S) -> (Caloric<S>, [S; W]),
    entropy: S,
    guess: S,
    enough: S,
) -> Result<(S, [S; W]), InversionError> {
    let mut limit = S::from_f64(LARGEST_CORRECTION);
    let mut theta = guess;
    let (mut found, mut found_other) = (theta, [theta; W]);
    let mut converged = S::Mask::none();
    loop {
        let (caloric, mut other) = caloric_at(theta);
        let defect = entropy - caloric.entropy;
        let mut correction = defect / caloric.heat_capacity;
        let size = correction.abs();
        let is_stable = S::zero().less(caloric.heat_capacity);
        let is_far = !(converged | (is_stable & size.at_most(limit)));
        let mut last = size.at_most(enough);
        if is_far.any() {
            // A residual of rounding cannot be reduced by a search.
            let rounding = S::from_f64(ENTROPY_ROUNDINGS) * S::EPSILON * caloric.magnitude;
            let is_noise = is_far & is_stable & defect.abs().at_most(rounding);
            let is_far = is_far & !is_noise;
            if is_far.any() {
                let sought = search_far(|theta| caloric_at(theta).0, entropy, guess, is_far)?;
                theta = S::select(is_far, sought, theta);
                if W > 0 {
                    other = caloric_at(theta).1;
                }
            }
            correction = S::select(is_noise | is_far, S::zero(), correction);
            last = last | is_noise | is_far;
        }
        found = unless(converged, found, theta + theta * correction);
        for (found, other) in found_other.iter_mut().zip(other) {
            *found = unless(converged, *found, other);
        }
        converged = converged | last;
        if converged.all() {
            return Ok((found, found_other));
        }
        theta *= correction.exp();
        limit = S::from_f64(CONTRACTION) * size;
    }
}

/// The temperatures of the lanes that are far off, searched one by one.
#[cold]
fn search_far<S: Real>(
    mut caloric_at: impl FnMut(S) -> Caloric<S>,
    entropy: S,
    guess: S,
    is_far: S::Mask,
) -> Result<S, InversionError> {
    if S::LANES == 1 {
        return search_from(caloric_at, entropy, guess);
    }
    let mut failure = None;
    let temperatures = S::pack(|lane| {
        let start = guess.lane(lane);
        let is_inactive = S::select(is_far, S::zero(), S::one()).lane(lane) > 0.0;
        if is_inactive {
            return start;
        }
        let caloric_at = |theta: f64| {
            let caloric = caloric_at(S::from_f64(theta));
            Caloric {
                entropy: caloric.entropy.lane(lane),
                heat_capacity: caloric.heat_capacity.lane(lane),
                magnitude: caloric.magnitude.lane(lane),
            }
        };
        search_from(caloric_at, entropy.lane(lane), start).unwrap_or_else(|error| {
            failure = Some(error);
            start
        })
    });
    failure.map_or(Ok(temperatures), Err)
}

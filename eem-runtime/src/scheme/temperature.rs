//! The temperature that belongs to an entropy, from a temperature that is nearly right.
//!
//! Newton's method in ln θ, as long as it contracts; anything else is left to
//! [`invert`], which finds the temperature from any start on the same stable branch.

use crate::free_energy::{Caloric, FreeEnergy};
use crate::inversion::invert;
use crate::scalar::{Mask, Real, unless};
use crate::scheme::element::Infeasible;
use crate::state::Energy;

/// The largest correction of ln θ, in units of √ε, after which the entropy need not be evaluated
/// again. Newton's method in ln θ leaves half the square of the correction, times the slope
/// of ln C over ln θ: ε/32 for C ∝ θ, and as much for eˣ.
const LAST_CORRECTION: f64 = 0.25;

/// A first correction of ln θ for which the start is not nearly right.
const LARGEST_CORRECTION: f64 = 0.25;

/// Roundings of the largest terms of an entropy, in the evaluation of which several add up.
const ENTROPY_ROUNDINGS: f64 = 4.0;

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
    let enough = S::from_f64(LAST_CORRECTION) * S::EPSILON.sqrt();
    let found = solve(|theta| (caloric_at(theta).0, []), entropy, guess, enough)?;
    Ok(found.0)
}

/// The temperature of a new state with what belongs to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settled<S> {
    /// θ̂, K.
    pub(crate) temperature: S,
    /// ψ, J.
    pub(crate) free_energy: S,
    /// `ψ + θ s`, J.
    pub(crate) energy: Energy<S>,
}

/// The same for a state that is kept. Its last correction of ln θ is at most ε^¾: what that leaves, half
/// its square times d ln C/d ln θ, is far below a rounding of the entropy. `ψ + θ s` is stationary in θ
/// at fixed s, so that it may be that of the last temperature that was tried.
#[inline]
pub(crate) fn settled_at<S: Real, M: FreeEnergy<S>>(
    model: &M,
    x: M::Variables,
    entropy: S,
    guess: S,
) -> Result<Settled<S>, Infeasible> {
    let root = S::EPSILON.sqrt();
    let energy_at = model.caloric_at(x);
    let with_energy = |theta: S| {
        let (caloric, psi) = energy_at(theta);
        let of_energy = [psi, theta, caloric.heat_capacity, caloric.magnitude];
        (caloric, of_energy)
    };
    let (temperature, [psi, theta, heat_capacity, magnitude]) =
        solve(with_energy, entropy, guess, root * root.sqrt())?;
    let caloric = Caloric {
        entropy,
        heat_capacity,
        magnitude,
    };
    Ok(Settled {
        temperature,
        free_energy: psi,
        energy: Energy::new(psi, [theta, entropy], &caloric),
    })
}

/// θ̂, and what else was evaluated at the last temperature that was tried.
#[inline]
fn solve<S: Real, const W: usize>(
    caloric_at: impl Fn(S) -> (Caloric<S>, [S; W]),
    entropy: S,
    guess: S,
    enough: S,
) -> Result<(S, [S; W]), Infeasible> {
    let mut limit = S::from_f64(LARGEST_CORRECTION);
    let mut theta = guess;
    let (mut found, mut found_other) = (theta, [theta; W]);
    let mut settled = S::Mask::none();
    loop {
        let (caloric, mut other) = caloric_at(theta);
        let lacking = entropy - caloric.entropy;
        let mut correction = lacking / caloric.heat_capacity;
        let size = correction.abs();
        let is_stable = S::zero().less(caloric.heat_capacity);
        let is_far = !(settled | (is_stable & size.at_most(limit)));
        let mut last = size.at_most(enough);
        if is_far.any() {
            // Where rounding of the entropy is all that is left, no search finds better.
            let rounding = S::from_f64(ENTROPY_ROUNDINGS) * S::EPSILON * caloric.magnitude;
            let is_noise = is_far & is_stable & lacking.abs().at_most(rounding);
            let is_far = is_far & !is_noise;
            if is_far.any() {
                let sought = search(|theta| caloric_at(theta).0, entropy, guess, is_far)?;
                theta = S::select(is_far, sought, theta);
                other = caloric_at(theta).1;
            }
            correction = S::select(is_noise | is_far, S::zero(), correction);
            last = last | is_noise | is_far;
        }
        found = unless(settled, found, theta + theta * correction);
        for (found, other) in found_other.iter_mut().zip(other) {
            *found = unless(settled, *found, other);
        }
        settled = settled | last;
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

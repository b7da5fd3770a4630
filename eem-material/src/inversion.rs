//! The temperature at which a spring has a given entropy, on the stable branch it is on.
//!
//! The entropy form of a scheme carries `s` as the state and needs `θ` from
//! `S(θ) = s` for free energies whose `S` has no closed inverse. The unknown is
//! `x = ln θ`, so that temperatures stay positive and `dS/dx = θS_θ = C` is the heat capacity. Newton's method is safeguarded
//! by two intervals that only shrink: where the residual changes sign, and where the heat capacity may be positive (beyond a
//! spinodal it is not); and by a limit of steps while the solution is not enclosed.

mod error;
mod search;

use crate::number::scalar::{Scalar, is_positive};
use crate::values::Caloric;
use search::search_from;

pub use error::InversionError;

/// The largest correction of ln θ, in ε, that [`invert`] applies without another evaluation: the
/// resolution of a temperature.
const ENOUGH: f64 = 2.0;

/// A temperature found by [`invert`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inversion {
    /// The temperature, in the unit of the start.
    pub temperature: f64,
    /// How many times the entropy was evaluated.
    pub evaluations: usize,
}

/// The temperature `θ` with `S(θ) = entropy` on the stable branch that contains `start`.
///
/// ```text
/// x = ln θ,   S(eˣ) = s,   dS/dx = C,   x ← x − (S − s)/C
/// ```
///
/// The stable branch is the connected set of temperatures with `C > 0` around the start, normally the last accepted
/// temperature. `S` increases on it, so there is at most one solution. `evaluate` returns the entropy, the heat
/// capacity and the sum of |terms of S|, which separates rounding from a residual, in any units. The entropy is met
/// to a few ε of that sum. A good start takes 2 to 5 evaluations, a start that is wrong by hundreds of orders of
/// magnitude 10 to 20.
///
/// An unstable range is noticed if an evaluation falls into it or finds a lower entropy behind it, but not if a
/// step jumps over it to a branch with larger entropy. Until two evaluations enclose the solution, a step changes
/// ln θ at most by a limit: 1 at first, doubled whenever a step reaches it.
///
/// Where Newton's method would leave the enclosing interval or stagnates, bisection replaces it (Dekker 1969; Brent
/// 1973). Where the entropy behaves like a power of the temperature, Newton's method is applied to `ln S`.
///
/// # Errors
///
/// [`InversionError`] if the entropy is not finite, the start is not on a stable branch, or the branch does not
/// reach the entropy.
///
/// ```
/// use eem::{Caloric, invert};
///
/// // A Debye solid at low temperature: S = θ³.
/// let debye = |theta: f64| Caloric {
///     entropy: theta.powi(3),
///     heat_capacity: 3.0 * theta.powi(3),
///     magnitude: theta.powi(3),
/// };
/// let found = invert(debye, 8.0, 300.0)?;
/// assert!((found.temperature - 2.0).abs() < 1e-15);
/// # Ok::<(), eem_material::InversionError>(())
/// ```
pub fn invert(
    mut evaluate: impl FnMut(f64) -> Caloric<f64>,
    entropy: f64,
    start: f64,
) -> Result<Inversion, InversionError> {
    if !is_positive(start) {
        return Err(InversionError::InvalidStart { start });
    }
    let mut evaluations = 0;
    let mut counted = |theta| {
        evaluations += 1;
        (evaluate(theta), [])
    };
    let at_start = (start, counted(start));
    let enough = ENOUGH * f64::EPSILON;
    let (temperature, _) = temperature_near(at_start, counted, entropy, enough)?;
    Ok(Inversion {
        temperature,
        evaluations,
    })
}

/// If the first correction of ln θ is larger, the start is poor and a search begins.
const LARGEST_CORRECTION: f64 = 0.25;

/// A residual may be rounding noise below this many ε of the sum of |terms of S|.
const ENTROPY_ROUNDINGS: f64 = 4.0;

/// Newton's method continues while a correction is at most this fraction of the one before.
const CONTRACTION: f64 = 0.25;

/// Newton's method in ln θ from a temperature near the solution, `θ ← θ e^((s − S)/C)`, at which the caloric quantities are given;
/// also returns the other values evaluated at the last temperature.
///
/// Where it does not contract, a search starts again from the first temperature, and finds the solution
/// from anywhere on the same stable branch.
///
/// The first correction of ln θ that is at most `enough` is the last one.
///
/// # Errors
///
/// As [`invert`].
#[inline]
pub fn temperature_near<const W: usize>(
    (guess, mut at_theta): (f64, (Caloric<f64>, [f64; W])),
    mut caloric_at: impl FnMut(f64) -> (Caloric<f64>, [f64; W]),
    entropy: f64,
    enough: f64,
) -> Result<(f64, [f64; W]), InversionError> {
    let mut limit = LARGEST_CORRECTION;
    let mut theta = guess;
    loop {
        let (caloric, other) = at_theta;
        let defect = entropy - caloric.entropy;
        let correction = defect / caloric.heat_capacity;
        let size = correction.abs();
        let is_stable = caloric.heat_capacity > 0.0;
        if !(is_stable && size <= limit) {
            // A residual of rounding cannot be reduced by a search.
            let rounding = ENTROPY_ROUNDINGS * f64::EPSILON * caloric.magnitude;
            if is_stable && defect.abs() <= rounding {
                return Ok((theta, other));
            }
            let found = search_from(&mut |theta| caloric_at(theta).0, entropy, guess)?;
            let other = if W > 0 { caloric_at(found).1 } else { other };
            return Ok((found, other));
        }
        if size <= enough {
            return Ok((theta + theta * correction, other));
        }
        theta *= Scalar::exp(correction);
        at_theta = caloric_at(theta);
        limit = CONTRACTION * size;
    }
}

//! The temperature at which a spring has a given entropy, on the stable branch it is on.
//!
//! The entropy form of a scheme carries `s` as the state and needs `θ` from
//! `S(θ) = s` for free energies whose `S` has no closed inverse. The unknown is
//! `x = ln θ`, so that temperatures stay positive and `dS/dx = θS_θ = C` is the heat capacity. Newton's method is safeguarded
//! by two intervals that only shrink: where the residual changes sign, and where the heat capacity may be positive (beyond a
//! spinodal it is not); and by a limit of steps while the solution is not enclosed.

mod error;
mod search;
mod warm;

use crate::free_energy::Caloric;
use crate::number::scalar::{Real, is_positive};

pub use error::InversionError;
pub use warm::temperature_near;

/// The largest correction of ln θ, in ε, that [`invert`] applies without another evaluation: the
/// resolution of a temperature.
const ENOUGH: f64 = 2.0;

/// A temperature found by [`invert`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inversion<S> {
    /// The temperature, in the unit of the start.
    pub temperature: S,
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
/// the temperature at most by a factor e.
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
pub fn invert<S: Real>(
    mut evaluate: impl FnMut(S) -> Caloric<S>,
    entropy: S,
    start: S,
) -> Result<Inversion<S>, InversionError> {
    if !is_positive(start) {
        return Err(InversionError::InvalidStart {
            start: start.to_f64(),
        });
    }
    let mut evaluations = 0;
    let counted = |theta| {
        evaluations += 1;
        (evaluate(theta), [])
    };
    let enough = S::from_f64(ENOUGH) * S::EPSILON;
    let (temperature, _) = temperature_near(counted, entropy, start, enough)?;
    Ok(Inversion {
        temperature,
        evaluations,
    })
}

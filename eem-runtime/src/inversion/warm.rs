//! Starts that are close already: a few Newton steps, none of the machinery of a search.
//!
//! ```text
//! θ ← θ e^(−r/C),   r = S(θ) − s
//! ```
//!
//! A step is taken if it is short and a fraction of the one before, and its result has to be stable and
//! in line with the entropy before it. Anything else is left to the search, from the start.

use super::Inversion;
use super::point::Point;
use crate::free_energy::Caloric;
use crate::scalar::Real;

/// The longest first step in ln θ: far below the factor e that an unenclosed step may have.
const LONGEST: f64 = 0.25;

/// A step has to shrink to this part of the one before, far less than where Newton's method
/// converges as its theory says.
const SHRINKING: f64 = 0.125;

/// Below this, `1 + x + x²/2 + x³/6 + x⁴/24` is eˣ to rounding: x⁵/120 < 2⁻⁵⁶.
const SMALL: f64 = 1.0 / 1024.0;

/// The outcome of a warm start.
pub(super) enum Warm<S> {
    Found(Inversion<S>),
    /// Not close enough: the entropy at the start, and what has been spent.
    Cold(Caloric<S>, usize),
}

/// Newton's method from a start that may be close. Points count `x` from the start.
pub(super) fn start<S: Real>(
    evaluate: &mut impl FnMut(S) -> Caloric<S>,
    entropy: S,
    start: S,
) -> Warm<S> {
    let first = evaluate(start);
    let mut point = Point::new(S::zero(), start, first, entropy);
    let mut evaluations = 1;
    let mut longest = S::from_f64(LONGEST);
    loop {
        let step = point.newton();
        // What is not a number ends here too.
        if !(point.stable() && step.abs() <= longest) {
            return Warm::Cold(first, evaluations);
        }
        if point.is_noise() || step.abs() <= point.resolution() {
            return Warm::Found(Inversion {
                temperature: point.theta * exponential(point.last_correction()),
                evaluations,
            });
        }
        let theta = point.theta * exponential(step);
        let trial = Point::new(point.x + step, theta, evaluate(theta), entropy);
        evaluations += 1;
        if !(trial.stable() && trial.follows(&point)) {
            return Warm::Cold(first, evaluations);
        }
        longest = S::from_f64(SHRINKING) * step.abs();
        point = trial;
    }
}

/// eˣ, without the library where a few terms are enough.
fn exponential<S: Real>(x: S) -> S {
    if x.abs() > S::from_f64(SMALL) {
        return x.exp();
    }
    let [half, third, quarter] = [0.5, 1.0 / 3.0, 0.25].map(S::from_f64);
    let one = S::one();
    one + x * (one + half * x * (one + third * x * (one + quarter * x)))
}

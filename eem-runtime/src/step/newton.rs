//! When Newton's method is done, and what it did.

use crate::number::scalar::{Mask, Real};

/// How hard a step tries.
///
/// The tolerance decides when a trial is looked at as a solution. An exact scheme then takes it only if
/// what is closed from there [proves its laws](StepReport::defect), and iterates on otherwise: a looser
/// tolerance cannot break them.
///
/// ```
/// use eem::NewtonSettings;
///
/// let settings = NewtonSettings::<f64>::default();
/// assert_eq!(settings.max_iterations, 50);
/// assert!((settings.tolerance - 1.5e-8).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct NewtonSettings<S> {
    /// Iterations after which an attempt is given up. Default 50. More only helps steps that are far
    /// too large. Where the first attempt fails, an exact scheme makes several, from other starts and
    /// in parts of the step; reports and errors count the iterations of all.
    pub max_iterations: usize,
    /// The largest update, in units of the shortest stretch at each node and of the temperatures, that may
    /// be the last one. Default √ε, 1.5·10⁻⁸ in double precision: the error after the update is its
    /// square. Smaller costs iterations and gains nothing.
    pub tolerance: S,
}

impl<S: Real> Default for NewtonSettings<S> {
    fn default() -> Self {
        Self {
            max_iterations: 50,
            tolerance: S::EPSILON.sqrt(),
        }
    }
}

/// What Newton's method needed for one step, and what the step proves of itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport<S> {
    /// The time at the end of the step, s.
    pub time: S,
    /// The size of the step, s.
    pub step: S,
    /// Newton iterations.
    pub iterations: usize,
    /// The last scaled update, the largest of the phases of a staggered step.
    pub update: S,
    /// The largest residual of the momentum balances at the new state, N s.
    pub residual: S,
    /// `ΔE − work − heat` of the step, J: the energies are values of ψ at the stored states, never forces or
    /// differences of the scheme. See [`bound`](Self::bound). In the first step after a checkpoint was restored
    /// its last roundings may be others, as the energies of the old state are evaluated anew.
    pub defect: S,
    /// What rounding may do to the energy of the step, J: the true `ΔE − work − heat` of the stored states, which
    /// [`defect`](Self::defect) rounds, is within it in every step of an exact scheme. A step beyond it is an
    /// error, [`StepFailure::LawNotKept`](crate::StepFailure::LawNotKept).
    ///
    /// It is `64 ε` times the terms of the balance, `|ψ| + θ|s| + cθ`, `|f|λ` and `|g||γ|` with the forces at
    /// both ends among them, and the work of what rounding of their arguments does to the forces. Where the
    /// terms of ψ cancel, what rounding does to its values is added.
    ///
    /// It says what the proof is worth: a length is known to `ε λ`, so that a body of the stiffness k far
    /// stiffer than its energies need, or near a singular force, has them to `ε k λ²` only.
    pub bound: S,
    /// Whether [`bound`](Self::bound) exceeds 100 times `64 ε` of `T + |ψ| + θ|s| + cθ + |f|λ + |g||γ|` at both
    /// ends: the step keeps its laws as far as rounding lets it say, but less sharply than the energies are
    /// stored. That is so where internal variables answer to the rounding of a length far more than the energies
    /// do, or where terms of ψ cancel.
    ///
    /// If the bound is too wide for the purpose, measure ψ from where its terms do not cancel (`ln_1p`, `exp_m1`,
    /// a square in the place of a difference of squares), replace a body that is far too stiff by a rigid one, or
    /// keep away from the singularity of the force.
    pub is_bound_wide: bool,
    /// The entropy that dashpots and conduction produced, J/K.
    pub production: S,
    /// The smallest production of a single dashpot or path of heat, J/K; never negative in an exact
    /// scheme. Zero without any.
    pub least_production: S,
    /// The estimated error of the step in units of its tolerance, below 1.2; zero where [step
    /// control](crate::Simulation::control_steps) is off.
    pub error: S,
    /// By how much an explicit step missed the energy before it was closed, relative to the magnitude of the
    /// terms of the energy; zero for other schemes. See [`Simulation::corrections`](crate::Simulation::corrections).
    pub correction: S,
}

impl<S: Real> StepReport<S> {
    /// Of two steps in a row as if they were one.
    pub(crate) fn and(self, later: Self) -> Self {
        Self {
            time: later.time,
            step: self.step + later.step,
            iterations: self.iterations + later.iterations,
            update: self.update.maximum(later.update),
            residual: self.residual.maximum(later.residual),
            defect: self.defect + later.defect,
            bound: self.bound + later.bound,
            is_bound_wide: self.is_bound_wide | later.is_bound_wide,
            production: self.production + later.production,
            least_production: self.least_production.minimum(later.least_production),
            error: self.error.maximum(later.error),
            correction: self.correction.maximum(later.correction),
        }
    }
}

/// An update below `tolerance` is the last one if it is also this much smaller than the one before:
/// the iteration then contracts, and what remains is smaller still.
pub(crate) const CONTRACTION: f64 = 0.1;

/// An iteration that contracts less than this, with updates below a tenth of the tolerance,
/// has reached what rounding allows.
pub(crate) const STAGNATION: f64 = 0.25;

/// Whether an update is the last one, given the one before.
#[inline]
pub(crate) fn is_last<S: Real>(update: S, before: Option<S>, tolerance: S) -> S::Mask {
    let is_small = update.at_most(tolerance);
    if !is_small.any() {
        return S::Mask::none();
    }
    let Some(before) = before else {
        return is_small;
    };
    let contracts = is_small & update.at_most(S::from_f64(CONTRACTION) * before);
    if !(is_small & !contracts).any() {
        return contracts;
    }
    let is_on_floor = update.at_most(S::from_f64(CONTRACTION) * tolerance);
    let stagnates = (S::from_f64(STAGNATION) * before).at_most(update);
    contracts | (is_small & is_on_floor & stagnates)
}

/// The largest magnitude of many numbers, NaN unless all of them are finite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Largest<S> {
    largest: S,
    /// Of all magnitudes: it keeps a NaN, which a comparison loses.
    sum: S,
}

impl<S: Real> Largest<S> {
    /// Zero, of none.
    #[inline]
    pub(crate) fn none() -> Self {
        Self {
            largest: S::zero(),
            sum: S::zero(),
        }
    }

    /// Looks at another number.
    #[inline]
    pub(crate) fn see(&mut self, value: S) {
        let size = value.abs();
        self.sum += size;
        self.largest = S::select(self.largest.less(size), size, self.largest);
    }

    /// The largest so far.
    #[inline]
    pub(crate) fn found(self) -> S {
        // The product is zero, or NaN.
        self.largest + S::zero() * self.sum
    }
}

#[cfg(test)]
mod tests {
    use super::{Largest, is_last};

    #[test]
    fn what_is_not_finite_is_the_largest_wherever_it_comes() {
        let largest = |values: [f64; 3]| {
            let mut largest = Largest::none();
            for value in values {
                largest.see(value);
            }
            largest.found()
        };
        assert_eq!(largest([1.0, -3.0, 2.0]).to_bits(), 3.0_f64.to_bits());
        assert!(largest([f64::NAN, 1.0, 2.0]).is_nan());
        assert!(largest([1.0, 2.0, f64::NAN]).is_nan());
        assert!(largest([1.0, f64::INFINITY, 2.0]).is_nan());
    }

    #[test]
    fn a_small_update_must_contract() {
        assert!(is_last::<f64>(1e-9, None, 1e-8));
        assert!(is_last::<f64>(1e-9, Some(1e-4), 1e-8));
        assert!(!is_last::<f64>(5e-9, Some(1e-8), 1e-8));
    }

    #[test]
    fn rounding_is_a_floor_and_a_stall_is_not() {
        assert!(is_last::<f64>(3e-10, Some(4e-10), 1e-8));
        assert!(!is_last::<f64>(3e-3, Some(4e-3), 1e-8));
        assert!(!is_last(f64::NAN, Some(1e-3), 1e-8));
    }
}

/// One iteration of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonIteration {
    /// The largest residual of the momentum balances before the update, N s.
    pub residual: f64,
    /// The largest update, in units of the longest stretch and of the temperatures.
    pub update: f64,
}

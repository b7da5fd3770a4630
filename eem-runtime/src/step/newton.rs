//! Convergence of Newton's method, its settings and its report.

use eem_material::number::scalar::Scalar;

/// Settings of Newton's method.
///
/// The tolerance decides when a trial counts as a solution. An exact scheme accepts it only if the step [proves its
/// laws](StepReport::defect), and otherwise continues to iterate. A looser tolerance therefore cannot break them.
///
/// ```
/// use eem::NewtonSettings;
///
/// let settings = NewtonSettings::default();
/// assert_eq!(settings.max_iterations, 50);
/// assert!((settings.tolerance - 1.5e-8).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub struct NewtonSettings {
    /// The maximum number of iterations of an attempt, 50 by default. More helps only steps that are far too large.
    /// If the first attempt fails, an exact scheme makes several, from other initial guesses and in parts of the
    /// step; reports and errors count all iterations.
    pub max_iterations: usize,
    /// The largest update that can be the last one, relative to the shortest stretch at each node and to the
    /// temperatures. The default is √ε, 1.5·10⁻⁸; the error after the update is its square. A
    /// smaller tolerance costs iterations and gains nothing.
    pub tolerance: f64,
}

impl Default for NewtonSettings {
    fn default() -> Self {
        Self {
            max_iterations: 50,
            tolerance: f64::EPSILON.sqrt(),
        }
    }
}

/// The result of a step: what Newton's method needed, and what the step proves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport {
    /// The time at the end of the step, s.
    pub time: f64,
    /// The size of the step, s.
    pub step: f64,
    /// Newton iterations.
    pub iterations: usize,
    /// The last scaled update; for a staggered step the larger of its two parts.
    pub update: f64,
    /// The largest residual of the momentum balances at the new state, N s.
    pub residual: f64,
    /// `ΔE − work − heat` of the step, J, from values of ψ at the stored states, never from forces; see
    /// [`bound`](Self::bound). Its last digits may differ in the first step after a restored checkpoint, which evaluates the
    /// energies of the old state again.
    pub defect: f64,
    /// The bound for the effect of rounding on the energy of the step, J. The true `ΔE − work − heat` of the stored
    /// states, of which [`defect`](Self::defect) is the rounded value, is within this bound in every step of an
    /// exact scheme. Beyond it the step is the error [`StepFailure::LawNotKept`](crate::StepFailure::LawNotKept).
    ///
    /// It is `64 ε` times the terms of the balance, which are `|ψ| + θ|s| + cθ`, `|f|λ` and `|g||γ|` with the
    /// forces at both ends, and the effect of rounding in the arguments and sums of the forces; and the work of what rounding
    /// leaves of the momentum balances, where nodes move far in a step. If terms of ψ cancel, the
    /// rounding of ψ is added. A length has an error of `ε λ`; so a very stiff body, or one near a singular force, has an
    /// energy error of `ε k λ²` with its stiffness k.
    pub bound: f64,
    /// Whether [`bound`](Self::bound) exceeds 100 times `64 ε` of `T + |ψ| + θ|s| + cθ + |f|λ + |g||γ|` at both
    /// ends; in implicit schemes, which have the forces at the end by secants only, a sixteenth of that. The step then
    /// satisfies its laws to rounding, but less precisely than the energies are stored. This happens if internal variables
    /// depend much more on the rounding of a length than the energies do, or if terms of ψ cancel.
    ///
    /// If the bound is too wide for your purpose, write ψ without cancelling terms (`ln_1p`, `exp_m1`, a square
    /// instead of a difference of squares), replace a very stiff body by a rigid one, or keep away from the
    /// singularity of the force.
    pub is_bound_wide: bool,
    /// Entropy produced by dashpots and conduction, J/K.
    pub production: f64,
    /// The smallest production of a single dashpot or conductance, J/K; never negative in an exact scheme. Zero if
    /// there is none.
    pub least_production: f64,
    /// The number of points whose conduction, and of dashpots that, relax faster than the step resolves: `h > 2τ`, with the
    /// relaxation time `τ = c/(2 Σ κ to elements + Σ κ to reservoirs)` of a heat capacity c, or `τ = η/k` of a dashpot with the
    /// stiffness `k = ∂²ψ/∂γ²`. There all schemes but [`EemDamped`](crate::Scheme::EemDamped) decay too slowly or
    /// alternate. If it is zero, none alternates. Zero in steps of
    /// [`EemDamped`](crate::Scheme::EemDamped), of [`EemExplicit`](crate::Scheme::EemExplicit) and of the schemes for comparison. See
    /// [`Simulation::warning`](crate::Simulation::warning).
    pub unresolved: usize,
    /// The estimated error of the step relative to its tolerance, below 1.2; zero without [step
    /// control](crate::Simulation::control_steps).
    pub error: f64,
    /// The energy error of an explicit step before its correction, relative to the magnitude of the energy terms;
    /// zero for other schemes. See [`Simulation::corrections`](crate::Simulation::corrections).
    pub correction: f64,
}

impl StepReport {
    /// Before the first step.
    pub(crate) fn none() -> Self {
        Self {
            time: 0.0,
            step: 0.0,
            iterations: 0,
            update: 0.0,
            residual: 0.0,
            defect: 0.0,
            bound: 0.0,
            is_bound_wide: false,
            production: 0.0,
            least_production: 0.0,
            unresolved: 0,
            error: 0.0,
            correction: 0.0,
        }
    }

    /// The report of two consecutive steps as one.
    pub(crate) fn and(self, later: Self) -> Self {
        Self {
            time: later.time,
            step: self.step + later.step,
            iterations: self.iterations + later.iterations,
            update: Scalar::maximum(self.update, later.update),
            residual: Scalar::maximum(self.residual, later.residual),
            defect: self.defect + later.defect,
            bound: self.bound + later.bound,
            is_bound_wide: self.is_bound_wide || later.is_bound_wide,
            production: self.production + later.production,
            least_production: Scalar::minimum(self.least_production, later.least_production),
            unresolved: self.unresolved.max(later.unresolved),
            error: Scalar::maximum(self.error, later.error),
            correction: Scalar::maximum(self.correction, later.correction),
        }
    }
}

/// One iteration of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonIteration {
    /// The largest residual of the momentum balances before the update, N s.
    pub residual: f64,
    /// The largest update, relative to the shortest stretch at each node and to the temperatures.
    pub update: f64,
}

/// An update below `tolerance` is the last one if it is also this much smaller than the one before: the iteration then
/// contracts, and the error is smaller still.
pub(crate) const CONTRACTION: f64 = 0.1;

/// An iteration whose updates are below a tenth of the tolerance and do not fall below this fraction of the one before
/// has reached the level of rounding.
pub(crate) const STAGNATION: f64 = 0.25;

/// Whether an update is the last one, given the one before.
#[inline]
pub(crate) fn is_last(update: f64, before: Option<f64>, tolerance: f64) -> bool {
    if !(update <= tolerance) {
        return false;
    }
    let Some(before) = before else {
        return true;
    };
    let is_on_floor = update <= CONTRACTION * tolerance;
    update <= CONTRACTION * before || (is_on_floor && STAGNATION * before <= update)
}

/// The largest magnitude of many numbers, NaN unless all of them are finite.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Largest {
    largest: f64,
    /// Of all magnitudes: it propagates a NaN, which a comparison loses.
    sum: f64,
}

impl Largest {
    #[inline]
    pub(crate) fn see(&mut self, value: f64) {
        let size = value.abs();
        self.sum += size;
        if self.largest < size {
            self.largest = size;
        }
    }

    #[inline]
    pub(crate) fn see_all(&mut self, values: &[f64]) {
        for &value in values {
            self.see(value);
        }
    }

    #[inline]
    pub(crate) fn found(self) -> f64 {
        // The product is zero, or NaN.
        self.largest + 0.0 * self.sum
    }
}

/// Number of parts of a step through which the solution is continued if Newton's method fails.
pub(crate) const CONTINUATION_STEPS: u8 = 8;

/// Iterations for which memory is reserved; more of them allocate.
const LONGEST_HISTORY: usize = 4096;

/// The effort of a step: its limits and its iterations.
#[derive(Debug)]
pub(crate) struct Effort {
    pub(crate) settings: NewtonSettings,
    /// The iterations of the last step.
    pub(crate) history: Vec<NewtonIteration>,
    /// The largest residual and the largest last update of the phases of the last step.
    pub(crate) end: NewtonIteration,
}

/// No iteration.
const NONE: NewtonIteration = NewtonIteration {
    residual: 0.0,
    update: 0.0,
};

impl Effort {
    /// The usual settings, before the first step.
    pub(crate) fn new() -> Self {
        Self {
            settings: NewtonSettings::default(),
            history: Vec::new(),
            end: NONE,
        }
    }

    /// The same as [`new`](Self::new), in the memory of a run.
    pub(crate) fn renewed(mut self) -> Self {
        self.history.clear();
        Self {
            history: self.history,
            ..Self::new()
        }
    }

    /// Records an iteration.
    #[inline]
    pub(crate) fn note(&mut self, residual: f64, update: f64) {
        self.history.push(NewtonIteration { residual, update });
    }

    /// Ends a phase of the step, with this residual after the last update.
    #[inline]
    pub(crate) fn conclude(&mut self, residual: f64) {
        let update = self.history.last().map_or(0.0, |last| last.update);
        self.end = NewtonIteration {
            residual: Scalar::maximum(self.end.residual, residual),
            update: Scalar::maximum(self.end.update, update),
        };
    }

    /// Clears the record of the last step.
    pub(crate) fn restart(&mut self) {
        // At worst, two phases of a staggered step, each from two starts and through all continuation steps.
        let parts = 2 * usize::from(CONTINUATION_STEPS + 2);
        let most = self.settings.max_iterations.saturating_mul(parts);
        self.end = NONE;
        self.history.clear();
        self.history.reserve(most.min(LONGEST_HISTORY));
    }
}

#[cfg(test)]
mod tests {
    use super::{Largest, is_last};

    #[test]
    fn what_is_not_finite_is_the_largest_wherever_it_comes() {
        let largest = |values: [f64; 3]| {
            let mut largest = Largest::default();
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
        assert!(is_last(1e-9, None, 1e-8));
        assert!(is_last(1e-9, Some(1e-4), 1e-8));
        assert!(!is_last(5e-9, Some(1e-8), 1e-8));
    }

    #[test]
    fn rounding_is_a_floor_and_a_stall_is_not() {
        assert!(is_last(3e-10, Some(4e-10), 1e-8));
        assert!(!is_last(3e-3, Some(4e-3), 1e-8));
        assert!(!is_last(f64::NAN, Some(1e-3), 1e-8));
    }
}

//! The search for the temperature of an entropy from a start that is not known to be close.
//!
//! Every step either reduces the residual as fast as Newton's method should, or halves an interval.

use super::error::InversionError;
use crate::number::scalar::Scalar;
use crate::values::Caloric;

/// The limit of evaluations in [`invert`](crate::invert): twice what bisection of the whole range of `ln θ` to the last
/// bit would take.
const BUDGET: usize = 128;

/// The residual is rounding noise below this many ε of the sum of |terms of S|.
const NOISE: f64 = 4.0;

/// Two logarithms of temperatures are the same within this many ε of `max(1, |ln θ|)`.
const RESOLUTION: f64 = 2.0;

/// The largest relative change of the heat capacity over the last correction, after which nothing is evaluated.
/// Σ|terms of S| is taken for dC/dx.
const TRUST: f64 = 0.25;

/// If the entropy at the start and the target differ by this factor, the first step assumes a power law.
const LARGE_FACTOR: f64 = 8.0;

/// The entropy at one temperature.
#[derive(Clone, Copy)]
struct Point {
    /// `ln θ`.
    x: f64,
    theta: f64,
    /// `C = dS/dx`.
    heat_capacity: f64,
    /// `S − s`.
    residual: f64,
    entropy: f64,
    /// The part of the residual that may be rounding.
    noise: f64,
}

impl Point {
    /// The point at `θ = eˣ` of a search for the entropy `target`.
    fn new(x: f64, theta: f64, caloric: Caloric<f64>, target: f64) -> Self {
        Self {
            x,
            theta,
            entropy: caloric.entropy,
            heat_capacity: caloric.heat_capacity,
            residual: caloric.entropy - target,
            noise: NOISE * f64::EPSILON * caloric.magnitude,
        }
    }

    /// On a stable branch: `0 < C < ∞` and `S` finite.
    fn is_stable(&self) -> bool {
        self.heat_capacity > 0.0 && self.heat_capacity.is_finite() && self.residual.is_finite()
    }

    /// The entropy has increased with the temperature since `other`, as on one stable branch.
    fn follows(&self, other: &Self) -> bool {
        let increase = self.residual - other.residual;
        let noise = other.noise + self.noise;
        if self.x < other.x {
            increase <= noise
        } else {
            -noise <= increase
        }
    }

    /// Newton's correction of `x`.
    fn newton(&self) -> f64 {
        -self.residual / self.heat_capacity
    }

    /// Newton's correction of a converged point; zero where it would itself be noise: next to a spinodal, where it could
    /// lead beyond, or with nearly no capacity.
    fn last_correction(&self) -> f64 {
        let correction = self.newton();
        let magnitude = self.noise / (NOISE * f64::EPSILON);
        let trusted = TRUST * self.heat_capacity / magnitude;
        let is_sound = correction.abs() <= Scalar::maximum(trusted, self.resolution());
        if is_sound { correction } else { 0.0 }
    }

    /// Newton's correction for `ln S`, exact for `S ∝ θⁿ`; unless both entropies are positive, that for `S`.
    fn logarithmic_newton(&self, target: f64) -> f64 {
        let are_positive = self.entropy > 0.0 && target > 0.0;
        if are_positive {
            -(self.entropy / self.heat_capacity) * Scalar::ln(self.entropy / target)
        } else {
            self.newton()
        }
    }

    /// Whether the logarithmic model is nearer than the linear one to the entropy found after a step from here.
    fn is_logarithmic(&self, step: f64, entropy: f64) -> bool {
        let growth = self.heat_capacity * step;
        let linear = self.entropy + growth - entropy;
        let logarithmic = self.entropy * Scalar::exp(growth / self.entropy) - entropy;
        logarithmic.abs() < linear.abs()
    }

    /// The distance in `x` that two temperatures must have to be different.
    fn resolution(&self) -> f64 {
        RESOLUTION * f64::EPSILON * Scalar::maximum(self.x.abs(), 1.0)
    }
}

/// The state of the search.
struct Search {
    target: f64,
    /// The current point.
    point: Point,
    /// The point of smallest |residual|.
    best: Point,
    /// Largest `x` with a negative and smallest with a positive residual.
    below: Option<f64>,
    above: Option<f64>,
    /// The ends of the range that may be stable.
    edges: [f64; 2],
    /// The largest step while the solution is not bracketed.
    reach: f64,
    /// The last two steps, infinite at first.
    last: f64,
    last_but_one: f64,
    /// Whether `ln S` (a power of the temperature) predicted the current point better than `S` (constant heat capacity)
    /// as a linear function of `ln θ`.
    is_logarithmic: bool,
    /// Whether the last step was that of a model inside the bracket.
    modelled: bool,
    /// How many steps of a model inside the bracket made the residual larger,
    /// and how many bisections are still due for the last of them.
    failures: u32,
    bisections_due: u32,
    evaluations: usize,
}

/// The temperature of an entropy. The entropy is a `dyn` function, so that this is compiled once for all materials; such a call costs
/// little beside what it evaluates.
#[cold]
pub(super) fn search_from(
    evaluate: &mut dyn FnMut(f64) -> Caloric<f64>,
    entropy: f64,
    start: f64,
) -> Result<f64, InversionError> {
    if !entropy.is_finite() {
        return Err(InversionError::EntropyNotFinite { entropy });
    }
    let first = Point::new(Scalar::ln(start), start, evaluate(start), entropy);
    if !first.is_stable() {
        return Err(InversionError::UnstableStart {
            start,
            heat_capacity: first.heat_capacity,
        });
    }
    let mut search = Search::new(entropy, first);
    while !search.has_converged() {
        let mut step = search.step();
        loop {
            if search.evaluations >= BUDGET || search.is_exhausted() {
                return search.conclude();
            }
            let x = search.point.x + step;
            let theta = Scalar::exp(x);
            let trial = Point::new(x, theta, evaluate(theta), entropy);
            search.evaluations += 1;
            if trial.is_stable() && trial.follows(&search.point) {
                search.accept(trial, step);
                break;
            }
            search.exclude(x);
            step *= 0.5;
        }
    }
    // One more correction, which needs no evaluation.
    Ok(search.point.theta * Scalar::exp(search.point.last_correction()))
}

impl Search {
    /// Starts from a stable point.
    fn new(target: f64, first: Point) -> Self {
        // ln of the largest number, less 2, so that θ and 1/θ are normal numbers.
        let widest = Scalar::ln(f64::MAX) - 2.0;
        let is_above = LARGE_FACTOR * target < first.entropy;
        let is_below = LARGE_FACTOR * first.entropy < target;
        let mut search = Self {
            target,
            point: first,
            best: first,
            below: None,
            above: None,
            edges: [
                Scalar::minimum(-widest, first.x - 1.0),
                Scalar::maximum(widest, first.x + 1.0),
            ],
            reach: 1.0,
            last: f64::INFINITY,
            last_but_one: f64::INFINITY,
            is_logarithmic: is_above || is_below,
            modelled: false,
            failures: 0,
            bisections_due: 0,
            evaluations: 1,
        };
        search.narrow();
        search
    }

    /// Moves the end of the bracket on the side of the current point.
    fn narrow(&mut self) {
        if self.point.residual < 0.0 {
            self.below = Some(self.point.x);
        } else {
            self.above = Some(self.point.x);
        }
        let own = self.point.residual.abs();
        if own < self.best.residual.abs() {
            self.best = self.point;
        }
    }

    /// Makes a stable trial the current point.
    fn accept(&mut self, trial: Point, step: f64) {
        self.is_logarithmic = self.point.is_logarithmic(step, trial.entropy);
        let own = self.point.residual.abs();
        if self.modelled && own < trial.residual.abs() {
            self.failures += 1;
            self.bisections_due = self.failures;
        }
        self.last_but_one = self.last;
        self.last = step.abs();
        self.point = trial;
        self.narrow();
    }

    /// Notes that `x` is beyond a spinodal, and drops points farther off, which belong to another branch.
    fn exclude(&mut self, x: f64) {
        if x < self.point.x {
            self.edges[0] = x;
            self.below = self.below.filter(|&below| x < below);
        } else {
            self.edges[1] = x;
            self.above = self.above.filter(|&above| above < x);
        }
        let best = self.best.x;
        if best < self.edges[0] || self.edges[1] < best {
            self.best = self.point;
        }
    }

    /// The residual is rounding noise, or Newton's correction below the resolution.
    fn has_converged(&self) -> bool {
        let Point {
            residual, noise, ..
        } = self.point;
        let size = self.point.newton().abs();
        residual.abs() <= noise || size <= self.point.resolution()
    }

    /// There is no number left between the bounds.
    fn is_exhausted(&self) -> bool {
        let [low, high] = self.edges;
        let low = self.below.map_or(low, |x| Scalar::maximum(x, low));
        let high = self.above.map_or(high, |x| Scalar::minimum(x, high));
        high - low <= self.point.resolution()
    }

    /// The next step from the current point. One that would leave the stable range goes half way to its end instead.
    fn step(&mut self) -> f64 {
        let linear = self.point.newton();
        let logarithmic = self.point.logarithmic_newton(self.target);
        let [first, second] = if self.is_logarithmic {
            [logarithmic, linear]
        } else {
            [linear, logarithmic]
        };
        let step = if let (Some(below), Some(above)) = (self.below, self.above) {
            self.bracketed([first, second], [below, above])
        } else {
            self.unbracketed(first, second)
        };
        let x = self.point.x;
        let [low, high] = self.edges;
        if high <= x + step {
            0.5 * (high - x)
        } else if x + step <= low {
            0.5 * (low - x)
        } else {
            step
        }
    }

    /// A step with the solution between two known points.
    fn bracketed(&mut self, proposals: [f64; 2], [below, above]: [f64; 2]) -> f64 {
        let x = self.point.x;
        let limit = 0.5 * self.last_but_one;
        if self.bisections_due == 0 {
            self.modelled = true;
            let usable = proposals.into_iter().find(|&step| {
                let is_inside = below < x + step && x + step < above;
                is_inside && step.abs() <= limit
            });
            if let Some(step) = usable {
                return step;
            }
        }
        self.modelled = false;
        self.bisections_due = self.bisections_due.saturating_sub(1);
        0.5 * (below + above) - x
    }

    /// A step that looks for the other end of the bracket.
    fn unbracketed(&mut self, first: f64, second: f64) -> f64 {
        let size = first.abs();
        // Newton's method should halve its steps within two.
        let is_slow = 0.5 * self.last_but_one < size;
        let is_long = 0.5 * self.last < size;
        let length = if self.reach < size {
            self.reach
        } else if is_slow || is_long {
            let longer = Scalar::maximum(size, Scalar::minimum(second.abs(), self.reach));
            if is_slow {
                Scalar::maximum(longer, self.reach)
            } else {
                longer
            }
        } else {
            return first;
        };
        if self.reach <= length {
            self.reach *= 2.0;
        }
        if first < 0.0 { -length } else { length }
    }

    /// The result when the bounds have met: the best point, or that there is no solution.
    fn conclude(&self) -> Result<f64, InversionError> {
        let is_exhausted = self.is_exhausted();
        if is_exhausted && self.below.is_some() && self.above.is_some() {
            return Ok(self.best.theta);
        }
        let entropy = self.target;
        let temperature = self.best.theta;
        let residual = self.best.residual;
        let evaluations = self.evaluations;
        Err(if is_exhausted {
            InversionError::NoSuchTemperature {
                entropy,
                temperature,
                residual,
                evaluations,
            }
        } else {
            InversionError::TooManyEvaluations {
                entropy,
                temperature,
                residual,
                evaluations,
            }
        })
    }
}

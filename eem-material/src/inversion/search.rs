//! The search for the temperature of an entropy from a start that is not known to be close.
//!
//! Every step either reduces the residual as fast as Newton's method should, or halves an interval. Written for scalar
//! numbers: masks are one `bool`.

use super::error::InversionError;
use crate::free_energy::Caloric;
use crate::number::scalar::{Mask, Real};

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
struct Point<S> {
    /// `ln θ`.
    x: S,
    theta: S,
    /// `C = dS/dx`.
    heat_capacity: S,
    /// `S − s`.
    residual: S,
    entropy: S,
    /// The part of the residual that may be rounding.
    noise: S,
}

impl<S: Real> Point<S> {
    /// The point at `θ = eˣ` of a search for the entropy `target`.
    fn new(x: S, theta: S, caloric: Caloric<S>, target: S) -> Self {
        Self {
            x,
            theta,
            entropy: caloric.entropy,
            heat_capacity: caloric.heat_capacity,
            residual: caloric.entropy - target,
            noise: S::from_f64(NOISE) * S::EPSILON * caloric.magnitude,
        }
    }

    /// On a stable branch: `0 < C < ∞` and `S` finite.
    fn is_stable(&self) -> bool {
        S::zero().less(self.heat_capacity).all()
            && self.heat_capacity.is_finite()
            && self.residual.is_finite()
    }

    /// The entropy has increased with the temperature since `other`, as on one stable branch.
    fn follows(&self, other: &Self) -> bool {
        let increase = self.residual - other.residual;
        let noise = other.noise + self.noise;
        if self.x.less(other.x).all() {
            increase.at_most(noise).all()
        } else {
            (-noise).at_most(increase).all()
        }
    }

    /// Newton's correction of `x`.
    fn newton(&self) -> S {
        -self.residual / self.heat_capacity
    }

    /// Newton's correction of a converged point; zero where it would itself be noise: next to a spinodal, where it could
    /// lead beyond, or with nearly no capacity.
    fn last_correction(&self) -> S {
        let correction = self.newton();
        let magnitude = self.noise / (S::from_f64(NOISE) * S::EPSILON);
        let trusted = S::from_f64(TRUST) * self.heat_capacity / magnitude;
        let is_sound = correction.abs().at_most(trusted.maximum(self.resolution()));
        S::select(is_sound, correction, S::zero())
    }

    /// Newton's correction for `ln S`, exact for `S ∝ θⁿ`; unless both entropies are positive, that for `S`.
    fn logarithmic_newton(&self, target: S) -> S {
        let are_positive = S::zero().less(self.entropy) & S::zero().less(target);
        if are_positive.all() {
            -(self.entropy / self.heat_capacity) * (self.entropy / target).ln()
        } else {
            self.newton()
        }
    }

    /// Whether the logarithmic model is nearer than the linear one to the entropy found after a step from here.
    fn is_logarithmic(&self, step: S, entropy: S) -> bool {
        let growth = self.heat_capacity * step;
        let linear = self.entropy + growth - entropy;
        let logarithmic = self.entropy * (growth / self.entropy).exp() - entropy;
        logarithmic.abs().less(linear.abs()).all()
    }

    /// The distance in `x` that two temperatures must have to be different.
    fn resolution(&self) -> S {
        S::from_f64(RESOLUTION) * S::EPSILON * self.x.abs().maximum(S::one())
    }
}

/// The state of the search.
struct Search<S> {
    target: S,
    /// The current point.
    point: Point<S>,
    /// The point of smallest |residual|.
    best: Point<S>,
    /// Largest `x` with a negative and smallest with a positive residual.
    below: Option<S>,
    above: Option<S>,
    /// The ends of the range that may be stable.
    edges: [S; 2],
    /// The largest step while the solution is not bracketed.
    reach: S,
    /// The last two steps, infinite at first.
    last: S,
    last_but_one: S,
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

/// The temperature of an entropy, for a scalar number.
#[cold]
pub(super) fn search_from<S: Real>(
    mut evaluate: impl FnMut(S) -> Caloric<S>,
    entropy: S,
    start: S,
) -> Result<S, InversionError> {
    if !entropy.is_finite() {
        return Err(InversionError::EntropyNotFinite {
            entropy: entropy.to_f64(),
        });
    }
    let first = Point::new(start.ln(), start, evaluate(start), entropy);
    if !first.is_stable() {
        return Err(InversionError::UnstableStart {
            start: start.to_f64(),
            heat_capacity: first.heat_capacity.to_f64(),
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
            let theta = x.exp();
            let trial = Point::new(x, theta, evaluate(theta), entropy);
            search.evaluations += 1;
            if trial.is_stable() && trial.follows(&search.point) {
                search.accept(trial, step);
                break;
            }
            search.exclude(x);
            step *= S::from_f64(0.5);
        }
    }
    // One more correction, which needs no evaluation.
    Ok(search.point.theta * search.point.last_correction().exp())
}

impl<S: Real> Search<S> {
    /// Starts from a stable point.
    fn new(target: S, first: Point<S>) -> Self {
        let infinity = S::one() / S::zero();
        // ln of the largest number, less 2, so that θ and 1/θ are normal numbers.
        let widest = S::MAX.ln() - S::from_f64(2.0);
        let large = S::from_f64(LARGE_FACTOR);
        let [is_above, is_below] = [
            (large * target).less(first.entropy),
            (large * first.entropy).less(target),
        ];
        let mut search = Self {
            target,
            point: first,
            best: first,
            below: None,
            above: None,
            edges: [
                (-widest).minimum(first.x - S::one()),
                widest.maximum(first.x + S::one()),
            ],
            reach: S::one(),
            last: infinity,
            last_but_one: infinity,
            is_logarithmic: (is_above | is_below).all(),
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
        if self.point.residual.less(S::zero()).all() {
            self.below = Some(self.point.x);
        } else {
            self.above = Some(self.point.x);
        }
        let own = self.point.residual.abs();
        if own.less(self.best.residual.abs()).all() {
            self.best = self.point;
        }
    }

    /// Makes a stable trial the current point.
    fn accept(&mut self, trial: Point<S>, step: S) {
        self.is_logarithmic = self.point.is_logarithmic(step, trial.entropy);
        let own = self.point.residual.abs();
        if self.modelled && own.less(trial.residual.abs()).all() {
            self.failures += 1;
            self.bisections_due = self.failures;
        }
        self.last_but_one = self.last;
        self.last = step.abs();
        self.point = trial;
        self.narrow();
    }

    /// Notes that `x` is beyond a spinodal, and drops points farther off, which belong to another branch.
    fn exclude(&mut self, x: S) {
        if x.less(self.point.x).all() {
            self.edges[0] = x;
            self.below = self.below.filter(|&below| x.less(below).all());
        } else {
            self.edges[1] = x;
            self.above = self.above.filter(|&above| above.less(x).all());
        }
        let best = self.best.x;
        if (best.less(self.edges[0]) | self.edges[1].less(best)).all() {
            self.best = self.point;
        }
    }

    /// The residual is rounding noise, or Newton's correction below the resolution.
    fn has_converged(&self) -> bool {
        let Point {
            residual, noise, ..
        } = self.point;
        let size = self.point.newton().abs();
        residual.abs().at_most(noise).all() || size.at_most(self.point.resolution()).all()
    }

    /// There is no number left between the bounds.
    fn is_exhausted(&self) -> bool {
        let [low, high] = self.edges;
        let low = self.below.map_or(low, |x| x.maximum(low));
        let high = self.above.map_or(high, |x| x.minimum(high));
        (high - low).at_most(self.point.resolution()).all()
    }

    /// The next step from the current point. One that would leave the stable range goes half way to its end instead.
    fn step(&mut self) -> S {
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
        let (x, half) = (self.point.x, S::from_f64(0.5));
        let [low, high] = self.edges;
        if high.at_most(x + step).all() {
            half * (high - x)
        } else if (x + step).at_most(low).all() {
            half * (low - x)
        } else {
            step
        }
    }

    /// A step with the solution between two known points.
    fn bracketed(&mut self, proposals: [S; 2], [below, above]: [S; 2]) -> S {
        let (x, half) = (self.point.x, S::from_f64(0.5));
        let limit = half * self.last_but_one;
        if self.bisections_due == 0 {
            self.modelled = true;
            let usable = proposals.into_iter().find(|&step| {
                let is_inside = below.less(x + step) & (x + step).less(above);
                (is_inside & step.abs().at_most(limit)).all()
            });
            if let Some(step) = usable {
                return step;
            }
        }
        self.modelled = false;
        self.bisections_due = self.bisections_due.saturating_sub(1);
        half * (below + above) - x
    }

    /// A step that looks for the other end of the bracket.
    fn unbracketed(&mut self, first: S, second: S) -> S {
        let (size, half) = (first.abs(), S::from_f64(0.5));
        // Newton's method should halve its steps within two.
        let is_slow = (half * self.last_but_one).less(size).all();
        let is_long = (half * self.last).less(size).all();
        let length = if self.reach.less(size).all() {
            self.reach
        } else if is_slow || is_long {
            let longer = size.maximum(second.abs().minimum(self.reach));
            if is_slow {
                longer.maximum(self.reach)
            } else {
                longer
            }
        } else {
            return first;
        };
        if self.reach.at_most(length).all() {
            self.reach *= S::from_f64(2.0);
        }
        S::select(first.less(S::zero()), -length, length)
    }

    /// The result when the bounds have met: the best point, or that there is no solution.
    fn conclude(&self) -> Result<S, InversionError> {
        let is_exhausted = self.is_exhausted();
        if is_exhausted && self.below.is_some() && self.above.is_some() {
            return Ok(self.best.theta);
        }
        let entropy = self.target.to_f64();
        let temperature = self.best.theta.to_f64();
        let residual = self.best.residual.to_f64();
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

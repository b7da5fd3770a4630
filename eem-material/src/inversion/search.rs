//! The intervals that enclose the temperature, and the choice of the next step.
//!
//! Every step either reduces the residual as fast as Newton's method should, or
//! halves an interval. It is for a single number: masks are one `bool`.

use super::error::InversionError;
use super::point::{Model, Point};
use crate::free_energy::Caloric;
use crate::number::scalar::{Mask, Real};

/// Evaluations after which [`invert`](crate::invert) gives up: twice what bisection of the
/// whole range of `ln θ` to the last bit would take.
const BUDGET: usize = 128;

/// What is known about the solution.
struct Search<S> {
    target: S,
    /// The current point.
    point: Point<S>,
    /// The point of smallest |residual|.
    best: Point<S>,
    /// Largest `x` with a negative and smallest with a positive residual.
    below: Option<S>,
    above: Option<S>,
    /// The ends of what may be stable.
    edge_low: S,
    edge_high: S,
    /// How far an unbracketed step may go.
    reach: S,
    /// The last two steps, infinite at first.
    last: S,
    last_but_one: S,
    /// Which of the two models of `S` foretold the current point better.
    model: Model,
    /// Whether the last step was that of a model inside the bracket.
    modelled: bool,
    /// How many such steps made the residual larger, and how many bisections
    /// are still due for the last of them.
    failures: u32,
    bisections_due: u32,
    evaluations: usize,
}

/// The search from a start that is not known to be close, for a single number.
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
    if !first.stable() {
        return Err(InversionError::UnstableStart {
            start: start.to_f64(),
            heat_capacity: first.heat_capacity.to_f64(),
        });
    }
    let mut search = Search::new(entropy, first);
    while !search.converged() {
        let mut step = search.step();
        loop {
            if search.spent() {
                return search.conclude();
            }
            let x = search.point.x + step;
            let theta = x.exp();
            let trial = Point::new(x, theta, evaluate(theta), entropy);
            search.evaluations += 1;
            if trial.stable() && trial.follows(&search.point) {
                search.accept(trial, step);
                break;
            }
            search.exclude(x);
            step *= S::from_f64(0.5);
        }
    }
    Ok(search.solution())
}

impl<S: Real> Search<S> {
    /// Starts from a stable point.
    fn new(target: S, first: Point<S>) -> Self {
        let infinity = S::one() / S::zero();
        // All normal numbers with normal reciprocals, but for a factor e².
        let widest = S::MAX.ln() - S::from_f64(2.0);
        let mut search = Self {
            target,
            point: first,
            best: first,
            below: None,
            above: None,
            edge_low: (-widest).minimum(first.x - S::one()),
            edge_high: widest.maximum(first.x + S::one()),
            reach: S::one(),
            last: infinity,
            last_but_one: infinity,
            model: first.first_model(target),
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
        self.model = self.point.better_model(step, trial.entropy);
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

    /// Notes that `x` is beyond a spinodal, and forgets what lies farther off:
    /// it belongs to another branch.
    fn exclude(&mut self, x: S) {
        if x.less(self.point.x).all() {
            self.edge_low = x;
            self.below = self.below.filter(|&below| x.less(below).all());
        } else {
            self.edge_high = x;
            self.above = self.above.filter(|&above| above.less(x).all());
        }
        let best = self.best.x;
        if (best.less(self.edge_low) | self.edge_high.less(best)).all() {
            self.best = self.point;
        }
    }

    /// The lower bound of the solution.
    fn low(&self) -> S {
        self.below
            .map_or(self.edge_low, |x| x.maximum(self.edge_low))
    }

    /// The upper bound of the solution.
    fn high(&self) -> S {
        self.above
            .map_or(self.edge_high, |x| x.minimum(self.edge_high))
    }

    /// The residual is rounding noise, or what it asks for is below the resolution.
    fn converged(&self) -> bool {
        let size = self.point.newton().abs();
        self.point.is_noise() || size.at_most(self.point.resolution()).all()
    }

    /// The search must end without convergence.
    fn spent(&self) -> bool {
        self.evaluations >= BUDGET || self.exhausted()
    }

    /// There is no number left between the bounds.
    fn exhausted(&self) -> bool {
        let width = self.high() - self.low();
        width.at_most(self.point.resolution()).all()
    }

    /// The current point after one more correction, which needs no evaluation.
    fn solution(&self) -> S {
        self.point.theta * self.point.last_correction().exp()
    }

    /// The next step from the current point.
    fn step(&mut self) -> S {
        let linear = self.point.newton();
        let logarithmic = self.point.logarithmic_newton(self.target).unwrap_or(linear);
        let (first, second) = match self.model {
            Model::Linear => (linear, logarithmic),
            Model::Logarithmic => (logarithmic, linear),
        };
        let step = if let (Some(below), Some(above)) = (self.below, self.above) {
            self.bracketed(first, second, below, above)
        } else {
            self.unbracketed(first, second)
        };
        self.inside_edges(step)
    }

    /// A step that does not shrink to half of the one before the last is too slow.
    fn slow(&self, step: S) -> bool {
        (S::from_f64(0.5) * self.last_but_one)
            .less(step.abs())
            .all()
    }

    /// A step with the solution between two known points.
    fn bracketed(&mut self, first: S, second: S, below: S, above: S) -> S {
        let (x, limit) = (self.point.x, S::from_f64(0.5) * self.last_but_one);
        let usable = |step: S| {
            let is_inside = below.less(x + step) & (x + step).less(above);
            (is_inside & step.abs().at_most(limit)).all()
        };
        if self.bisections_due == 0 {
            self.modelled = true;
            if usable(first) {
                return first;
            }
            if usable(second) {
                return second;
            }
        }
        self.modelled = false;
        self.bisections_due = self.bisections_due.saturating_sub(1);
        S::from_f64(0.5) * (below + above) - x
    }

    /// A step that looks for the other end of the bracket.
    fn unbracketed(&mut self, first: S, second: S) -> S {
        let size = first.abs();
        let slow = self.slow(first);
        let is_long = (S::from_f64(0.5) * self.last).less(size).all();
        let length = if self.reach.less(size).all() {
            self.reach
        } else if slow || is_long {
            let longer = size.maximum(second.abs().minimum(self.reach));
            if slow {
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

    /// A step that would leave the stable range goes half way to its end instead.
    fn inside_edges(&self, step: S) -> S {
        let x = self.point.x + step;
        let half = S::from_f64(0.5);
        if self.edge_high.at_most(x).all() {
            half * (self.edge_high - self.point.x)
        } else if x.at_most(self.edge_low).all() {
            half * (self.edge_low - self.point.x)
        } else {
            step
        }
    }

    /// The result when the bounds have met: the best point, or that there is no solution.
    fn conclude(&self) -> Result<S, InversionError> {
        let entropy = self.target.to_f64();
        let temperature = self.best.theta.to_f64();
        let residual = self.best.residual.to_f64();
        let evaluations = self.evaluations;
        if !self.exhausted() {
            return Err(InversionError::TooManyEvaluations {
                entropy,
                temperature,
                residual,
                evaluations,
            });
        }
        if self.below.is_some() && self.above.is_some() {
            return Ok(self.best.theta);
        }
        Err(InversionError::NoSuchTemperature {
            entropy,
            temperature,
            residual,
            evaluations,
        })
    }
}

//! Loads that a step under control would pass over, and times at which steps end.

use super::Run;
use super::memory::{Control, Seen};
use crate::element::conjugates::end_weight;
use crate::scene::loads::{ScalarOfTime, SceneLoads, Written, inside, written_scalar};
use crate::step::control::{Accuracy, Controller, LeastScales, Scales, Tolerance};
use crate::step::error::{StepError, StepFailure};
use crate::step::load_rule::LoadRule;
use crate::step::samples::{Grid, MOST};
use crate::step::scheme::Scheme;
use crate::step::timed::TimedLoad;
use eem_material::number::scalar::{Scalar, is_positive};

/// Intervals between samples from the present time to the end of a run. What lasts a hundredth of that time contains two samples
/// or three, one of them not farther from its middle than a fifth of its duration.
const PER_RUN: f64 = 256.0;

/// Intervals between samples in the shortest load.
const PER_LOAD: f64 = 3.0;

/// A step of at most this many intervals needs no samples. A scheme of order 2 evaluates loads last after three quarters of a step,
/// and a load `(1 + cos)/2` that lasts 2.56 intervals and begins there has in the rest `π²/3 (0.5/4/2.56)³/0.5 = 8e-4` of its impulse.
const FEW: f64 = 0.5;

/// Roundings between a time and one at which steps end, in ε: as between the last full step and the end of a run.
const STOP_ROUNDINGS: f64 = 4.0;

impl Run {
    /// The first load that a step of this size would pass over, in a run to the end that `control` knows.
    ///
    /// Functions of time are called in the step only, at times that depend on its start, its size and that end.
    pub(super) fn unseen_load(
        &self,
        control: &mut Control,
        size: f64,
    ) -> Result<Option<TimedLoad>, StepError> {
        let Some(horizon) = control.horizon.filter(|_| self.has_loads) else {
            return Ok(None);
        };
        let of_run = (horizon - self.time()) / PER_RUN;
        let of_load = self.loads.shortest.map(|time| time / PER_LOAD);
        let longest = of_load.map_or(of_run, |of_load| Scalar::minimum(of_load, of_run));
        let has_ovens = !self.loads.ovens.is_empty();
        let is_short = size <= FEW * longest && longest.is_finite();
        if is_short && !has_ovens {
            return Ok(None);
        }
        // The fewest samples if the run has no end.
        let longest = if longest.is_finite() { longest } else { size };
        // The scales of the error of a step that changes nothing.
        let (tolerance, accuracy) = (&control.memory.tolerance, control.accuracy);
        let accurate = (accuracy, size);
        let least = (control.memory.largest_momentum, &self.least);
        let mut lookout = Lookout {
            grid: Grid::new([self.time(), size], longest),
            scales: Scales::new(self.dimension, tolerance, accurate, [&self.state; 2], least),
            tolerance,
            accuracy,
            least: &self.least,
            scheme: self.in_use,
            stops: &self.loads.stops,
            // A shorter step is cheaper than so many samples.
            are_too_many: size > f64::from(MOST) * longest,
            memory: &mut control.seen,
        };
        let passed = if is_short {
            lookout.first_oven(&self.loads.ovens)
        } else {
            lookout.first(&self.loads)
        };
        passed.map_err(|failure| self.failed(size, failure))
    }

    /// The end of the next step that is not later than `end`, s: `end` or an earlier time at which steps end. At the beginning of
    /// a step at such a time, step control and the rates of the explicit scheme start afresh: what they know is from before.
    #[inline]
    pub(super) fn stop_before(&mut self, end: f64) -> f64 {
        if self.loads.stops.is_empty() {
            return end;
        }
        self.next_stop(end)
    }

    /// The same where times are given at which steps end.
    #[cold]
    fn next_stop(&mut self, end: f64) -> f64 {
        let time = self.time();
        let near = |stop: f64| {
            let rounding = STOP_ROUNDINGS * f64::EPSILON;
            (stop - time).abs() <= rounding * time.abs()
        };
        let stops = &self.loads.stops;
        let next = stops.partition_point(|&stop| stop <= time || near(stop));
        let is_at_one = next > 0 && near(stops[next - 1]);
        let stop = stops.get(next).copied();
        if is_at_one {
            if let Some(control) = &mut self.control {
                control.memory.controller = Controller::new();
            }
            self.forget_loads();
        }
        let rounding = STOP_ROUNDINGS * f64::EPSILON * end.abs();
        match stop {
            Some(stop) if stop + rounding < end => stop,
            _ => end,
        }
    }
}

/// How far the temperatures at the ends of steps lag behind by the temperature of an oven in their middle, given `x = κh/c` and by how
/// much that changes in a step. For one that rises linearly by δ a step of `c θ̇ = κ (T − θ)` is off by
///
/// ```text
/// ∫ κ/c exp(−κ(h − t)/c) (t/h − ½) δ dt = (½ (1 + e⁻ˣ) − (1 − e⁻ˣ)/x) δ
/// ```
///
/// of which e⁻ˣ is left after the next one, so that it adds up to `(1/(1 − e⁻ˣ) − 1/x − ½) δ`: to `x δ/12` where x is small.
fn lag(x: f64, change: f64) -> f64 {
    end_weight(x) * change
}

/// What decides whether a step passes over a load.
struct Lookout<'a> {
    grid: Grid,
    tolerance: &'a Tolerance,
    accuracy: Accuracy,
    scales: Scales<'a>,
    least: &'a LeastScales,
    scheme: Scheme,
    /// Times at which steps end, s.
    stops: &'a [f64],
    /// Whether there are more samples than are looked at, so that every load counts as passed over.
    are_too_many: bool,
    memory: &'a mut Seen,
}

impl Lookout<'_> {
    /// The first load that the step passes over.
    fn first(&mut self, loads: &SceneLoads) -> Result<Option<TimedLoad>, StepFailure> {
        for (node, course) in &loads.forces {
            let load = TimedLoad::Force(*node);
            if let Some(of) = course.function()
                && self.passes_over(load, &**of)?
            {
                return Ok(Some(load));
            }
        }
        for rocket in &loads.rockets {
            let load = TimedLoad::Thrust(rocket.line.node);
            if self.passes_over(load, &written_scalar(&rocket.thrust))? {
                return Ok(Some(load));
            }
        }
        for (anchor, course) in &loads.motions {
            let load = TimedLoad::Motion(*anchor);
            if let Some(of) = course.function()
                && self.passes_over(load, &**of)?
            {
                return Ok(Some(load));
            }
        }
        for (element, course) in &loads.temperatures {
            let load = TimedLoad::Temperature(*element);
            if let Some(of) = course.function()
                && self.passes_over(load, &written_scalar(of))?
            {
                return Ok(Some(load));
            }
        }
        self.first_oven(&loads.ovens)
    }

    /// The first of these ovens that the step passes over.
    fn first_oven(
        &mut self,
        ovens: &[(usize, ScalarOfTime)],
    ) -> Result<Option<TimedLoad>, StepFailure> {
        for (index, of) in ovens {
            let load = TimedLoad::Oven(*index);
            if self.passes_over(load, &written_scalar(of))? {
                return Ok(Some(load));
            }
        }
        Ok(None)
    }

    /// Whether the step passes over a load. The impulse of a force that it may miss is the tolerance of the momentum.
    fn passes_over(&mut self, load: TimedLoad, of: Written<'_>) -> Result<bool, StepFailure> {
        if self.are_too_many {
            return Ok(true);
        }
        let (grid, stops) = (&self.grid, self.stops);
        let tolerance = self.tolerance;
        let is_vector = matches!(load, TimedLoad::Force(_) | TimedLoad::Motion(_));
        let is_thermal = matches!(load, TimedLoad::Temperature(_) | TimedLoad::Oven(_));
        let is_valid = if is_thermal {
            is_positive
        } else {
            f64::is_finite
        };
        let of = |time: f64, value: &mut [f64]| {
            let time = inside(stops, grid.span(), time);
            of(time, value);
            match value.iter().position(|&value| !is_valid(value)) {
                Some(axis) => Err(StepFailure::of_load(load, axis, value[axis], time)),
                None => Ok(()),
            }
        };
        let Seen { value, seen } = &mut *self.memory;
        let components = if is_vector { value.len() } else { 1 };
        let mut look = grid.look(&of, &mut value[..components], &mut seen[..components])?;
        let height = match load {
            _ if is_thermal => tolerance.relative * look.first(0) + tolerance.temperature,
            TimedLoad::Motion(_) => self.scales.height(),
            _ => f64::INFINITY,
        };
        if look.misses_height(height) {
            return Ok(true);
        }
        let order = self.accuracy.order_of_halves();
        let (rule, allowed) = match load {
            TimedLoad::Force(node) | TimedLoad::Thrust(node) => (
                LoadRule::of_forces(self.scheme, order),
                self.scales.momentum(node.index),
            ),
            // Times the stiffness, the displacement is a force on a mass.
            TimedLoad::Motion(anchor) => (
                LoadRule::of_motions(self.scheme, order),
                self.scales.displacement(anchor.index),
            ),
            TimedLoad::Temperature(_) => return Ok(false),
            TimedLoad::Oven(index) => {
                // Every scheme takes the temperature of an oven from the middle of a step, whatever its order. An element that
                // exchanges heat with it differs by no more than the mean does, and by what it lags behind.
                look.find_means(&LoadRule::middle(order))?;
                let [_, size] = grid.span();
                let part = if order.is_some() { 0.5 } else { 1.0 };
                let change = part * look.variation(0);
                let lag = lag(part * size * self.least.exchange(index), change);
                return Ok(height < lag || look.differs(None, [size * height, 0.0]));
            }
        };
        if look.misses_impulse(allowed) {
            return Ok(true);
        }
        look.find_means(&rule)?;
        Ok(look.differs(rule.order, [allowed, tolerance.relative]))
    }
}

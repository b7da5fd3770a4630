//! Loads that a step under control would pass over, and times at which steps end.

use super::Simulation;
use super::memory::Control;
use crate::element::conjugates::end_weight;
use crate::scene::loads::{OfTime, ScalarOfTime};
use crate::step::control::{Controller, Scales, Tolerance};
use crate::step::error::{StepError, StepFailure};
use crate::step::load_rule::LoadRule;
use crate::step::samples::{Grid, Look, MOST};
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

/// A load as a function of time.
enum Timed<'a, const D: usize> {
    Vector(TimedLoad, &'a OfTime<D>),
    Scalar(TimedLoad, &'a ScalarOfTime),
}

impl<const D: usize> Simulation<D> {
    /// All loads that are functions of time.
    fn timed_loads(&self) -> impl Iterator<Item = Timed<'_, D>> {
        let loads = &self.loads;
        let forces = loads.forces.iter().filter_map(|(node, course)| {
            let of = course.function()?;
            Some(Timed::Vector(TimedLoad::Force(*node), of))
        });
        let thrusts = loads.rockets.iter().map(|rocket| {
            let load = TimedLoad::Thrust(rocket.line.node);
            Timed::Scalar(load, &rocket.thrust)
        });
        let motions = loads.motions.iter().filter_map(|(anchor, course)| {
            let of = course.function()?;
            Some(Timed::Vector(TimedLoad::Motion(*anchor), of))
        });
        let temperatures = loads.temperatures.iter().filter_map(|(element, course)| {
            let of = course.function()?;
            Some(Timed::Scalar(TimedLoad::Temperature(*element), of))
        });
        let ovens = loads.ovens.iter();
        let ovens = ovens.map(|(index, of)| Timed::Scalar(TimedLoad::Oven(*index), of));
        forces
            .chain(thrusts)
            .chain(motions)
            .chain(temperatures)
            .chain(ovens)
    }

    /// The first load that a step of this size would pass over, in a run to the end that `control` knows.
    ///
    /// Functions of time are called in the step only, at times that depend on its start, its size and that end.
    pub(super) fn unseen_load(
        &self,
        control: &Control,
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
        let grid = Grid::new([self.time(), size], longest);
        // The scales of the error of a step that changes nothing.
        let (memory, accurate) = (&control.memory, (control.accuracy, size));
        let least = (memory.largest_momentum, &self.least);
        let scales = Scales::new::<D>(&memory.tolerance, accurate, [&self.state; 2], least);
        // A shorter step is cheaper than so many samples.
        let are_too_many = size > f64::from(MOST) * longest;
        for timed in self.timed_loads() {
            let (Timed::Vector(load, _) | Timed::Scalar(load, _)) = timed;
            if is_short && !matches!(load, TimedLoad::Oven(_)) {
                continue;
            }
            let passes = are_too_many || {
                let passes = self.passes_over(&timed, (control, &scales), &grid);
                passes.map_err(|failure| self.failed(size, failure))?
            };
            if passes {
                return Ok(Some(load));
            }
        }
        Ok(None)
    }

    /// Whether a step passes over a load.
    fn passes_over(
        &self,
        timed: &Timed<'_, D>,
        (control, scales): (&Control, &Scales<'_>),
        grid: &Grid,
    ) -> Result<bool, StepFailure> {
        let tolerance = &control.memory.tolerance;
        let inside = |time| self.loads.inside(grid.span(), time);
        match timed {
            Timed::Vector(load, of) => {
                let of = |time| {
                    let time = inside(time);
                    let value: [f64; D] = of(time).into();
                    match value.iter().position(|value| !value.is_finite()) {
                        Some(axis) => Err(StepFailure::of_load(*load, axis, value[axis], time)),
                        None => Ok(value),
                    }
                };
                if let TimedLoad::Motion(anchor) = load {
                    let look = grid.look(of)?;
                    if look.misses_height(scales.height()) {
                        return Ok(true);
                    }
                    // Times the stiffness, the displacement is a force on a mass.
                    let allowed = scales.displacement::<D>(anchor.index);
                    let order = control.accuracy.order_of_halves();
                    let rule = LoadRule::of_motions(self.in_use, order);
                    return passes_over_integral(&look, rule, (allowed, tolerance), (grid, of));
                }
                self.passes_over_force(load, (control, scales), (grid, &of))
            }
            Timed::Scalar(load, of) => {
                let is_force = matches!(load, TimedLoad::Thrust(_));
                let of = |time| {
                    let time = inside(time);
                    let value = of(time);
                    if is_force && value.is_finite() || is_positive(value) {
                        Ok([value])
                    } else {
                        Err(StepFailure::of_load(*load, 0, value, time))
                    }
                };
                if is_force {
                    return self.passes_over_force(load, (control, scales), (grid, &of));
                }
                let look = grid.look(of)?;
                let height = tolerance.relative * look.first[0] + tolerance.temperature;
                if look.misses_height(height) {
                    return Ok(true);
                }
                let TimedLoad::Oven(index) = *load else {
                    return Ok(false);
                };
                // Every scheme takes the temperature of an oven from the middle of a step, whatever its order. An element that
                // exchanges heat with it differs by no more than the mean does, and by what it lags behind.
                let order = control.accuracy.order_of_halves();
                let rule = LoadRule::middle(order);
                let means = grid.means(rule, of)?;
                let rule = LoadRule {
                    order: None,
                    ..rule
                };
                let [_, size] = grid.span();
                let (part, [change]) = (if order.is_some() { 0.5 } else { 1.0 }, look.variation());
                let lag = lag(part * size * self.least.exchange(index), part * change);
                Ok(height < lag || look.differs(means, rule, [size * height, 0.0]))
            }
        }
    }

    /// Whether a step passes over a force or a thrust: the impulse that it may miss is the tolerance of the momentum.
    fn passes_over_force<const N: usize>(
        &self,
        load: &TimedLoad,
        (control, scales): (&Control, &Scales<'_>),
        (grid, of): (&Grid, &impl Fn(f64) -> Result<[f64; N], StepFailure>),
    ) -> Result<bool, StepFailure> {
        let look = grid.look(of)?;
        let (TimedLoad::Force(node) | TimedLoad::Thrust(node)) = load else {
            return Ok(false);
        };
        let impulse = scales.momentum::<D>(node.index);
        let rule = LoadRule::of_forces(self.in_use, control.accuracy.order_of_halves());
        passes_over_integral(
            &look,
            rule,
            (impulse, &control.memory.tolerance),
            (grid, of),
        )
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

/// Whether samples or the rule of a step miss more of the integral of a function of time than allowed.
fn passes_over_integral<const N: usize>(
    look: &Look<N>,
    rule: LoadRule,
    (allowed, tolerance): (f64, &Tolerance),
    (grid, of): (&Grid, impl Fn(f64) -> Result<[f64; N], StepFailure>),
) -> Result<bool, StepFailure> {
    if look.misses_impulse(allowed) {
        return Ok(true);
    }
    let means = grid.means(rule, of)?;
    Ok(look.differs(means, rule, [allowed, tolerance.relative]))
}

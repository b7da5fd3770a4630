//! Loads that a step under control would pass over, and times at which steps end.

use super::Simulation;
use super::memory::Control;
use crate::scene::loads::{OfTime, ScalarOfTime};
use crate::step::control::{Controller, norm};
use crate::step::error::{StepError, StepFailure};
use crate::step::load_rule::LoadRule;
use crate::step::samples::{Grid, MOST};
use crate::step::timed::TimedLoad;
use eem_material::number::scalar::{Mask, Real, is_positive};

/// Intervals between samples from the present time to the end of a run. What lasts a hundredth of that time contains two samples
/// or three, one of them not farther from its middle than a fifth of its duration.
const PER_RUN: f64 = 256.0;

/// Intervals between samples in the shortest load.
const PER_LOAD: f64 = 3.0;

/// A step of at most this many intervals needs no samples: its scheme evaluates loads at times that are as close.
const FEW: f64 = 2.0;

/// Roundings between a time and one at which steps end, in ε: as between the last full step and the end of a run.
const STOP_ROUNDINGS: f64 = 4.0;

/// A load as a function of time.
enum Timed<'a, S: Real, const D: usize> {
    Vector(TimedLoad, &'a OfTime<S, D>),
    Scalar(TimedLoad, &'a ScalarOfTime<S>),
}

impl<const D: usize, S: Real> Simulation<D, S> {
    /// All loads that are functions of time.
    fn timed_loads(&self) -> impl Iterator<Item = Timed<'_, S, D>> {
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
        control: &Control<S>,
        size: S,
    ) -> Result<Option<TimedLoad>, StepError> {
        let Some(horizon) = control.horizon.filter(|_| self.has_loads) else {
            return Ok(None);
        };
        let of_run = (horizon - self.time()) / S::from_f64(PER_RUN);
        let of_load = self.loads.shortest.map(|time| time / S::from_f64(PER_LOAD));
        let longest = of_load.map_or(of_run, |of_load| of_load.minimum(of_run));
        let has_ovens = !self.loads.ovens.is_empty();
        let is_short = size.at_most(S::from_f64(FEW) * longest).all() && longest.is_finite();
        if is_short && !has_ovens {
            return Ok(None);
        }
        // The fewest samples if the run has no end.
        let longest = if longest.is_finite() { longest } else { size };
        let grid = Grid::new([self.time(), size], longest);
        // A shorter step is cheaper than so many samples.
        let are_too_many = (S::from_f64(f64::from(MOST)) * longest).less(size).all();
        for timed in self.timed_loads() {
            let (Timed::Vector(load, _) | Timed::Scalar(load, _)) = timed;
            if is_short && !matches!(load, TimedLoad::Oven(_)) {
                continue;
            }
            let passes = are_too_many || {
                let passes = self.passes_over(&timed, (control, size), &grid);
                passes.map_err(|failure| self.failed(size, failure))?
            };
            if passes {
                return Ok(Some(load));
            }
        }
        Ok(None)
    }

    /// Whether a step of this size passes over a load.
    fn passes_over(
        &self,
        timed: &Timed<'_, S, D>,
        (control, size): (&Control<S>, S),
        grid: &Grid<S>,
    ) -> Result<bool, StepFailure> {
        let tolerance = &control.memory.tolerance;
        let inside = |time| self.loads.inside(grid.span(), time);
        match timed {
            Timed::Vector(load, of) => {
                let of = |time| {
                    let time = inside(time);
                    let value: [S; D] = of(time).into();
                    match value.iter().position(|value| !value.is_finite()) {
                        Some(axis) => Err(load.refuse(axis, value[axis].to_f64(), time.to_f64())),
                        None => Ok(value),
                    }
                };
                if let TimedLoad::Motion(_) = load {
                    let scale = norm(self.state.positions.values().iter().copied());
                    let height = tolerance.relative * scale + tolerance.position;
                    return Ok(grid.look(of)?.misses_height(height));
                }
                self.passes_over_force(load, (control, size), (grid, &of))
            }
            Timed::Scalar(load, of) => {
                let is_force = matches!(load, TimedLoad::Thrust(_));
                let of = |time| {
                    let time = inside(time);
                    let value = of(time);
                    if is_force && value.is_finite() || is_positive(value) {
                        Ok([value])
                    } else {
                        Err(load.refuse(0, value.to_f64(), time.to_f64()))
                    }
                };
                if is_force {
                    return self.passes_over_force(load, (control, size), (grid, &of));
                }
                let look = grid.look(of)?;
                let height = tolerance.relative * look.first[0] + tolerance.temperature;
                if look.misses_height(height) {
                    return Ok(true);
                }
                if let TimedLoad::Temperature(_) = load {
                    return Ok(false);
                }
                // Every scheme takes the temperature of an oven from the middle of a step, whatever its order. An element that
                // exchanges heat with it differs by no more than the mean does.
                let order = control.accuracy.order_of_halves();
                let rule = LoadRule::middle(order);
                let means = grid.means(rule, of)?;
                let rule = LoadRule {
                    order: None,
                    ..rule
                };
                Ok(look.differs(means, rule, [size * height, S::zero()]))
            }
        }
    }

    /// Whether a step of this size passes over a force or a thrust.
    fn passes_over_force<const N: usize>(
        &self,
        load: &TimedLoad,
        (control, size): (&Control<S>, S),
        (grid, of): (&Grid<S>, &impl Fn(S) -> Result<[S; N], StepFailure>),
    ) -> Result<bool, StepFailure> {
        let look = grid.look(of)?;
        let impulse = self.allowed_impulse(load, (control, size));
        if look.misses_impulse(impulse) {
            return Ok(true);
        }
        let rule = LoadRule::of_forces(self.in_use, control.accuracy.order_of_halves());
        let means = grid.means(rule, of)?;
        Ok(look.differs(means, rule, [impulse, control.memory.tolerance.relative]))
    }

    /// The impulse that a step of this size may miss, N s: the tolerance of its momenta.
    ///
    /// A mass that has not moved yet has no momentum to compare with; what moves it in the step by less than the tolerance of
    /// positions has no effect.
    ///
    /// ```text
    /// r' (max |p|₂ + m r |q|₂/h) + a_p r'/r,   r' the relative tolerance of the step
    /// ```
    fn allowed_impulse(&self, load: &TimedLoad, (control, size): (&Control<S>, S)) -> S {
        let (memory, accuracy) = (&control.memory, control.accuracy);
        let tolerance = &memory.tolerance;
        let part = tolerance.over.map_or(S::one(), |time| size / time);
        let of_step = accuracy.of_step(tolerance.relative, part);
        let size_of = |values: &[S]| norm(values.iter().copied());
        let momentum = size_of(self.state.momenta.values()).maximum(memory.largest_momentum);
        let mass = match load {
            TimedLoad::Force(node) | TimedLoad::Thrust(node) => self.masses.get(node.index),
            _ => None,
        };
        let position = tolerance.relative * size_of(self.state.positions.values());
        let unmoved = mass.map_or(S::zero(), |mass| mass * position / size);
        of_step * (momentum + unmoved) + tolerance.momentum * (of_step / tolerance.relative)
    }

    /// The end of the next step that is not later than `end`, s: `end` or an earlier time at which steps end. At the beginning of
    /// a step at such a time, step control and the rates of the explicit scheme start afresh: what they know is from before.
    #[cold]
    pub(super) fn stop_before(&mut self, end: S) -> S {
        let time = self.time();
        let near = |stop: S| {
            let rounding = S::from_f64(STOP_ROUNDINGS) * S::EPSILON;
            (stop - time).abs().at_most(rounding * time.abs()).all()
        };
        let stops = &self.loads.stops;
        let next = stops.partition_point(|&stop| stop.at_most(time).all() || near(stop));
        let is_at_one = next > 0 && near(stops[next - 1]);
        let stop = stops.get(next).copied();
        if is_at_one {
            if let Some(control) = &mut self.control {
                control.memory.controller = Controller::new();
            }
            self.forget_loads();
        }
        let rounding = S::from_f64(STOP_ROUNDINGS) * S::EPSILON * end.abs();
        match stop {
            Some(stop) if (stop + rounding).less(end).all() => stop,
            _ => end,
        }
    }
}

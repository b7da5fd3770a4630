//! The estimate of the error of a step (Hairer, Nørsett & Wanner, section II.10).

use super::demand::Scales;
use super::stages::{errors, unclosed};
use super::vector::{difference, dot, length};
use super::{Explicit, ExplicitView};
use crate::element::state::State;
use crate::step::control::{Step, Tolerance, Unknown, Worst, norm};
use crate::step::error::StepFailure;
use eem_material::number::scalar::Scalar;

/// How often heat may correct the energy in a closing, which has ten iterations.
const MOST_HEATINGS: f64 = 10.0;

impl<const D: usize> Explicit<D> {
    /// Goes to the end of a step before it is closed; returns the magnitudes there.
    pub(super) fn approach(
        &mut self,
        view: &ExplicitView<'_, D>,
        next: &mut State,
    ) -> Result<Scales, StepFailure> {
        self.begin(view, next)?;
        self.go_through_stages(view)?;
        self.scales(view.state.time.value + view.step)
    }

    /// The magnitudes of positions and momenta before the step is closed; an error unless all are finite.
    #[inline]
    fn scales(&self, time: f64) -> Result<Scales, StepFailure> {
        if !time.is_finite() {
            let value = time;
            return Err(StepFailure::Time { value });
        }
        let masses = &self.stage.places[..self.components.masses];
        let mut squares = [0.0; 3];
        for place in masses {
            let parts = [&place.past.start[0], place.q(), place.p()];
            for (square, part) in squares.iter_mut().zip(parts) {
                *square += dot(part, part);
            }
        }
        let mut sizes = squares.map(Scalar::sqrt);
        let is_normal = |sum: &f64| *sum > f64::MIN_POSITIVE && *sum <= f64::MAX;
        if !squares.iter().all(is_normal) {
            self.expect_finite()?;
            sizes = [
                norm(masses.iter().flat_map(|place| place.past.start[0])),
                norm(masses.iter().flat_map(|place| place.now[0])),
                norm(masses.iter().flat_map(|place| place.now[1])),
            ];
        }
        let [start, end, momentum] = sizes;
        Ok(Scales {
            position: Scalar::maximum(start, end),
            momentum: Scalar::maximum(momentum, self.books.largest_momentum),
        })
    }

    #[cold]
    fn expect_finite(&self) -> Result<(), StepFailure> {
        let masses = self.stage.places[..self.components.masses].iter();
        for (place, &node) in masses.zip(&self.components.nodes) {
            for (quantity, vector) in ["position", "momentum"].into_iter().zip(place.now) {
                if let Some(axis) = vector.iter().position(|value| !value.is_finite()) {
                    return Err(StepFailure::Unbounded {
                        node: node as usize,
                        axis,
                        quantity,
                        value: vector[axis],
                    });
                }
            }
        }
        Ok(())
    }

    /// The error of the step in units of the tolerance,
    ///
    /// ```text
    /// e₅²/√(e₅² + 0.01 e₃²),     e = |h Σ E k / scale|₂
    /// ```
    ///
    /// with the scales of a [`Tolerance`]: |q| of all nodes, anchors among them, for positions and viscous stretches, which
    /// does not vanish where no mass moves; the largest |p| so far for momenta, and θ.
    pub(super) fn estimate(
        &self,
        view: &ExplicitView<'_, D>,
        tolerance: &Tolerance,
        scales: Scales,
    ) -> f64 {
        let mut sums = [0.0; 2];
        self.each_error(view, tolerance, scales, |_, errors, per_scale| {
            for (sum, error) in sums.iter_mut().zip(errors) {
                let error = view.step * error * per_scale;
                *sum += error * error;
            }
        });
        let [five, three] = sums;
        if five <= 0.0 {
            return 0.0;
        }
        five / (five + 0.01 * three).sqrt()
    }

    /// The unknown with the largest error in a step, with its error and what the tolerance allows.
    #[cold]
    pub(crate) fn worst_error(
        &mut self,
        view: &ExplicitView<'_, D>,
        tolerance: &Tolerance,
        next: &mut State,
    ) -> Result<Option<(Unknown, [f64; 2])>, StepFailure> {
        let was_ready = self.is_ready;
        let tried = self.approach(view, next);
        // As before the attempt.
        self.is_ready = was_ready;
        let scales = tried?;
        let mut worst = Worst::none();
        self.each_error(view, tolerance, scales, |unknown, [fifth, _], per_scale| {
            worst.see(unknown, [(view.step * fifth).abs(), per_scale.recip()]);
        });
        Ok(worst.found)
    }

    /// By how much the correction of the energy has changed unknowns, in units of the tolerance: of a mass that is nearly at rest,
    /// while a support does work on its spring, a small defect of the energy is a large part of the motion; and that of a stiff
    /// spring is a large part of a weak one in series with a dashpot.
    pub(super) fn moved(
        &mut self,
        view: &ExplicitView<'_, D>,
        tolerance: &Tolerance,
        scales: Scales,
    ) -> f64 {
        let mut largest = 0.0;
        for index in 0..self.scratch.progress.len() {
            let progress = self.scratch.progress[index];
            // No momentum is larger than that of all.
            let is_small = progress.moved <= tolerance.relative
                && MOST_HEATINGS * progress.warmed <= tolerance.relative;
            if progress.is_rigid || is_small && !progress.has_shifted {
                continue;
            }
            let change = self.change_by_closing(index, (view, tolerance), scales);
            let (defect, scale) = (progress.correction * progress.scale, progress.scale);
            let is_change = change > 1.0 && !(defect.abs() <= self.explained(index, scale, view));
            largest = Scalar::maximum(largest, if is_change { change } else { 0.0 });
        }
        largest
    }

    /// The largest change of an unknown of a component by its closing, in units of the tolerance.
    #[cold]
    fn change_by_closing(
        &self,
        index: usize,
        (view, tolerance): (&ExplicitView<'_, D>, &Tolerance),
        scales: Scales,
    ) -> f64 {
        let mut largest = 0.0;
        let mut see = |change: f64, allowed: f64| {
            let has_scale = allowed > 0.0;
            let part = if has_scale { change / allowed } else { 0.0 };
            largest = Scalar::maximum(largest, part);
        };
        let Tolerance { relative, .. } = *tolerance;
        let position = position_size(view, tolerance, scales);
        let position = relative * position + tolerance.position;
        for at in self.components.all[index].masses.clone() {
            let place = &self.stage.places[at];
            let node = self.components.nodes[at] as usize;
            let momentum = momentum_scale(view, tolerance, scales, node);
            let before = unclosed(&place.past, view.step);
            for ((now, before), allowed) in place.now.iter().zip(&before).zip([position, momentum])
            {
                see(length(&difference(now, before)), allowed);
            }
        }
        let change = |at: usize| {
            let [before] = unclosed(&self.stage.inner_past[at / 2], view.step);
            (self.stage.inner[at].now - before[at % 2]).abs()
        };
        for (dashpot, own) in self.components.dashpots.iter().enumerate() {
            if own.component as usize == index {
                see(change(dashpot), position);
            }
        }
        for slot in self.slots_of(index) {
            let slot = self.components.slots[slot] as usize;
            if !self.stage.is_held(slot) {
                let allowed = relative * self.stage.theta(slot) + tolerance.temperature;
                see(change(self.stage.temperatures + slot), allowed);
            }
        }
        largest
    }

    /// Calls `see` with the errors of fifth and third order of every unknown, per time, and the reciprocal of its scale.
    #[inline]
    fn each_error(
        &self,
        view: &ExplicitView<'_, D>,
        tolerance: &Tolerance,
        scales: Scales,
        mut see: impl FnMut(Unknown, [f64; 2], f64),
    ) {
        let per_scale = |size: f64, absolute: f64| {
            let scale = tolerance.relative * size + absolute;
            // Where the scale is zero nothing moves.
            if scale > 0.0 { scale.recip() } else { 0.0 }
        };
        let masses = &self.stage.places[..self.components.masses];
        let least = view.least;
        let position = per_scale(position_size(view, tolerance, scales), tolerance.position);
        let step = step_of(view, tolerance);
        let momentum = per_scale(scales.momentum, tolerance.momentum);
        let are_alike = least.are_below(scales.momentum, step);
        for (place, &node) in masses.iter().zip(&self.components.nodes) {
            let [fifth, third] = errors(&place.past);
            let momentum = if are_alike {
                momentum
            } else {
                let own = least.momentum(node as usize, scales.momentum, step);
                per_scale(own, tolerance.momentum)
            };
            let kinds = [Unknown::Position, Unknown::Momentum];
            for (part, per_scale) in [position, momentum].into_iter().enumerate() {
                for axis in 0..D {
                    let unknown = kinds[part](node as usize * D + axis);
                    see(unknown, [fifth[part][axis], third[part][axis]], per_scale);
                }
            }
        }
        let first = self.stage.temperatures;
        for (pair, past) in self.stage.inner_past.iter().enumerate() {
            let [[fifth], [third]] = errors(past);
            for at in 0..2 {
                let index = 2 * pair + at;
                let (unknown, per_scale) = if index < first {
                    (Unknown::Viscous(index), position)
                } else {
                    let scale = per_scale(past.start[0][at], tolerance.temperature);
                    (Unknown::Temperature(index - first), scale)
                };
                see(unknown, [fifth[at], third[at]], per_scale);
            }
        }
    }
}

/// The magnitude to which errors of positions and viscous stretches are relative.
fn position_size<const D: usize>(
    view: &ExplicitView<'_, D>,
    tolerance: &Tolerance,
    scales: Scales,
) -> f64 {
    let of_all = norm(view.state.positions.values().iter().copied());
    let largest = Scalar::maximum(scales.position, of_all);
    Scalar::maximum(largest, view.least.position(tolerance.relative))
}

/// A step with this tolerance.
fn step_of<const D: usize>(view: &ExplicitView<'_, D>, tolerance: &Tolerance) -> Step {
    Step {
        size: view.step,
        relative: tolerance.relative,
        own: tolerance.relative,
        // Its estimate is careful enough.
        growth: 0.0,
    }
}

/// What the tolerance allows the momentum of a node, kg m/s.
fn momentum_scale<const D: usize>(
    view: &ExplicitView<'_, D>,
    tolerance: &Tolerance,
    scales: Scales,
    node: usize,
) -> f64 {
    let step = step_of(view, tolerance);
    let scale = view.least.momentum(node, scales.momentum, step);
    tolerance.relative * scale + tolerance.momentum
}

//! The estimate of the error of a step (Hairer, Nørsett & Wanner, section II.10).

use super::accounts::Accounts;
use super::demand::Scales;
use super::stages::{errors, unclosed};
use super::{Explicit, ExplicitView};
use crate::algebra::{difference, dot, hypot, length, norm};
use crate::element::group::Place;
use crate::element::state::State;
use crate::step::control::{
    LoadRounding, ROUNDINGS, Step, Tolerance, Unknown, UnknownError, see_worst,
};
use crate::step::error::StepFailure;
use crate::step::scheme::Scheme;
use eem_material::number::scalar::Scalar;

/// How often heat may correct the energy in a closing, which has ten iterations.
const MOST_HEATINGS: f64 = 10.0;

/// The reciprocal of a scale; zero where the scale is, as nothing moves there.
#[inline]
fn per(scale: f64) -> f64 {
    if scale > 0.0 { scale.recip() } else { 0.0 }
}

/// The reciprocal of a scale that is no smaller than the rounding, and the rounding.
#[inline]
fn rounded(per_scale: f64, rounding: f64) -> [f64; 2] {
    let is_below = per_scale * rounding > 1.0;
    let per_scale = if is_below {
        rounding.recip()
    } else {
        per_scale
    };
    [per_scale, rounding]
}

/// Adds the squares of errors per time in units of their scales in a step of the size h.
#[inline]
fn squares(h: f64, sums: &mut [f64; 2]) -> impl FnMut(Unknown, [f64; 2], [f64; 2]) {
    move |_, errors, [per_scale, _]| {
        for (sum, error) in sums.iter_mut().zip(errors) {
            let error = h * error * per_scale;
            *sum += error * error;
        }
    }
}

impl Accounts {
    /// The same as [`Explicit::each_error`] for the internal variables, given the scale and the rounding of stretches.
    #[inline]
    fn each_error<const ROUNDED: bool>(
        &self,
        (tolerance, stretch): (&Tolerance, [f64; 2]),
        rounding: &LoadRounding,
        see: &mut (impl FnMut(Unknown, [f64; 2], [f64; 2]) + ?Sized),
    ) {
        let first = self.stage.temperatures;
        for (pair, past) in self.stage.inner_past.iter().enumerate() {
            let [fifth, third] = errors(past);
            for at in 0..2 {
                let index = 2 * pair + at;
                let (unknown, per_scale) = if index < first {
                    (Unknown::Viscous(index), stretch)
                } else {
                    let slot = index - first;
                    let theta = past.start[at][0];
                    let mut scale = [per(tolerance.relative * theta + tolerance.temperature), 0.0];
                    if ROUNDED {
                        scale = rounded(scale[0], rounding.temperature(slot));
                    }
                    (Unknown::Temperature(slot), scale)
                };
                see(unknown, [fifth[at][0], third[at][0]], per_scale);
            }
        }
    }
}

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
        let masses = &self.places[..self.components.masses];
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
            let parts: [fn(&Place<D>) -> &[f64; D]; 3] =
                [|place| &place.past.start[0], Place::q, Place::p];
            for (size, part) in sizes.iter_mut().zip(parts) {
                let numbers = 0..masses.len() * D;
                *size = norm(numbers.map(|at| part(&masses[at / D])[at % D]));
            }
        }
        let [start, end, momentum] = sizes;
        Ok(Scales {
            position: Scalar::maximum(start, end),
            momentum: Scalar::maximum(momentum, self.books.largest_momentum),
        })
    }

    #[cold]
    fn expect_finite(&self) -> Result<(), StepFailure> {
        let masses = self.places[..self.components.masses].iter();
        for (place, &node) in masses.zip(&self.components.nodes) {
            for (at, &value) in place.now.as_flattened().iter().enumerate() {
                if !value.is_finite() {
                    return Err(StepFailure::Unbounded {
                        node,
                        axis: at % D,
                        quantity: ["position", "momentum"][at / D],
                        value,
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
    /// with the scales of a [`Tolerance`]: |q| of all nodes, anchors among them, for positions; |λ| of the springs with dashpots for
    /// viscous stretches, the largest |p| so far for momenta, and θ. What rounding explains of each e₅ is none; that is found only
    /// where it could make the next step longer.
    pub(super) fn estimate(&mut self, by: &Measure<'_, D>) -> f64 {
        let mut sums = [0.0; 2];
        let h = by.view.step;
        self.each_error::<false>(by, &mut squares(h, &mut sums));
        let error = estimate_of(sums);
        if !Scheme::EemExplicit.accuracy().holds_back(error) {
            return error;
        }
        self.find_rounding(by.view);
        let may_explain =
            !self.rounding.is_none() || ROUNDING_SHARE * error < self.most_rounding(by);
        if may_explain {
            self.estimate_beyond_rounding(by)
        } else {
            error
        }
    }

    #[cold]
    fn estimate_beyond_rounding(&self, by: &Measure<'_, D>) -> f64 {
        let Measure {
            view, tolerance, ..
        } = *by;
        let mut sums = [0.0; 2];
        let mut see = |_, [fifth, third]: [f64; 2], [per_scale, rounding]: [f64; 2]| {
            let fifth = view.step * fifth;
            let beyond = Scalar::maximum(fifth.abs() - rounding, 0.0) * per_scale;
            let third = view.step * third * per_scale;
            sums[0] += beyond * beyond;
            sums[1] += third * third;
        };
        self.each_error::<true>(by, &mut see as See<'_>);
        let beyond = Scalar::maximum(estimate_of(sums), HIDDEN);
        let masses = &self.places[..self.components.masses];
        for (place, &node) in masses.iter().zip(&self.components.nodes) {
            let [position, momentum] = &place.past.start;
            let positions = [&position[..], place.q()];
            let momenta = [&momentum[..], place.p()];
            if !view.least.is_at_rest(node, positions, momenta) {
                let accurate = (tolerance.relative, Scheme::EemExplicit.accuracy());
                return view.least.hidden(beyond, view.step, accurate);
            }
        }
        beyond
    }

    /// At least what rounding of positions changes in the estimate.
    fn most_rounding(&self, by: &Measure<'_, D>) -> f64 {
        let distance = by.farthest();
        let impulse = by.view.least.most().rounding(by.view.step, distance);
        let momentum = by.tolerance.relative * by.scales.momentum + by.tolerance.momentum;
        let count = self.components.masses * D + self.stage.temperatures;
        #[expect(clippy::cast_precision_loss, reason = "a count of far less than 2⁵³")]
        let all = (count as f64).sqrt();
        let mut sum = 0.0;
        for (rounding, scale) in [
            (impulse, momentum),
            (rounding_of_stretch(distance), by.stretch()),
        ] {
            sum += if scale > 0.0 { rounding / scale } else { 0.0 };
        }
        all * sum
    }

    /// Finds the rounding of the loads of a step.
    pub(super) fn find_rounding(&mut self, view: &ExplicitView<'_, D>) {
        if !self.rounding.is_none() {
            let span = [view.state.time.value, view.step];
            self.rounding.find(view.loads, view.least, span);
        }
    }

    /// The unknown with the largest error in a step, with its error and what the tolerance allows.
    #[cold]
    pub(crate) fn worst_error(
        &mut self,
        view: &ExplicitView<'_, D>,
        tolerance: &Tolerance,
        next: &mut State,
    ) -> Result<Option<UnknownError>, StepFailure> {
        let was_ready = self.is_ready;
        let tried = self.approach(view, next);
        // As before the attempt.
        self.is_ready = was_ready;
        let scales = tried?;
        self.find_rounding(view);
        let by = Measure {
            view,
            tolerance,
            scales,
        };
        let mut worst = None;
        let mut see = |unknown, [fifth, _]: [f64; 2], [per_scale, rounding]: [f64; 2]| {
            let allowed = per_scale.recip() + rounding;
            see_worst(&mut worst, unknown, [(view.step * fifth).abs(), allowed]);
        };
        self.each_error::<true>(&by, &mut see as See<'_>);
        Ok(worst)
    }

    /// By how much the correction of the energy has changed unknowns, in units of the tolerance: of a mass that is nearly at rest,
    /// while a support does work on its spring, a small defect of the energy is a large part of the motion; and that of a stiff
    /// spring is a large part of a weak one in series with a dashpot.
    pub(super) fn moved(&mut self, by: &Measure<'_, D>) -> f64 {
        let relative = by.tolerance.relative;
        let mut largest = 0.0;
        for index in 0..self.scratch.progress.len() {
            let progress = self.scratch.progress[index];
            // No momentum is larger than that of all.
            let is_small =
                progress.moved <= relative && MOST_HEATINGS * progress.warmed <= relative;
            if progress.is_rigid || is_small && !progress.has_shifted {
                continue;
            }
            let change = self.change_by_closing(index, by);
            let (defect, scale) = (progress.correction * progress.scale, progress.scale);
            if change > 1.0 && !(defect.abs() <= self.explained(index, scale, by.view)) {
                largest = Scalar::maximum(largest, change);
            }
        }
        largest
    }

    /// The largest change of an unknown of a component by its closing, in units of the tolerance.
    #[cold]
    fn change_by_closing(&self, index: usize, by: &Measure<'_, D>) -> f64 {
        let mut largest = 0.0;
        let mut see = |change: f64, allowed: f64| {
            let has_scale = allowed > 0.0;
            let part = if has_scale { change / allowed } else { 0.0 };
            largest = Scalar::maximum(largest, part);
        };
        let (view, tolerance) = (by.view, by.tolerance);
        let [position, stretch] = [by.position(), by.stretch()];
        for at in self.components.all[index].masses.clone() {
            let place = &self.places[at];
            let node = self.components.nodes[at];
            let rounding = self.rounding_of(view, place, node);
            let scale = view.least.at(node).scale(by.scales.momentum, by.step());
            let momentum = tolerance.relative * scale + tolerance.momentum;
            let momentum = Scalar::maximum(momentum, rounding);
            let before = unclosed(&place.past, view.step);
            see(hypot(&difference(place.q(), &before[0])), position);
            see(hypot(&difference(place.p(), &before[1])), momentum);
        }
        let change = |at: usize| {
            let before = unclosed(&self.stage.inner_past[at / 2], view.step);
            (self.stage.inner[at] - before[at % 2][0]).abs()
        };
        for dashpot in self.components.dashpots_of(index) {
            see(change(dashpot), stretch);
        }
        for slot in self.slots_of(index) {
            let slot = self.components.slots[slot];
            if !self.stage.is_held(slot) {
                let allowed = tolerance.relative * self.stage.theta(slot) + tolerance.temperature;
                see(change(self.stage.temperatures + slot), allowed);
            }
        }
        largest
    }

    /// Calls `see` with the errors of fifth and third order of every unknown, per time, the reciprocal of its scale and, if
    /// `ROUNDED`, its rounding.
    #[inline]
    fn each_error<const ROUNDED: bool>(
        &self,
        by: &Measure<'_, D>,
        see: &mut (impl FnMut(Unknown, [f64; 2], [f64; 2]) + ?Sized),
    ) {
        let Measure {
            view, tolerance, ..
        } = *by;
        let masses = &self.places[..self.components.masses];
        let least = view.least;
        let (all, step) = (by.scales.momentum, by.step());
        let momentum = |scale: f64| per(tolerance.relative * scale + tolerance.momentum);
        let position = per(by.position());
        let of_all = momentum(all);
        let are_alike = least.most().scale(all, step) <= all;
        for (place, &node) in masses.iter().zip(&self.components.nodes) {
            let [fifth, third] = errors(&place.past);
            let momentum = if are_alike {
                of_all
            } else {
                momentum(least.at(node).scale(all, step))
            };
            let mut per_scales = [[position, 0.0], [momentum, 0.0]];
            if ROUNDED {
                let impulse = self.rounding_of(view, place, node);
                let moved = least.at(node).mobility(view.step) * impulse;
                per_scales = [rounded(position, moved), rounded(momentum, impulse)];
            }
            let kinds = [Unknown::Position, Unknown::Momentum];
            for (part, per_scale) in per_scales.into_iter().enumerate() {
                for axis in 0..D {
                    let unknown = kinds[part](node * D + axis);
                    see(unknown, [fifth[part][axis], third[part][axis]], per_scale);
                }
            }
        }
        let first = self.stage.temperatures;
        let mut stretch = [0.0; 2];
        if first > 0 {
            stretch[0] = per(by.stretch());
            if ROUNDED {
                stretch = rounded(stretch[0], rounding_of_stretch(by.farthest()));
            }
        }
        let scales = (tolerance, stretch);
        self.accounts
            .each_error::<ROUNDED>(scales, &self.rounding, see);
    }

    /// The rounding of the impulse on a mass, N s.
    fn rounding_of(&self, view: &ExplicitView<'_, D>, place: &Place<D>, node: usize) -> f64 {
        let distance = Scalar::maximum(length(&place.past.start[0]), length(place.q()));
        view.least.at(node).rounding(view.step, distance) + self.rounding.at(node).impulse
    }
}

/// A function of an unknown, its errors of fifth and third order, the reciprocal of its scale and its rounding.
type See<'a> = &'a mut dyn FnMut(Unknown, [f64; 2], [f64; 2]);

/// Rounding is looked at where it is more than this part of the error: less would change the size of a step by 1 %.
const ROUNDING_SHARE: f64 = 0.1;

/// An error that rounding explains counts as this one, so that steps grow by a third: what lies below is not seen before they are
/// too long.
const HIDDEN: f64 = 1e-4;

/// What errors of a step are measured by.
pub(super) struct Measure<'a, const D: usize> {
    pub(super) view: &'a ExplicitView<'a, D>,
    pub(super) tolerance: &'a Tolerance,
    pub(super) scales: Scales,
}

impl<const D: usize> Measure<'_, D> {
    /// The largest |q| of the step, that of all nodes included, m.
    fn farthest(&self) -> f64 {
        let all = length(self.view.state.positions.values());
        Scalar::maximum(self.scales.position, all)
    }

    /// What the tolerance allows a position, m.
    fn position(&self) -> f64 {
        let least = self.view.least.position(self.tolerance.relative);
        let size = Scalar::maximum(self.farthest(), least);
        self.tolerance.relative * size + self.tolerance.position
    }

    /// What it allows a viscous stretch, m.
    fn stretch(&self) -> f64 {
        let positions = self.view.state.positions.values();
        self.tolerance.relative * self.view.least.stretches(D, positions) + self.tolerance.position
    }

    fn step(&self) -> Step {
        Step {
            size: self.view.step,
            relative: self.tolerance.relative,
            // The estimate is careful enough.
            growth: 0.0,
        }
    }
}

/// The rounding of a viscous stretch whose ends are this far from the origin, m.
fn rounding_of_stretch(distance: f64) -> f64 {
    ROUNDINGS * f64::EPSILON * distance
}

/// `e₅²/√(e₅² + 0.01 e₃²)` from the squares.
fn estimate_of([five, three]: [f64; 2]) -> f64 {
    if five <= 0.0 {
        return 0.0;
    }
    five / (five + 0.01 * three).sqrt()
}

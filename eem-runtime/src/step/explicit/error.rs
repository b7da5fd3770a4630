//! The estimate of the error of a step (Hairer, Nørsett & Wanner, section II.10).

use super::accounts::Accounts;
use super::bodies::{Bodies, Seen};
use super::demand::Scales;
use super::stages::{combined, errors};
use super::tableau::{ERROR_3, ERROR_5, WEIGHTS};
use super::{Explicit, View};
use crate::algebra::{dot, length, norm, vector};
use crate::element::state::State;
use crate::step::control::{ROUNDINGS, Step, Tolerance, Unknown, UnknownError, see_worst};
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

/// Adds the squares of errors per time in units of their scale in a step of the size h.
#[inline]
fn add_squares(sums: &mut [f64; 2], h: f64, errors: [f64; 2], per_scale: f64) {
    for (sum, error) in sums.iter_mut().zip(errors) {
        let error = h * error * per_scale;
        *sum += error * error;
    }
}

impl Accounts {
    /// Adds the squares of the errors of internal variables.
    #[inline]
    fn add_squares(&self, by: &Measure<'_>, sums: &mut [f64; 2]) {
        let first = self.stage.temperatures;
        let stretch = if first > 0 { per(by.stretch()) } else { 0.0 };
        for (pair, past) in self.stage.inner_past.iter().enumerate() {
            let [fifth, third] = errors(past);
            for at in 0..2 {
                let per_scale = if 2 * pair + at < first {
                    stretch
                } else {
                    per(by.temperature(past.start[at][0]))
                };
                add_squares(sums, by.view.step, [fifth[at][0], third[at][0]], per_scale);
            }
        }
    }

    /// Calls `see` with the errors of fifth and third order of every unknown, per time, the reciprocal of its scale and its
    /// rounding.
    fn each_error(&self, bodies: &dyn Bodies, by: &Measure<'_>, see: See<'_>) {
        let (view, d) = (by.view, self.dimension);
        let (all, step) = (by.scales.momentum, by.step());
        let position = per(by.position());
        for at in 0..self.components.masses {
            let (place, node) = (bodies.at(at), self.components.nodes[at]);
            let own = view.least.at(node);
            let momentum = per(by.momentum(own.scale(all, step)));
            let impulse = self.rounding_of(view, &place, node);
            let moved = own.mobility(view.step) * impulse;
            for index in 0..2 * d {
                let row = (place.rates, 2 * d, index);
                let errors = [combined(&ERROR_5, row), combined(&ERROR_3, row)];
                if index < d {
                    let unknown = Unknown::Position(node * d + index);
                    see(unknown, errors, rounded(position, moved));
                } else {
                    let unknown = Unknown::Momentum(node * d + index - d);
                    see(unknown, errors, rounded(momentum, impulse));
                }
            }
        }
        let first = self.stage.temperatures;
        let mut stretch = [0.0; 2];
        if first > 0 {
            stretch = rounded(per(by.stretch()), rounding_of_stretch(by.farthest()));
        }
        for index in 0..2 * self.stage.inner_past.len() {
            let rates = self.stage.inner_past[index / 2].rates.as_flattened();
            let row = (rates.as_flattened(), 2, index % 2);
            let errors = [combined(&ERROR_5, row), combined(&ERROR_3, row)];
            if index < first {
                see(Unknown::Viscous(index), errors, stretch);
            } else {
                let slot = index - first;
                let scale = per(by.temperature(self.stage.inner_start(index)));
                let scale = rounded(scale, self.rounding.temperature(slot));
                see(Unknown::Temperature(slot), errors, scale);
            }
        }
    }

    /// The [estimate](Explicit::estimate) of this error without what rounding explains, if that matters.
    fn judge(&mut self, bodies: &dyn Bodies, by: &Measure<'_>, error: f64) -> f64 {
        if !Scheme::EemExplicit.accuracy().holds_back(error) {
            return error;
        }
        self.find_rounding(bodies);
        let may_explain =
            !self.rounding.is_none() || ROUNDING_SHARE * error < self.most_rounding(by);
        if may_explain {
            self.estimate_beyond_rounding(bodies, by)
        } else {
            error
        }
    }

    #[cold]
    fn estimate_beyond_rounding(&self, bodies: &dyn Bodies, by: &Measure<'_>) -> f64 {
        let Measure {
            view, tolerance, ..
        } = *by;
        let mut sums = [0.0; 2];
        self.each_error(
            bodies,
            by,
            &mut |_, [fifth, third], [per_scale, rounding]| {
                let fifth = view.step * fifth;
                let beyond = Scalar::maximum(fifth.abs() - rounding, 0.0) * per_scale;
                let third = view.step * third * per_scale;
                sums[0] += beyond * beyond;
                sums[1] += third * third;
            },
        );
        let beyond = Scalar::maximum(estimate_of(sums), HIDDEN);
        for at in 0..self.components.masses {
            let place = bodies.at(at);
            let [position, momentum] = place.start;
            let node = self.components.nodes[at];
            let ends = [[position, place.q], [momentum, place.p]];
            if !view.least.is_at_rest(node, ends[0], ends[1]) {
                let accurate = (tolerance.relative, Scheme::EemExplicit.accuracy());
                return view.least.hidden(beyond, view.step, accurate);
            }
        }
        beyond
    }

    /// At least what rounding of positions changes in the estimate.
    fn most_rounding(&self, by: &Measure<'_>) -> f64 {
        let distance = by.farthest();
        let impulse = by.view.least.most().rounding(by.view.step, distance);
        let momentum = by.momentum(by.scales.momentum);
        let count = self.components.masses * self.dimension + self.stage.temperatures;
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
    pub(super) fn find_rounding(&mut self, bodies: &dyn Bodies) {
        if !self.rounding.is_none() {
            bodies.find_rounding(&mut self.rounding);
        }
    }

    /// The rounding of the impulse on a mass, N s.
    fn rounding_of(&self, view: &View<'_>, place: &Seen<'_>, node: usize) -> f64 {
        let distance = Scalar::maximum(length(place.start[0]), length(place.q));
        view.least.at(node).rounding(view.step, distance) + self.rounding.at(node).impulse
    }

    /// By how much the correction of the energy has changed unknowns, in units of the tolerance: of a mass that is nearly at rest,
    /// while a support does work on its spring, a small defect of the energy is a large part of the motion; and that of a stiff
    /// spring is a large part of a weak one in series with a dashpot.
    pub(super) fn moved(&mut self, bodies: &dyn Bodies, by: &Measure<'_>) -> f64 {
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
            let change = self.change_by_closing(bodies, index, by);
            let (defect, scale) = (progress.correction * progress.scale, progress.scale);
            if change > 1.0 && !(defect.abs() <= self.explained(bodies, index, scale)) {
                largest = Scalar::maximum(largest, change);
            }
        }
        largest
    }

    /// The largest change of an unknown of a component by its closing, in units of the tolerance.
    #[cold]
    fn change_by_closing(&self, bodies: &dyn Bodies, index: usize, by: &Measure<'_>) -> f64 {
        let mut largest = 0.0;
        let mut see = |change: f64, allowed: f64| {
            let has_scale = allowed > 0.0;
            let part = if has_scale { change / allowed } else { 0.0 };
            largest = Scalar::maximum(largest, part);
        };
        let (view, d) = (by.view, self.dimension);
        let [position, stretch] = [by.position(), by.stretch()];
        for at in self.components.all[index].masses.clone() {
            let (place, node) = (bodies.at(at), self.components.nodes[at]);
            let rounding = self.rounding_of(view, &place, node);
            let scale = view.least.at(node).scale(by.scales.momentum, by.step());
            let momentum = Scalar::maximum(by.momentum(scale), rounding);
            for (part, (now, allowed)) in [(place.q, position), (place.p, momentum)]
                .into_iter()
                .enumerate()
            {
                let mut size = 0.0;
                for (axis, now) in now.iter().enumerate() {
                    let change = combined(&WEIGHTS, (place.rates, 2 * d, part * d + axis));
                    let before = place.start[part][axis] + view.step * change;
                    size = Scalar::hypot(size, now - before);
                }
                see(size, allowed);
            }
        }
        let change = |at: usize| {
            let rates = self.stage.inner_past[at / 2].rates.as_flattened();
            let change = combined(&WEIGHTS, (rates.as_flattened(), 2, at % 2));
            let before = self.stage.inner_start(at) + view.step * change;
            (self.stage.inner[at] - before).abs()
        };
        for dashpot in self.components.dashpots_of(index) {
            see(change(dashpot), stretch);
        }
        for slot in self.slots_of(index) {
            let slot = self.components.slots[slot];
            if !self.stage.is_held(slot) {
                let allowed = by.temperature(self.stage.theta(slot));
                see(change(self.stage.temperatures + slot), allowed);
            }
        }
        largest
    }

    /// The magnitudes of positions and momenta, given those of the positions at both ends and of the momenta at the end of a step.
    #[inline]
    fn scales(&self, [start, end, momentum]: [f64; 3]) -> Scales {
        Scales {
            position: Scalar::maximum(start, end),
            momentum: Scalar::maximum(momentum, self.books.largest_momentum),
        }
    }

    /// The same where squares under- or overflow; an error unless all are finite.
    #[cold]
    fn scaled(&self, bodies: &dyn Bodies) -> Result<Scales, StepFailure> {
        let (masses, d) = (self.components.masses, self.dimension);
        for at in 0..masses {
            let place = bodies.at(at);
            for (quantity, values) in [("position", place.q), ("momentum", place.p)] {
                if let Some(axis) = values.iter().position(|value| !value.is_finite()) {
                    return Err(StepFailure::Unbounded {
                        node: self.components.nodes[at],
                        axis,
                        quantity,
                        value: values[axis],
                    });
                }
            }
        }
        Ok(self.scales(vector(|part| {
            norm((0..masses * d).map(|at| {
                let place = bodies.at(at / d);
                [place.start[0], place.q, place.p][part][at % d]
            }))
        })))
    }
}

impl<const D: usize> Explicit<D> {
    /// Goes to the end of a step before it is closed; returns the magnitudes there.
    pub(super) fn approach(
        &mut self,
        view: &View<'_>,
        next: &mut State,
    ) -> Result<Scales, StepFailure> {
        self.begin(view, next)?;
        self.go_through_stages(view)?;
        let time = view.end();
        if !time.is_finite() {
            let value = time;
            return Err(StepFailure::Time { value });
        }
        let mut squares = [0.0; 3];
        for place in &self.places[..self.components.masses] {
            let parts = [&place.past.start[0], place.q(), place.p()];
            for (square, part) in squares.iter_mut().zip(parts) {
                *square += dot(part, part);
            }
        }
        for sum in squares {
            let is_normal = sum > f64::MIN_POSITIVE && sum <= f64::MAX;
            if !is_normal {
                let (accounts, bodies) = self.parts(view);
                return accounts.scaled(&bodies);
            }
        }
        Ok(self.scales(squares.map(Scalar::sqrt)))
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
    pub(super) fn estimate(&mut self, by: &Measure<'_>, view: &View<'_>) -> f64 {
        let (mut sums, h, least) = ([0.0; 2], view.step, view.least);
        let (all, step) = (by.scales.momentum, by.step());
        let position = per(by.position());
        let of_all = per(by.momentum(all));
        let are_alike = least.most().scale(all, step) <= all;
        for at in 0..self.components.masses {
            let [fifth, third] = errors(&self.places[at].past);
            let momentum = if are_alike {
                of_all
            } else {
                let node = self.components.nodes[at];
                per(by.momentum(least.at(node).scale(all, step)))
            };
            for (part, per_scale) in [position, momentum].into_iter().enumerate() {
                for axis in 0..D {
                    let errors = [fifth[part][axis], third[part][axis]];
                    add_squares(&mut sums, h, errors, per_scale);
                }
            }
        }
        self.accounts.add_squares(by, &mut sums);
        let (accounts, bodies) = self.parts(view);
        accounts.judge(&bodies, by, estimate_of(sums))
    }

    /// The unknown with the largest error in a step, with its error and what the tolerance allows.
    #[cold]
    pub(crate) fn worst_error(
        &mut self,
        view: &View<'_>,
        tolerance: &Tolerance,
        next: &mut State,
    ) -> Result<Option<UnknownError>, StepFailure> {
        let was_ready = self.is_ready;
        let tried = self.approach(view, next);
        // As before the attempt.
        self.is_ready = was_ready;
        let by = Measure {
            view,
            tolerance,
            scales: tried?,
            dimension: D,
        };
        let (accounts, bodies) = self.parts(view);
        accounts.find_rounding(&bodies);
        let mut worst = None;
        let mut see = |unknown, [fifth, _]: [f64; 2], [per_scale, rounding]: [f64; 2]| {
            let allowed = per_scale.recip() + rounding;
            see_worst(&mut worst, unknown, [(view.step * fifth).abs(), allowed]);
        };
        accounts.each_error(&bodies, &by, &mut see);
        Ok(worst)
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
pub(super) struct Measure<'a> {
    pub(super) view: &'a View<'a>,
    pub(super) tolerance: &'a Tolerance,
    pub(super) scales: Scales,
    /// That of space.
    pub(super) dimension: usize,
}

impl Measure<'_> {
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

    /// What it allows a momentum of this scale, kg m/s.
    fn momentum(&self, scale: f64) -> f64 {
        self.tolerance.relative * scale + self.tolerance.momentum
    }

    /// What it allows a temperature, K.
    fn temperature(&self, theta: f64) -> f64 {
        self.tolerance.relative * theta + self.tolerance.temperature
    }

    /// What it allows a viscous stretch, m.
    fn stretch(&self) -> f64 {
        let positions = self.view.state.positions.values();
        self.tolerance.relative * self.view.least.stretches(self.dimension, positions)
            + self.tolerance.position
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

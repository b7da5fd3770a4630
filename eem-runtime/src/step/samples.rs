//! Whether a step follows a function of time, from samples inside the step.
//!
//! The estimate of a step's error knows a load only at the times at which the scheme evaluates it; what lasts less than a step
//! may lie between them. So the load is sampled at equal distances, and compared with the polynomials through nine and through
//! five of the samples:
//!
//! ```text
//! P₈   through the samples at t + kh/8,   k = 0 … 8
//! P₄   through those with even k
//! ```
//!
//! A function that is smooth on the scale of the step is followed far better by P₈ than by P₄. Then the scheme sees it too, and
//! its own estimate counts. Otherwise what P₈ misses is something of its own, that has to be smaller than the tolerance: of a
//! force its impulse, of a position or a temperature its height.
//!
//! An estimate that compares two rules is wrong where both miss the same. So the integral that the step takes is compared with
//! that of the samples, too.

use crate::algebra::vector;
use crate::step::error::StepFailure;
use crate::step::load_rule::LoadRule;
use eem_material::number::scalar::Scalar;

/// Parts of a step between the points of P₈.
const PARTS: u32 = 8;

const POINTS: usize = PARTS as usize + 1;

/// The fewest intervals between samples: one sample between any two points of P₈.
const FEWEST: u32 = 2 * PARTS;

/// The most intervals of one step; longer steps are shortened.
pub(crate) const MOST: u32 = 4096;

/// A function is smooth on the scale of the step if P₈ misses at most this fraction of what P₄ misses. The largest quotient for a
/// vibration is 0.01 with an angle of 7 rad in the step and 0.02 with 8, where no scheme is accurate; the smallest one is 0.018
/// for a Gaussian bump with σ = h/5, 0.14 with σ = h/10, 0.16 for a kink and 0.33 for a jump.
const SMOOTH: f64 = 0.02;

/// Roundings of a sample's difference from P₈, in ε of the largest value: 10.95, the Lebesgue constant of nine equidistant points,
/// for those of the points; one for that of the sample; four for the products and their sum.
const ROUNDINGS: f64 = 16.0;

/// Weights of the integral of P₈ (Newton–Cotes), for the mean over the step.
const NEWTON_COTES: [f64; POINTS] = [
    989.0 / 28350.0,
    5888.0 / 28350.0,
    -928.0 / 28350.0,
    10496.0 / 28350.0,
    -4540.0 / 28350.0,
    10496.0 / 28350.0,
    -928.0 / 28350.0,
    5888.0 / 28350.0,
    989.0 / 28350.0,
];

/// The error of a step by the difference of two rules may be smaller than the true one by this factor.
const DOUBT: f64 = 4.0;

/// A function of time in s that writes its components, or an error.
pub(crate) type Sampled<'a> = &'a dyn Fn(f64, &mut [f64]) -> Result<(), StepFailure>;

/// Samples of a step at equal distances, including both ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    start: f64,
    size: f64,
    /// A multiple of [`PARTS`].
    intervals: u32,
}

impl Grid {
    /// For a step, with intervals of at most this length, s, unless that would be more than [`MOST`].
    pub(crate) fn new([start, size]: [f64; 2], longest: f64) -> Self {
        let count = size / longest;
        let mut intervals = FEWEST;
        while f64::from(intervals) < count && intervals < MOST {
            intervals += PARTS;
        }
        Self {
            start,
            size,
            intervals,
        }
    }

    /// The start and the size of the step, s.
    pub(crate) fn span(&self) -> [f64; 2] {
        [self.start, self.size]
    }

    /// The time of a sample. The last one is the end of the step as the schemes compute it.
    fn time(&self, sample: u32) -> f64 {
        let share = f64::from(sample) / f64::from(self.intervals);
        self.start + share * self.size
    }

    /// The largest magnitude of a time in the step, s.
    fn largest_time(&self) -> f64 {
        Scalar::maximum(self.start.abs(), self.time(self.intervals).abs())
    }

    /// Looks at a function of time, with memory for its value and for what is seen of each component.
    pub(crate) fn look<'a>(
        &'a self,
        of: Sampled<'a>,
        value: &'a mut [f64],
        components: &'a mut [Component],
    ) -> Result<Look<'a>, StepFailure> {
        let stride = self.intervals / PARTS;
        for index in 0..=PARTS {
            of(self.time(index * stride), value)?;
            for (component, &value) in components.iter_mut().zip(&*value) {
                component.points[index as usize] = value;
            }
        }
        // Simpson's weights are 1, 4, 2, 4 … 2, 4, 1 thirds.
        let third = 1.0 / (3.0 * f64::from(self.intervals));
        for component in &mut *components {
            component.begin(third);
        }
        let are_constant = components.iter().all(Component::is_constant);
        for sample in 1..=self.intervals {
            let (part, within) = (sample / stride, sample % stride);
            let weight = match sample {
                last if last == self.intervals => third,
                odd if odd % 2 == 1 => 4.0 * third,
                _ => 2.0 * third,
            };
            let is_between = within != 0;
            if is_between {
                of(self.time(sample), value)?;
            }
            // Most samples are those of a load that acts later: then both polynomials are constant.
            let is_curved = is_between && !are_constant;
            let place = f64::from(sample) / f64::from(stride);
            let weights =
                is_curved.then(|| [lagrange(POINTS, place), lagrange(COARSE, 0.5 * place)]);
            for (component, &value) in components.iter_mut().zip(&*value) {
                let value = if is_between {
                    value
                } else {
                    component.points[part as usize]
                };
                component.by_samples += weight * value;
                component.see(value, f64::from(self.intervals));
                if let Some(weights) = &weights {
                    component.miss(value, component.polynomials(weights));
                } else if is_between {
                    component.miss(value, [component.first; 2]);
                }
            }
        }
        Ok(Look {
            grid: *self,
            of,
            value,
            components,
        })
    }
}

/// The number of points of P₄.
const COARSE: usize = POINTS / 2 + 1;

/// The weights of the values at 0, 1, 2 … `count` − 1 in the polynomial through them at a place between them, by Lagrange's formula:
///
/// ```text
/// Π_{j≠i} (x − j)/(i − j)
/// ```
fn lagrange(count: usize, place: f64) -> [f64; POINTS] {
    let index = |at: usize| f64::from(u8::try_from(at).unwrap_or(0));
    // The products of the factors before and behind each value.
    let (mut before, mut behind) = ([1.0; POINTS], [1.0; POINTS]);
    for at in 1..count {
        let (from, back) = (index(at), count - 1 - at);
        before[at] = before[at - 1] * (place - (from - 1.0)) / from;
        behind[back] = behind[back + 1] * (index(back + 1) - place) / from;
    }
    vector(|at| before[at] * behind[at])
}

/// What samples of one component of a function show.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Component {
    /// The values at the points of P₈.
    points: [f64; POINTS],
    /// The first and the last value so far.
    first: f64,
    last: f64,
    /// The largest magnitude.
    largest: f64,
    /// The mean of the magnitudes of changes since the start.
    deviation: f64,
    /// The sum of the magnitudes of changes from sample to sample, and the largest change.
    variation: f64,
    change: f64,
    /// Of P₈ and of P₄: the sum of the magnitudes of what it misses, and the largest one.
    sums: [f64; 2],
    missed: [f64; 2],
    /// The means by P₈ and by Simpson's rule with all samples.
    by_points: f64,
    by_samples: f64,
    /// The mean by the rule of the step, and that of the two halves if it is made so.
    whole: f64,
    kept: f64,
    sum: f64,
}

impl Component {
    /// Begins with the points, given Simpson's weight of the first one.
    fn begin(&mut self, weight: f64) {
        let (points, [first, ..]) = (self.points, self.points);
        *self = Self {
            points,
            first,
            last: first,
            largest: first.abs(),
            ..Self::default()
        };
        for (point, weight) in points.into_iter().zip(NEWTON_COTES) {
            self.by_points += weight * point;
        }
        self.by_samples += weight * first;
    }

    #[expect(clippy::float_cmp, reason = "constant are the same numbers")]
    fn is_constant(&self) -> bool {
        self.points.iter().all(|point| *point == self.first)
    }

    /// P₈ and P₄ at a place with these weights.
    fn polynomials(&self, [fine, coarse]: &[[f64; POINTS]; 2]) -> [f64; 2] {
        let mut values = [0.0; 2];
        for (point, weight) in self.points.iter().zip(fine) {
            values[0] += weight * point;
        }
        for (point, weight) in self.points.iter().step_by(2).zip(coarse) {
            values[1] += weight * point;
        }
        values
    }

    /// The next sample of so many.
    fn see(&mut self, value: f64, samples: f64) {
        let change = (value - self.last).abs();
        self.variation += change;
        self.deviation += (value - self.first).abs() / samples;
        self.change = Scalar::maximum(self.change, change);
        self.largest = Scalar::maximum(self.largest, value.abs());
        self.last = value;
    }

    /// What polynomials with these values there miss of a sample.
    fn miss(&mut self, value: f64, polynomials: [f64; 2]) {
        for (degree, polynomial) in polynomials.into_iter().enumerate() {
            let missed = (value - polynomial).abs();
            self.sums[degree] += missed;
            self.missed[degree] = Scalar::maximum(self.missed[degree], missed);
        }
    }
}

/// What samples of a function show, component by component.
pub(crate) struct Look<'a> {
    grid: Grid,
    of: Sampled<'a>,
    value: &'a mut [f64],
    components: &'a mut [Component],
}

impl Look<'_> {
    /// The first value of a component.
    pub(crate) fn first(&self, at: usize) -> f64 {
        self.components[at].first
    }

    /// The sum of the magnitudes of the changes of a component from sample to sample.
    pub(crate) fn variation(&self, at: usize) -> f64 {
        self.components[at].variation
    }

    /// Whether P₈ misses more than a fraction of what P₄ misses.
    fn is_rough([fine, coarse]: [f64; 2]) -> bool {
        SMOOTH * coarse < fine
    }

    /// Whether the impulse of what the step does not follow exceeds this one, in the unit of the function times s, in some
    /// component.
    ///
    /// ```text
    /// ∫|f − P₈| dt > impulse + 16 ε (h max|f| + |t| Σ|Δf|)
    /// ```
    ///
    /// The last term is rounding: that of the values, and that of the times.
    pub(crate) fn misses_impulse(&self, impulse: f64) -> bool {
        let per_sample = self.grid.size / f64::from(self.grid.intervals - PARTS);
        self.components.iter().any(|of| {
            let [fine, coarse] = [per_sample * of.sums[0], per_sample * of.sums[1]];
            impulse + self.rounding(of) < fine && Self::is_rough([fine, coarse])
        })
    }

    /// The rounding of an integral over the step: of values, and of times.
    fn rounding(&self, of: &Component) -> f64 {
        let of_values = self.grid.size * of.largest;
        let of_times = self.grid.largest_time() * of.variation;
        ROUNDINGS * f64::EPSILON * (of_values + of_times)
    }

    /// Finds the means of the function by the rule of the step.
    pub(crate) fn find_means(&mut self, rule: &LoadRule) -> Result<(), StepFailure> {
        self.find_mean(rule, [0.0, 1.0], |of| [of.whole, of.kept] = [of.sum; 2])?;
        if rule.order.is_some() {
            self.find_mean(rule, [0.0, 0.5], |of| of.kept = of.sum)?;
            self.find_mean(rule, [0.5, 0.5], |of| of.kept += of.sum)?;
        }
        Ok(())
    }

    /// Finds the integral over a part of the step, of the size `part` from `first`, in units of the step.
    fn find_mean(
        &mut self,
        rule: &LoadRule,
        [first, part]: [f64; 2],
        take: fn(&mut Component),
    ) -> Result<(), StepFailure> {
        self.components.iter_mut().for_each(|of| of.sum = 0.0);
        for (time, weight) in rule.times.iter().zip(rule.weights) {
            let share = first + part * time;
            (self.of)(self.grid.start + share * self.grid.size, self.value)?;
            for (component, value) in self.components.iter_mut().zip(&*self.value) {
                component.sum += part * weight * value;
            }
        }
        self.components.iter_mut().for_each(take);
        Ok(())
    }

    /// Whether the integral by the rule of the step, with the means last found, differs from that of the samples by more than this, in
    /// the unit of the function times s, and than its estimate says, in some component.
    ///
    /// ```text
    /// |∫f dt − h Σ b f| > impulse + share ∫|f − f(t)| dt + 4 e + |∫P₈ dt − ∫f dt| + 16 ε (h max|f| + |t| Σ|Δf|)
    /// ```
    ///
    /// The estimate is `e = h |Σ b f (whole) − Σ b f (halves)|/(2ᵖ − 1)` with an order p, for a step in two halves, zero otherwise.
    pub(crate) fn differs(&self, order: Option<f64>, [impulse, share]: [f64; 2]) -> bool {
        let quotient = order.map_or(0.0, |order| DOUBT / (order.exp2() - 1.0));
        self.components.iter().any(|of| {
            let estimate = quotient * (of.whole - of.kept).abs();
            let doubt = estimate + (of.by_points - of.by_samples).abs() + share * of.deviation;
            let allowed = impulse + self.grid.size * doubt + self.rounding(of);
            allowed < self.grid.size * (of.by_samples - of.kept).abs()
        })
    }

    /// Whether what the step does not follow is higher than this, in the unit of the function, in some component.
    ///
    /// ```text
    /// min(max|x − P₈|, ½ (Σ|Δx| − |x(t + h) − x(t)|)) > height + 16 ε (max|x| + |t| max|Δx| n/h)
    /// ```
    ///
    /// The second part is by how much the function goes back and forth. The end of a step is always seen, so that a jump counts
    /// only together with the one back.
    pub(crate) fn misses_height(&self, height: f64) -> bool {
        self.components.iter().any(|of| {
            let forth = (of.last - of.first).abs();
            let back = 0.5 * (of.variation - forth);
            let slope = of.change * f64::from(self.grid.intervals) / self.grid.size;
            let of_sizes = of.largest + self.grid.largest_time() * slope;
            let rounding = ROUNDINGS * f64::EPSILON * of_sizes;
            height + rounding < Scalar::minimum(of.missed[0], back) && Self::is_rough(of.missed)
        })
    }
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;

    use super::{Component, Grid, Look};
    use crate::step::error::StepFailure;

    /// What is found by a look at a function in a step from 0 to 1 s.
    fn look<T>(
        intervals: f64,
        of: impl Fn(f64) -> f64,
        find: impl FnOnce(&Look<'_>) -> T,
    ) -> Result<T, StepFailure> {
        let grid = Grid::new([0.0, 1.0], intervals.recip());
        let of = |time: f64, value: &mut [f64]| {
            value[0] = of(time);
            Ok(())
        };
        let (mut value, mut components) = ([0.0], [Component::default()]);
        Ok(find(&grid.look(&of, &mut value, &mut components)?))
    }

    /// Whether the step misses more than this impulse, and more than this height.
    fn misses(intervals: f64, of: impl Fn(f64) -> f64, [impulse, height]: [f64; 2]) -> [bool; 2] {
        let found = look(intervals, of, |look| {
            [look.misses_impulse(impulse), look.misses_height(height)]
        });
        found.unwrap()
    }

    #[test]
    fn polynomials_up_to_the_eighth_degree_are_followed_to_rounding() {
        for degree in 0..=8 {
            let power = |t: f64| 3.0 + (2.0 * t - 0.7).powi(degree);
            assert_eq!(misses(100.0, power, [0.0; 2]), [false; 2], "{degree}");
        }
        let power = |t: f64| (2.0 * t - 0.7).powi(9);
        let missed = look(100.0, power, |look| look.components[0].missed[0]).unwrap();
        // `(2/8)⁹ max |Π (u − k)|`, of which the samples show nearly all.
        let product = |u: f64| (0..9).map(|k| u - f64::from(k)).product::<f64>().abs();
        let largest = (0..1000)
            .map(|at| product(f64::from(at) * 1e-3))
            .fold(0.0, f64::max);
        let quotient = missed / (0.25_f64.powi(9) * largest);
        assert!((0.98..=1.0 + 1e-9).contains(&quotient), "{quotient}");
    }

    #[test]
    fn a_vibration_of_more_than_a_period_is_smooth() {
        for phase in 0..24 {
            let phase = f64::from(phase) * core::f64::consts::PI / 12.0;
            let slow = |t: f64| (7.0 * t + phase).sin();
            assert_eq!(misses(64.0, slow, [0.0; 2]), [false; 2]);
            let fast = |t: f64| (25.0 * t + phase).sin();
            assert_eq!(misses(64.0, fast, [0.1; 2]), [true; 2]);
        }
    }

    #[test]
    fn a_bump_of_three_samples_is_seen_wherever_it_is() {
        for place in 0..1000 {
            let middle = (f64::from(place) + 0.5) / 1000.0;
            let bump = |t: f64| (1.0 - ((t - middle) / 0.006).powi(2)).max(0.0);
            // Its area is 0.008, of which samples show at least half.
            let [area, height] = misses(256.0, |t| 2.0 * t + bump(t), [0.004, 0.5]);
            assert!(area, "{middle}");
            let is_whole = (0.01..0.99).contains(&middle);
            assert!(!is_whole || height, "{middle}");
        }
    }

    #[test]
    fn the_impulse_of_a_jump_is_missed_but_not_its_height() {
        for place in 1..200 {
            let at = f64::from(place) / 200.0;
            let jump = |t: f64| if t < at { 0.0 } else { 1.0 };
            assert_eq!(misses(256.0, jump, [1e-2, 0.0]), [true, false]);
        }
    }

    #[test]
    fn the_first_time_of_a_function_that_fails_ends_the_look() {
        let grid = Grid::new([1.0, 2.0], 0.01);
        let latest = Cell::new(0.0_f64);
        let seen_until = |end: f64| {
            let of = |time: f64, _: &mut [f64]| {
                latest.set(latest.get().max(time));
                let update = time;
                if time < end {
                    Ok(())
                } else {
                    Err(StepFailure::NotConverged { update })
                }
            };
            let (mut value, mut components) = ([0.0], [Component::default()]);
            grid.look(&of, &mut value, &mut components).map(|_| ())
        };
        let failed = seen_until(2.0);
        assert_eq!(failed, Err(StepFailure::NotConverged { update: 2.0 }));
        assert_eq!(seen_until(4.0), Ok(()));
        assert_eq!(latest.get().to_bits(), 3.0_f64.to_bits());
    }
}

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

/// The mean of a function over a step by a rule: whole, and in halves if the step is made so.
type Means<const N: usize> = [[f64; N]; 2];

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

    /// Looks at a function of time.
    pub(crate) fn look<const N: usize, E>(
        &self,
        mut of: impl FnMut(f64) -> Result<[f64; N], E>,
    ) -> Result<Look<N>, E> {
        let stride = self.intervals / PARTS;
        let mut points = [[0.0; N]; POINTS];
        for (point, index) in points.iter_mut().zip(0..) {
            *point = of(self.time(index * stride))?;
        }
        let mut look = Look::new(self, &points);
        for (point, weight) in points.iter().zip(NEWTON_COTES) {
            look.add(0, weight, point);
        }
        // Simpson's weights are 1, 4, 2, 4 … 2, 4, 1 thirds.
        let third = 1.0 / (3.0 * f64::from(self.intervals));
        look.add(1, third, &points[0]);
        #[expect(clippy::float_cmp, reason = "constant are the same numbers")]
        let is_constant = points.iter().all(|point| *point == points[0]);
        for sample in 1..=self.intervals {
            let (part, within) = (sample / stride, sample % stride);
            let weight = match sample {
                last if last == self.intervals => third,
                odd if odd % 2 == 1 => 4.0 * third,
                _ => 2.0 * third,
            };
            if within == 0 {
                let point = &points[part as usize];
                look.add(1, weight, point);
                look.see(point, None);
                continue;
            }
            let value = of(self.time(sample))?;
            look.add(1, weight, &value);
            let place = f64::from(sample) / f64::from(stride);
            if is_constant {
                // Most samples of a load that acts later.
                look.see(&value, Some([&points[0]; 2]));
            } else {
                let fine = polynomial(&points, place);
                let coarse = core::array::from_fn::<_, COARSE, _>(|at| points[2 * at]);
                let coarse = polynomial(&coarse, 0.5 * place);
                look.see(&value, Some([&fine, &coarse]));
            }
        }
        Ok(look)
    }
}

impl Grid {
    /// The means of a function by the rule of the step.
    pub(crate) fn means<const N: usize, E>(
        &self,
        rule: LoadRule,
        mut of: impl FnMut(f64) -> Result<[f64; N], E>,
    ) -> Result<Means<N>, E> {
        let mut mean = |first: f64, part: f64| {
            let mut sum = [0.0; N];
            for (time, weight) in rule.times.iter().zip(rule.weights) {
                let share = first + part * time;
                let value = of(self.start + share * self.size)?;
                for (sum, value) in sum.iter_mut().zip(value) {
                    *sum += part * weight * value;
                }
            }
            Ok(sum)
        };
        let whole = mean(0.0, 1.0)?;
        if rule.order.is_none() {
            return Ok([whole; 2]);
        }
        let halves = [mean(0.0, 0.5)?, mean(0.5, 0.5)?];
        let sum = vector(|at| halves[0][at] + halves[1][at]);
        Ok([whole, sum])
    }
}

/// The number of points of P₄.
const COARSE: usize = POINTS / 2 + 1;

/// The polynomial through values at 0, 1, 2 … P − 1 at a place between them, by Lagrange's formula:
///
/// ```text
/// Σ_i f_i Π_{j≠i} (x − j)/(i − j)
/// ```
fn polynomial<const N: usize, const P: usize>(values: &[[f64; N]; P], place: f64) -> [f64; N] {
    let index = |at: usize| f64::from(u8::try_from(at).unwrap_or(0));
    // The products of the factors before and behind each value.
    let (mut before, mut behind) = ([1.0; P], [1.0; P]);
    for at in 1..P {
        let (from, back) = (index(at), P - 1 - at);
        before[at] = before[at - 1] * (place - (from - 1.0)) / from;
        behind[back] = behind[back + 1] * (index(back + 1) - place) / from;
    }
    let mut result = [0.0; N];
    for ((value, before), behind) in values.iter().zip(before).zip(behind) {
        let weight = before * behind;
        for (sum, &value) in result.iter_mut().zip(value) {
            *sum += weight * value;
        }
    }
    result
}

/// What samples of a function show, component by component.
#[derive(Clone, Debug)]
pub(crate) struct Look<const N: usize> {
    /// The size of the step and the largest magnitude of a time in it, s.
    size: f64,
    time: f64,
    /// The number of samples that are not points of a polynomial, and of all intervals.
    between: f64,
    intervals: f64,
    /// The first and the last value so far.
    pub(crate) first: [f64; N],
    last: [f64; N],
    /// The largest magnitude.
    largest: [f64; N],
    /// The mean of the magnitudes of changes since the start.
    deviation: [f64; N],
    /// Sums of the magnitudes of changes from sample to sample, and the largest change.
    variation: [f64; N],
    change: [f64; N],
    /// Of P₈ and of P₄: the sum of the magnitudes of what it misses, and the largest one.
    sums: [[f64; N]; 2],
    missed: [[f64; N]; 2],
    /// The means by P₈ and by Simpson's rule with all samples.
    means: [[f64; N]; 2],
}

impl<const N: usize> Look<N> {
    fn new(grid: &Grid, points: &[[f64; N]; POINTS]) -> Self {
        let zeros = [0.0; N];
        Self {
            size: grid.size,
            time: Scalar::maximum(grid.start.abs(), grid.time(grid.intervals).abs()),
            between: f64::from(grid.intervals - PARTS),
            intervals: f64::from(grid.intervals),
            first: points[0],
            last: points[0],
            largest: points[0].map(Scalar::abs),
            deviation: zeros,
            variation: zeros,
            change: zeros,
            sums: [zeros; 2],
            missed: [zeros; 2],
            means: [zeros; 2],
        }
    }

    /// Adds a weighted value to a mean.
    fn add(&mut self, mean: usize, weight: f64, value: &[f64; N]) {
        for (sum, &value) in self.means[mean].iter_mut().zip(value) {
            *sum += weight * value;
        }
    }

    /// The next sample, and the polynomials there unless it is a point of both.
    fn see(&mut self, value: &[f64; N], polynomials: Option<[&[f64; N]; 2]>) {
        for at in 0..N {
            let change = (value[at] - self.last[at]).abs();
            self.variation[at] += change;
            self.deviation[at] += (value[at] - self.first[at]).abs() / self.intervals;
            self.change[at] = Scalar::maximum(self.change[at], change);
            self.largest[at] = Scalar::maximum(self.largest[at], value[at].abs());
            for (degree, polynomial) in polynomials.into_iter().flatten().enumerate() {
                let missed = (value[at] - polynomial[at]).abs();
                self.sums[degree][at] += missed;
                self.missed[degree][at] = Scalar::maximum(self.missed[degree][at], missed);
            }
        }
        self.last = *value;
    }

    /// The sums of the magnitudes of changes from sample to sample.
    pub(crate) fn variation(&self) -> [f64; N] {
        self.variation
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
        let per_sample = self.size / self.between;
        (0..N).any(|at| {
            let [fine, coarse] = [0, 1].map(|degree| per_sample * self.sums[degree][at]);
            impulse + self.rounding(at) < fine && Self::is_rough([fine, coarse])
        })
    }

    /// The rounding of an integral over the step: of values, and of times.
    fn rounding(&self, at: usize) -> f64 {
        let of_values = self.size * self.largest[at];
        let of_times = self.time * self.variation[at];
        ROUNDINGS * f64::EPSILON * (of_values + of_times)
    }

    /// Whether the integral by the rule of the step, whose means these are, differs from that of the samples by more than this, in
    /// the unit of the function times s, and than its estimate says, in some component.
    ///
    /// ```text
    /// |∫f dt − h Σ b f| > impulse + share ∫|f − f(t)| dt + 4 e + |∫P₈ dt − ∫f dt| + 16 ε (h max|f| + |t| Σ|Δf|)
    /// ```
    ///
    /// The estimate is `e = h |Σ b f (whole) − Σ b f (halves)|/(2ᵖ − 1)` for a step in two halves, zero otherwise.
    pub(crate) fn differs(
        &self,
        [whole, kept]: Means<N>,
        rule: LoadRule,
        [impulse, share]: [f64; 2],
    ) -> bool {
        let quotient = rule.order.map_or(0.0, |order| DOUBT / (order.exp2() - 1.0));
        (0..N).any(|at| {
            let [coarse, fine] = self.means.map(|means| means[at]);
            let estimate = quotient * (whole[at] - kept[at]).abs();
            let doubt = estimate + (coarse - fine).abs() + share * self.deviation[at];
            let allowed = impulse + self.size * doubt + self.rounding(at);
            allowed < self.size * (fine - kept[at]).abs()
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
        (0..N).any(|at| {
            let [fine, coarse] = [0, 1].map(|degree| self.missed[degree][at]);
            let forth = (self.last[at] - self.first[at]).abs();
            let back = 0.5 * (self.variation[at] - forth);
            let slope = self.change[at] * self.intervals / self.size;
            let of_sizes = self.largest[at] + self.time * slope;
            let rounding = ROUNDINGS * f64::EPSILON * of_sizes;
            height + rounding < Scalar::minimum(fine, back) && Self::is_rough([fine, coarse])
        })
    }
}

#[cfg(test)]
mod tests {
    use core::convert::Infallible;

    use super::{Grid, Look};

    /// A look at a function in a step from 0 to 1 s.
    fn look(intervals: f64, of: impl Fn(f64) -> f64) -> Look<1> {
        let grid = Grid::new([0.0, 1.0], intervals.recip());
        let Ok(look) = grid.look(|time| Ok::<_, Infallible>([of(time)]));
        look
    }

    #[test]
    fn polynomials_up_to_the_eighth_degree_are_followed_to_rounding() {
        for degree in 0..=8 {
            let look = look(100.0, |t| 3.0 + (2.0 * t - 0.7).powi(degree));
            assert!(!look.misses_impulse(0.0), "{degree}");
            assert!(!look.misses_height(0.0), "{degree}");
        }
        let fine = look(100.0, |t| (2.0 * t - 0.7).powi(9));
        // `(2/8)⁹ max |Π (u − k)|`, of which the samples show nearly all.
        let product = |u: f64| (0..9).map(|k| u - f64::from(k)).product::<f64>().abs();
        let largest = (0..1000)
            .map(|at| product(f64::from(at) * 1e-3))
            .fold(0.0, f64::max);
        let quotient = fine.missed[0][0] / (0.25_f64.powi(9) * largest);
        assert!((0.98..=1.0 + 1e-9).contains(&quotient), "{quotient}");
    }

    #[test]
    fn a_vibration_of_more_than_a_period_is_smooth() {
        for phase in 0..24 {
            let phase = f64::from(phase) * core::f64::consts::PI / 12.0;
            let slow = look(64.0, |t| (7.0 * t + phase).sin());
            assert!(!slow.misses_impulse(0.0) && !slow.misses_height(0.0));
            let fast = look(64.0, |t| (25.0 * t + phase).sin());
            assert!(fast.misses_impulse(0.1) && fast.misses_height(0.1));
        }
    }

    #[test]
    fn a_bump_of_three_samples_is_seen_wherever_it_is() {
        for place in 0..1000 {
            let middle = (f64::from(place) + 0.5) / 1000.0;
            let bump = |t: f64| (1.0 - ((t - middle) / 0.006).powi(2)).max(0.0);
            let look = look(256.0, |t| 2.0 * t + bump(t));
            // Its area is 0.008, of which samples show at least half.
            assert!(look.misses_impulse(0.004), "{middle}");
            let is_whole = (0.01..0.99).contains(&middle);
            assert!(!is_whole || look.misses_height(0.5), "{middle}");
        }
    }

    #[test]
    fn the_impulse_of_a_jump_is_missed_but_not_its_height() {
        for place in 1..200 {
            let at = f64::from(place) / 200.0;
            let look = look(256.0, |t| if t < at { 0.0 } else { 1.0 });
            assert!(look.misses_impulse(1e-2) && !look.misses_height(0.0));
        }
    }

    #[test]
    fn the_first_time_of_a_function_that_fails_ends_the_look() {
        let grid = Grid::new([1.0, 2.0], 0.01);
        let failed = grid.look(|time| if time < 2.0 { Ok([0.0]) } else { Err(time) });
        assert_eq!(failed.err(), Some(2.0));
        let mut latest = 0.0_f64;
        let seen = grid.look(|time| {
            latest = latest.max(time);
            Ok::<_, ()>([time])
        });
        assert!(seen.is_ok());
        assert_eq!(latest.to_bits(), 3.0_f64.to_bits());
    }
}

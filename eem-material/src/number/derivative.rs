//! The derivative of a function at the beginning of an interval, from values in it.
//!
//! Difference quotients over spans, each √3 times shorter than the one before, are extrapolated to a limit by Neville's
//! algorithm. The error of a limit is estimated from its differences to those of one degree less, and from rounding. The
//! result has the smallest estimate of all limits with which those of every shorter span agree: over a long span, a function
//! that returns to its first value could seem flat (after C. J. F. Ridders, *Accurate computation of F′(x) and F′(x) F″(x)*,
//! Adv. Eng. Softw. 4 (1982)).

/// The ratio of a span to the next: irrational, so that no two consecutive spans are multiples of one period.
const RATIO: f64 = 1.732_050_807_568_877_2;

/// The number of spans: the shortest is 3e-5 of the interval. Shorter ones would show the rounding of functions with larger
/// terms, such as 1 − cos t.
pub const SPANS: usize = 20;

/// The highest degree of an extrapolating polynomial.
const DEGREE: usize = 8;

/// Rounding error of a difference, in ε of the larger of its two values: a function makes a few roundings.
const ROUNDINGS: f64 = 4.0;

/// The largest difference of two limits that agree, in units of their estimated errors.
const AGREEMENT: f64 = 2.0;

/// A limit with its estimated error.
#[derive(Clone, Copy)]
struct Limit {
    value: f64,
    error: f64,
}

/// The spans after which the function is evaluated, as fractions of the interval.
#[must_use]
pub fn shares() -> [f64; SPANS] {
    let mut shares = [1.0; SPANS];
    for place in 1..SPANS {
        shares[place] = shares[place - 1] / RATIO;
    }
    shares
}

/// The derivative, from the value at the beginning and those after the spans. NaN if values after the shortest spans are not
/// finite.
#[must_use]
pub fn derivative(first: f64, (spans, values): ([f64; SPANS], [f64; SPANS])) -> f64 {
    let limits = limits(first, (&spans, &values));
    let agree = |a: &Limit, b: &Limit| (a.value - b.value).abs() <= AGREEMENT * (a.error + b.error);
    let sound = limits.iter().enumerate().filter(|&(place, limit)| {
        let mut shorter = limits[place + 1..].iter();
        limit.error.is_finite() && shorter.all(|other| agree(limit, other))
    });
    let best = sound.min_by(|(_, a), (_, b)| a.error.total_cmp(&b.error));
    best.map_or(f64::NAN, |(_, limit)| limit.value)
}

/// For each span, the best limit from it and longer ones.
fn limits(first: f64, (spans, values): (&[f64; SPANS], &[f64; SPANS])) -> Vec<Limit> {
    let mut before = [f64::NAN; DEGREE + 1];
    let of_span = |(place, (&value, &span)): (usize, (&f64, &f64))| {
        let rounding = ROUNDINGS * f64::EPSILON * first.abs().max(value.abs()) / span;
        let mut best = Limit {
            value: f64::NAN,
            error: f64::INFINITY,
        };
        let mut limits = [f64::NAN; DEGREE + 1];
        limits[0] = (value - first) / span;
        let mut ratio = 1.0;
        for degree in 1..=place.min(DEGREE) {
            ratio *= RATIO;
            let (lower, longer) = (limits[degree - 1], before[degree - 1]);
            let value = lower + (lower - longer) / (ratio - 1.0);
            limits[degree] = value;
            let error = (value - lower).abs().max((value - longer).abs()) + rounding;
            if error < best.error {
                best = Limit { value, error };
            }
        }
        before = limits;
        best
    };
    values.iter().zip(spans).enumerate().map(of_span).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn of(function: impl Fn(f64) -> f64, interval: f64) -> f64 {
        let spans = shares().map(|share| share * interval);
        derivative(function(0.0), (spans, spans.map(&function)))
    }

    #[test]
    fn smooth_functions_have_theirs_whatever_the_interval() {
        for interval in [1.0, 0.1, 1e-2, 1e-4] {
            assert!((of(|t| 0.01 * (300.0 * t).sin(), interval) - 3.0).abs() <= 1e-12);
            assert!((of(|t| 2.0 + 0.1 * (6.0 * t).sin(), interval) - 0.6).abs() <= 1e-10);
            assert!((of(|t| (TAU * t).sin(), interval) - TAU).abs() <= 1e-12);
            assert!((of(|t| 1.0 - (-1e3 * t).exp(), interval) - 1e3).abs() <= 1e-8);
            assert!(of(|t| -1.5 * t * t, interval).abs() <= 1e-15);
        }
        assert!((of(|t| 0.01 * (300.0 * t).sin(), 10.0) - 3.0).abs() <= 1e-6);
    }

    #[test]
    fn later_changes_of_the_function_have_no_effect() {
        for interval in [10.0, 1.0, 0.1] {
            assert!(of(|t| 0.2 * (t - 0.05).max(0.0), interval).abs() <= 1e-15);
            let pulse = |t: f64| if t < 0.03 { (100.0 * t).sin() } else { 0.0 };
            assert!((of(pulse, interval) - 100.0).abs() <= 1e-9);
        }
    }

    #[test]
    fn a_function_that_is_nan_has_none() {
        let late = |t: f64| if t > 0.0 { f64::NAN } else { 0.0 };
        assert!(of(late, 1.0).is_nan());
        let at_first = |t: f64| {
            if t > 0.0 && t < 1e-3 {
                f64::NAN
            } else {
                3.0 * t
            }
        };
        assert!(of(at_first, 1.0).is_nan());
        let early = |t: f64| if t > 0.1 { f64::NAN } else { 3.0 * t };
        assert!((of(early, 1.0) - 3.0).abs() <= 1e-14);
    }
}

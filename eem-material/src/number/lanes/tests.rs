//! Tests: each lane computes as if it were alone, and a decision is common to all lanes or an error.

use super::{LANES, Lanes};
use crate::number::scalar::{Discord, Mask, Real, Scalar};

fn lanes(numbers: [f64; LANES]) -> Lanes {
    Lanes::pack(|lane| numbers[lane])
}

/// A function on lanes and on one number.
type Unary = (fn(Lanes) -> Lanes, fn(f64) -> f64);
type Binary = (fn(Lanes, Lanes) -> Lanes, fn(f64, f64) -> f64);

#[test]
fn a_decision_is_that_of_all_lanes_or_an_error() {
    let (one, two) = (Lanes::from_f64(1.0), Lanes::from_f64(2.0));
    let mixed = lanes([1.0, 2.0, 2.0, 2.0]);
    assert_eq!(one.less(two).decide(), Ok(true));
    assert_eq!(two.less(one).decide(), Ok(false));
    assert_eq!(one.equal(one).decide(), Ok(true));
    assert_eq!(mixed.less(two).decide(), Err(Discord));
    assert_eq!(mixed.at_most(two).decide(), Ok(true));
    assert_eq!(one.less(mixed).decide(), Err(Discord));
    assert_eq!(mixed.equal(two).decide(), Err(Discord));
    assert!(mixed != two && mixed == mixed);
}

#[test]
fn one_number_that_is_not_finite_is_noticed() {
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(!lanes([1.0, 2.0, bad, 3.0]).is_finite());
    }
    assert!(lanes([1.0, 2.0, -4.0, 3.0]).is_finite());
    let all = Lanes::from_f64(f64::NAN);
    assert!(!all.is_finite());
    assert_eq!(all.equal(all).decide(), Ok(false));
}

#[test]
fn lanes_are_one_number_only_if_they_are_the_same() {
    assert_eq!(Lanes::from_f64(3.0).to_f64().to_bits(), 3.0_f64.to_bits());
    assert!(lanes([3.0, 3.0, 3.0, 4.0]).to_f64().is_nan());
}

#[test]
fn a_mask_decides_lane_by_lane() {
    let numbers = lanes([1.0, -2.0, 3.0, f64::NAN]);
    let is_positive = Lanes::zero().less(numbers);
    assert!(is_positive.any() && !is_positive.all());
    assert!((is_positive | !is_positive).all());
    assert!(!(is_positive & !is_positive).any());
    assert!(!<Lanes as Scalar>::Mask::none().any());
    let (then, otherwise) = (Lanes::from_f64(1.0), Lanes::from_f64(0.0));
    let expected = lanes([1.0, 0.0, 1.0, 0.0]);
    assert!(Lanes::select(is_positive, then, otherwise) == expected);
    assert!(Lanes::branch(is_positive, || then, || otherwise) == expected);
    assert_eq!(is_positive.decide(), Err(Discord));
}

#[test]
fn each_lane_has_the_bits_that_it_has_alone() {
    let samples = [0.3, -0.7, 2.5, 0.0, -0.0, f64::NAN, f64::INFINITY, 1e-310];
    let unary: [Unary; 8] = [
        (|x| -x, |x| -x),
        (Scalar::abs, Scalar::abs),
        (Scalar::sqrt, Scalar::sqrt),
        (Scalar::exp, Scalar::exp),
        (Scalar::ln, Scalar::ln),
        (Scalar::exp_m1, Scalar::exp_m1),
        (Scalar::sin, Scalar::sin),
        (|x| x.powi(-3), |x| Scalar::powi(x, -3)),
    ];
    let binary: [Binary; 7] = [
        (|x, y| x + y, |x, y| x + y),
        (|x, y| x - y, |x, y| x - y),
        (|x, y| x * y, |x, y| x * y),
        (|x, y| x / y, |x, y| x / y),
        (Scalar::minimum, Scalar::minimum),
        (Scalar::maximum, Scalar::maximum),
        (Scalar::powf, Scalar::powf),
    ];
    // The sign and the digits of a NaN do not matter.
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
    for numbers in samples.windows(LANES) {
        let packed = Lanes::pack(|lane| numbers[lane]);
        for (together, alone) in unary {
            let found = together(packed);
            for (lane, &number) in numbers.iter().enumerate() {
                assert!(same(found.lane(lane), alone(number)), "{number}");
            }
        }
        for (together, alone) in binary {
            for shift in 0..LANES {
                let other = |lane: usize| samples[(lane + shift) % samples.len()];
                let found = together(packed, Lanes::pack(other));
                for (lane, &number) in numbers.iter().enumerate() {
                    let expected = alone(number, other(lane));
                    assert!(same(found.lane(lane), expected), "{number}, {shift}");
                }
            }
        }
    }
}

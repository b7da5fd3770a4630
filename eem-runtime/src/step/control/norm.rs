//! Sizes of vectors, and of their rounding.

use eem_material::number::scalar::Scalar;

/// Errors of fewer roundings of their own terms cannot be distinguished from rounding.
pub(crate) const ROUNDINGS: f64 = 16.0;

/// `|x|₂` of numbers in memory.
pub(crate) fn length(x: &[f64]) -> f64 {
    norm(x.iter().copied())
}

/// `|x|₂`, scaled where squares would under- or overflow.
pub(crate) fn norm(x: impl Iterator<Item = f64> + Clone) -> f64 {
    let sum = x.clone().fold(0.0, |sum, x| sum + x * x);
    if sum > f64::MIN_POSITIVE && sum <= f64::MAX {
        return sum.sqrt();
    }
    scaled_norm(&move |see: See<'_>| x.clone().for_each(see))
}

/// A function of a number.
type See<'a> = &'a mut dyn FnMut(f64);

/// The same in units of the largest number, given a function that calls another one with each.
#[cold]
fn scaled_norm(each: &dyn Fn(See<'_>)) -> f64 {
    let (mut most, mut sum) = (0.0, 0.0);
    each(&mut |x| most = Scalar::maximum(most, x.abs()));
    if most == 0.0 {
        return most;
    }
    each(&mut |x| sum += (x / most) * (x / most));
    most * sum.sqrt()
}

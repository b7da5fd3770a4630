//! Sizes of vectors, and of their rounding.

use eem_material::number::scalar::Scalar;

/// Errors of fewer roundings of their own terms cannot be distinguished from rounding.
pub(crate) const ROUNDINGS: f64 = 16.0;

/// `|x|₂`, scaled where squares would under- or overflow.
pub(crate) fn norm(x: impl Iterator<Item = f64> + Clone) -> f64 {
    let sum = x.clone().fold(0.0, |sum, x| sum + x * x);
    if sum > f64::MIN_POSITIVE && sum <= f64::MAX {
        return sum.sqrt();
    }
    let most = x
        .clone()
        .fold(0.0, |most, x| Scalar::maximum(most, x.abs()));
    if most == 0.0 {
        return most;
    }
    let scaled = x.map(|x| x / most);
    most * scaled.fold(0.0, |sum, x| sum + x * x).sqrt()
}

//! Sizes of vectors, and of their rounding.

use eem_material::number::scalar::{Mask, Real};

/// Errors of fewer roundings of their own terms cannot be distinguished from rounding.
pub(super) const ROUNDINGS: f64 = 16.0;

/// `|x|₂`, scaled where squares would under- or overflow.
pub(crate) fn norm<S: Real>(x: impl Iterator<Item = S> + Clone) -> S {
    let sum = x.clone().fold(S::zero(), |sum, x| sum + x * x);
    let is_normal = S::MIN_POSITIVE.less(sum) & sum.at_most(S::MAX);
    if is_normal.all() {
        return sum.sqrt();
    }
    let most = x.clone().fold(S::zero(), |most, x| most.maximum(x.abs()));
    let scaled = x.map(|x| x / most);
    let scaled = most * scaled.fold(S::zero(), |sum, x| sum + x * x).sqrt();
    let has_none = most.equal(S::zero());
    S::select(is_normal, sum.sqrt(), S::select(has_none, most, scaled))
}

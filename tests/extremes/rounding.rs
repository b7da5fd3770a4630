//! What rounding may do, and what came closest to it.

/// Roundings that the bounds allow in the place of the eight that were ever seen.
pub(crate) const ROUNDINGS: f64 = 64.0;

/// |defect|/bound. Nothing moved and nothing is there: 0/0 is no defect.
pub(crate) fn share(defect: f64, bound: f64) -> f64 {
    if defect.abs() > 0.0 || defect.is_nan() {
        (defect / bound).abs()
    } else {
        0.0
    }
}

/// The larger one; a NaN stays.
pub(crate) fn worse(worst: f64, other: f64) -> f64 {
    if other > worst || other.is_nan() {
        other
    } else {
        worst
    }
}

//! The trapezoidal rule in entropy variables: the ordinary rule, for comparison.
//!
//! ```text
//! z¹ − z⁰ = ½h (ż(z⁰) + ż(z¹)),      z = (q, p, γ, s)
//! ```
//!
//! It keeps none of the laws.

use super::point::PointRule;
use crate::element::conjugates::element::Placement;

/// See the module.
#[derive(Debug)]
pub(crate) enum Trapezoidal {}

impl PointRule for Trapezoidal {
    const PLACEMENT: Placement = Placement::End;
    const IMPLICIT: f64 = 0.5;
    const AT: f64 = 1.0;
}

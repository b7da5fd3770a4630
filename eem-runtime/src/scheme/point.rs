//! The response of schemes that evaluate the free energy at one point of the step.
//!
//! They are solved by Newton's method in the variables that they integrate, hence with the entropy
//! as unknown.

use super::{ElementScheme, Infeasible, Placement, Start, temperature_at};
use crate::free_energy::{Array, FreeEnergy};
use crate::scalar::Real;

/// A rule that looks at one point of the step.
pub(crate) trait PointRule: Send + Sync + 'static {
    /// Where the measures are taken.
    const PLACEMENT: Placement;
    /// The part of forces and rates that is taken at the point; the rest is that of the old state.
    const IMPLICIT: f64;
    /// The share c of the step after which the point lies.
    const AT: f64;
}

impl<R, S, M> ElementScheme<S, M> for R
where
    R: PointRule,
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
{
    const PLACEMENT: Placement = R::PLACEMENT;
    const IMPLICIT: f64 = R::IMPLICIT;

    type Old = ();

    fn old(_: &M, _: &M::Variables) -> Self::Old {}

    // The entropy at the point is s⁰ + c Δs.
    fn temperature(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        entropy_change: S,
    ) -> Result<S, Infeasible> {
        let c = S::from_f64(R::AT);
        let guess = x.as_ref()[M::Variables::LEN - 1];
        let entropy = start.entropy + c * entropy_change;
        temperature_at(model, point(start, x, c), entropy, guess)
    }

    fn respond(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        _: &mut M::Corners,
    ) -> Result<(M::Response, M::Tangent), Infeasible> {
        Ok(respond(model, start, x, S::from_f64(R::AT)))
    }
}

/// `(π, γ⁰ + c (γ − γ⁰), τ)` for `x = (π, γ, τ)`.
fn point<S: Real, M: FreeEnergy<S>, Old>(
    start: &Start<S, M, Old>,
    x: &M::Variables,
    c: S,
) -> M::Variables {
    let mut point = *x;
    for index in M::MEASURES..M::MEASURES + M::DASHPOTS {
        let old = start.x0.as_ref()[index];
        point.as_mut()[index] = old + c * (x.as_ref()[index] - old);
    }
    point
}

/// The response at `x_c = (π, γ⁰ + c (γ − γ⁰), τ)`, where `x = (π, γ, τ)`.
///
/// ```text
/// f* = ∂ψ/∂π,  g* = −∂ψ/∂γ,  θ* = τ,  Δs = (S − s⁰)/c       at x_c
/// ```
///
/// `c = ½` is the midpoint, where `s_m = s⁰ + ½Δs`; `c = 1` the end of the step.
fn respond<S: Real, M: FreeEnergy<S>, Old>(
    model: &M,
    start: &Start<S, M, Old>,
    x: &M::Variables,
    c: S,
) -> (M::Response, M::Tangent) {
    let variables = M::Variables::LEN;
    let dashpots = M::MEASURES..M::MEASURES + M::DASHPOTS;
    let (gradient, hessian) = model.hessian(&point(start, x, c));
    let (gradient, hessian) = (gradient.as_ref(), hessian.as_ref());
    let mut response = M::Response::filled(S::zero());
    let mut tangent = M::Tangent::filled(M::Variables::filled(S::zero()));
    let by = |column: usize| {
        if dashpots.contains(&column) {
            c
        } else {
            S::one()
        }
    };
    for row in 0..M::MEASURES + M::DASHPOTS {
        let sign = if row < M::MEASURES {
            S::one()
        } else {
            -S::one()
        };
        response.as_mut()[row] = sign * gradient[row];
        for column in 0..variables {
            let entry = hessian[row].as_ref()[column];
            tangent.as_mut()[row].as_mut()[column] = sign * by(column) * entry;
        }
    }
    if M::THERMAL {
        let last = variables - 1;
        response.as_mut()[last] = x.as_ref()[last];
        tangent.as_mut()[last].as_mut()[last] = S::one();
        response.as_mut()[variables] = (-gradient[last] - start.entropy) / c;
        for column in 0..variables {
            let entry = hessian[last].as_ref()[column];
            tangent.as_mut()[variables].as_mut()[column] = -by(column) * entry / c;
        }
    }
    (response, tangent)
}

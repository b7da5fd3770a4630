//! The response of schemes that evaluate the free energy at one point of the step.
//!
//! These are the ordinary rules, solved the ordinary way: by Newton's method in the variables that
//! they integrate, hence with the entropy as unknown.

use super::{Infeasible, Start, temperature_at};
use crate::free_energy::{Array, FreeEnergy};
use crate::scalar::Real;

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

/// The temperature at that point where the entropy there is `s⁰ + c Δs`.
pub(super) fn temperature<S: Real, M: FreeEnergy<S>, Old>(
    model: &M,
    start: &Start<S, M, Old>,
    x: &M::Variables,
    entropy_change: S,
    c: S,
) -> Result<S, Infeasible> {
    let entropy = start.entropy + c * entropy_change;
    let guess = x.as_ref()[M::Variables::LEN - 1];
    temperature_at(model, point(start, x, c), entropy, guess)
}

/// The response at `x_c = (π, γ⁰ + c (γ − γ⁰), τ)`, where `x = (π, γ, τ)`.
///
/// ```text
/// f* = ∂ψ/∂π,  g* = −∂ψ/∂γ,  θ* = τ,  Δs = (S − s⁰)/c       at x_c
/// ```
///
/// `c = ½` is the midpoint, where `s_m = s⁰ + ½Δs`; `c = 1` the end of the step.
pub(super) fn respond<S: Real, M: FreeEnergy<S>, Old>(
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

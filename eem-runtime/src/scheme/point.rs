//! The response of schemes that evaluate the free energy at one point of the step.

use super::Start;
use crate::free_energy::{Array, FreeEnergy};
use crate::scalar::Real;

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
    let mut point = *x;
    for index in dashpots.clone() {
        let old = start.x0.as_ref()[index];
        point.as_mut()[index] = old + c * (x.as_ref()[index] - old);
    }
    let (gradient, hessian) = model.hessian(&point);
    let (gradient, hessian) = (gradient.as_ref(), hessian.as_ref());
    let mut response = M::Response::filled(S::zero());
    let mut tangent = M::Tangent::filled(M::Variables::filled(S::zero()));
    let by = |column: usize| if dashpots.contains(&column) { c } else { S::one() };
    for row in 0..M::MEASURES + M::DASHPOTS {
        let sign = if row < M::MEASURES { S::one() } else { -S::one() };
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

//! Rules that evaluate the free energy at one point of the step: the classical ones, for comparison, and the
//! variational integrator.
//!
//! | rule | is |
//! |---|---|
//! | midpoint | `z¹ − z⁰ = h ż((z⁰ + z¹)/2)`. It keeps the momenta exactly (Noether) |
//! | trapezoidal | `z¹ − z⁰ = ½h (ż(z⁰) + ż(z¹))`. It keeps none of the laws |
//! | variational | Hamilton's principle, see below. It keeps the momenta, and the energy stays near its value |
//! | rest | no rule of steps: forces at a state at rest, see `step/solver/rest.rs` |
//!
//! The first two have the state `z = (q, p, γ, s)`, or `(q, p, γ, θ)` with the rate
//! `θ̇ = ((Σ g²/η + Q)/θ − s_λ λ̇ − s_γ γ̇)/s_θ` as in Conde Martín, Betsch & García Orden (2016).
//!
//! They are solved by Newton's method in the variables that they integrate, hence with the entropy or the temperature
//! as unknown, and with equations that are neither scaled by θ nor multiplied by η: other unknowns or equations move
//! the time at which the trapezoidal rule breaks down away from the published one.
//!
//! **Variational**: the action with thermacies α, α̇ = θ, by the midpoint rule with λ, γ and α linear in time (Kern,
//! Romero, Conde Martín & García Orden 2021, §III.A):
//!
//! ```text
//! p⁰ = m v + ½h f_m ∂λ/∂q⁰,   p¹ = m v − ½h f_m ∂λ/∂q¹,   v = (q¹ − q⁰)/h
//! f_m = ∂ψ/∂λ,  g_m = −∂ψ/∂γ,  s_m = −∂ψ/∂θ      at (½(λ⁰ + λ¹), γ_m, θ_m)
//! s⁰ = s_m − ½hΦ,   s¹ = s_m + ½hΦ,   Φ = (Σ g_m γ̇ + Q)/θ_m,   γ̇ = g_m/η(θ_m)
//! ```
//!
//! With λ of the mean configuration instead of the mean length it would be the implicit midpoint rule.

use crate::element::conjugates::family::{PointRule, not_of_this_family};
use crate::element::conjugates::infeasible::Infeasible;
use crate::element::conjugates::start::{Form, Kept, Start};
use crate::element::conjugates::temperature::temperature_at;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::tabled::Tabled;

impl PointRule {
    /// The temperature τ of a trial, given its other variables and Δs: the entropy at the point is s⁰ + c Δs.
    pub(crate) fn temperature<A: Arrays>(
        self,
        model: &Tabled<A>,
        start: &Start<A>,
        x: &A::Variables,
        entropy_change: f64,
    ) -> Result<f64, Infeasible> {
        let c = self.time();
        let guess = x.as_ref()[A::Variables::LEN - 1];
        let entropy = old_entropy(start) + c * entropy_change;
        temperature_at(model, point(start, x, c), entropy, guess)
    }

    /// The response and its tangent.
    pub(super) fn respond<A: Arrays>(
        self,
        model: &Tabled<A>,
        start: &Start<A>,
        x: &A::Variables,
    ) -> Form<A> {
        respond(model, start, x, self.time())
    }

    /// For a rule in temperature: replaces the Δs of the form by `Σ_i (∂s/∂x_i) δ_i`, where `δ` are the
    /// increments of measures, viscous stretches and temperature along the step, less the contributions of the
    /// old state. Returns `∂s/∂x`.
    pub(crate) fn change_entropy_at_rates<A: Arrays>(
        self,
        model: &Tabled<A>,
        start: &Start<A>,
        x: &A::Variables,
        increments: &A::Variables,
        form: &mut Form<A>,
    ) -> A::Variables {
        let c = self.time();
        let point = point(start, x, c);
        change_entropy_at_rates(model, &point, increments, c, form)
    }
}

/// s⁰, J/K.
fn old_entropy<A: Arrays>(start: &Start<A>) -> f64 {
    match start.old {
        Kept::State(entropy) => entropy,
        Kept::Exact(..) => not_of_this_family(),
    }
}

/// `(π, γ⁰ + c (γ − γ⁰), τ)` for `x = (π, γ, τ)`.
fn point<A: Arrays>(start: &Start<A>, x: &A::Variables, c: f64) -> A::Variables {
    let mut point = *x;
    for index in A::MEASURES..A::MEASURES + A::DASHPOTS {
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
fn respond<A: Arrays>(model: &Tabled<A>, start: &Start<A>, x: &A::Variables, c: f64) -> Form<A> {
    let variables = A::Variables::LEN;
    let dashpots = A::MEASURES..A::MEASURES + A::DASHPOTS;
    let (gradient, hessian) = model.hessian(&point(start, x, c));
    let (gradient, hessian) = (gradient.as_ref(), hessian.as_ref());
    let mut response = A::Response::filled(0.0);
    let mut tangent = A::Tangent::filled(A::Variables::filled(0.0));
    let by = |column: usize| {
        if dashpots.contains(&column) { c } else { 1.0 }
    };
    for row in 0..A::MEASURES + A::DASHPOTS {
        let sign = if row < A::MEASURES { 1.0 } else { -1.0 };
        response.as_mut()[row] = sign * gradient[row];
        for column in 0..variables {
            let entry = hessian[row].as_ref()[column];
            tangent.as_mut()[row].as_mut()[column] = sign * by(column) * entry;
        }
    }
    if model.is_thermal() {
        let last = variables - 1;
        response.as_mut()[last] = x.as_ref()[last];
        tangent.as_mut()[last].as_mut()[last] = 1.0;
        response.as_mut()[variables] = (-gradient[last] - old_entropy(start)) / c;
        for column in 0..variables {
            let entry = hessian[last].as_ref()[column];
            tangent.as_mut()[variables].as_mut()[column] = -by(column) * entry / c;
        }
    }
    (response, tangent)
}

/// Replaces the Δs of entropies by that of rates, `Δs = Σ_i (∂s/∂x_i) δ_i` at the point, with the
/// increments `δ` of measures, viscous stretches and temperature along the step.
///
/// Returns `∂s/∂x`. With `θ ṡ = Σ g²/η + Q` written as `θ (s_λ λ̇ + s_γ γ̇ + s_θ θ̇)` this is the rule for θ̇.
fn change_entropy_at_rates<A: Arrays>(
    model: &Tabled<A>,
    point: &A::Variables,
    increments: &A::Variables,
    c: f64,
    (response, tangent): &mut Form<A>,
) -> A::Variables {
    let (variables, last) = (A::Variables::LEN, A::Variables::LEN - 1);
    let entropy_hessian = model.entropy_hessian(point);
    // ∂s/∂x, of which the tangent of Δs = (S − s⁰)/c is made: for γ with dγ_c/dγ = c.
    let slopes = tangent.as_ref()[variables];
    let slope = |i: usize| {
        let entry = slopes.as_ref()[i];
        if (A::MEASURES..last).contains(&i) {
            entry
        } else {
            c * entry
        }
    };
    let mut change = 0.0;
    for (i, &increment) in increments.as_ref().iter().enumerate() {
        change += slope(i) * increment;
    }
    response.as_mut()[variables] = change;
    for column in 0..variables {
        let mut entry = 0.0;
        for (i, &increment) in increments.as_ref().iter().enumerate() {
            entry += entropy_hessian.as_ref()[i].as_ref()[column] * increment;
        }
        // dγ_c/dγ = c and dδ_γ/dγ = 1; dδ_θ/dτ = 1/c; measures enter through their increments.
        let entry = if column < A::MEASURES {
            entry
        } else if column < last {
            c * entry + slope(column)
        } else {
            entry + slope(column) / c
        };
        tangent.as_mut()[variables].as_mut()[column] = entry;
    }
    let mut by_increment = A::Variables::filled(0.0);
    for (i, by) in by_increment.as_mut().iter_mut().enumerate() {
        *by = slope(i);
    }
    by_increment
}
